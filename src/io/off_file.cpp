#include <vector>

#include "mesh_formats.h"
#include "mesh_words.h"

namespace nade::io {

void add_polygon(TriangleSoup& soup, std::span<const std::uint32_t> corners) {
  if (corners.size() < 3) return;
  const auto normal = [&](std::size_t i, std::size_t j, std::size_t k) {
    const Vec3 a = soup.vertices[corners[i]].cast<double>();
    const Vec3 b = soup.vertices[corners[j]].cast<double>();
    const Vec3 c = soup.vertices[corners[k]].cast<double>();
    return Vec3((b - a).cross(c - a));
  };
  std::size_t first = 0;
  if (corners.size() == 4 && normal(0, 1, 2).dot(normal(0, 2, 3)) < 0.0) first = 1;
  const auto at = [&](std::size_t i) { return corners[(first + i) % corners.size()]; };
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    soup.triangles.push_back({at(0), at(i), at(i + 1)});
  }
}

Result<TriangleSoup> read_off(const MeshText& file) {
  WordReader words(file.path, file.content);
  const std::string_view header = words.word();
  if (!header.ends_with("OFF") || header.find_first_not_of("STCNOF") != std::string_view::npos) {
    return words.expected("'OFF'", header);
  }
  std::size_t vertices = 0;
  std::size_t faces = 0;
  std::size_t edges = 0;
  for (std::size_t* count : {&vertices, &faces, &edges}) {
    const std::string_view word = words.word();
    if (!parse_word(word, *count))
      return words.expected("the number of vertices, faces, edges", word);
  }
  TriangleSoup soup;
  for (std::size_t i = 0; i < vertices; ++i) {
    Vec3 position;
    for (double& coordinate : position) {
      const std::string_view word = words.word();
      if (!parse_word(word, coordinate)) {
        return words.expected(fmt::format("a coordinate of vertex {} of {}", i, vertices), word);
      }
    }
    words.skip_line();  // colours, normals
    soup.vertices.emplace_back(position.cast<float>());
  }
  std::vector<std::uint32_t> corners;
  for (std::size_t i = 0; i < faces; ++i) {
    const std::string_view count_word = words.word();
    std::uint32_t count = 0;
    if (!parse_word(count_word, count)) {
      return words.expected(fmt::format("the number of corners of face {} of {}", i, faces),
                            count_word);
    }
    corners.clear();
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::string_view word = words.word_of_line();
      std::uint32_t vertex = 0;
      if (!parse_word(word, vertex)) {
        return words.error(ErrorCode::bad_format,
                           fmt::format("face {}: expected {} corners, found {}", i, count, k));
      }
      if (vertex >= vertices) {
        return words.error(
            ErrorCode::bad_value,
            fmt::format("face {}: expected vertices below {}, found {}", i, vertices, vertex));
      }
      corners.push_back(vertex);
    }
    words.skip_line();  // colours
    add_polygon(soup, corners);
  }
  if (const std::string_view word = words.word(); !word.empty()) {
    return words.expected("the end of the file", word);
  }
  return soup;
}

}  // namespace nade::io
