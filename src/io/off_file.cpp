#include <optional>
#include <string>
#include <vector>

#include "mesh_formats.h"
#include "mesh_words.h"

namespace nade::io {

Result<TriangleSoup> read_off(const MeshText& file) {
  WordReader words(file.path, file.content);
  const std::string_view header = words.word();
  // The first count may stick to the header.
  const std::string name = lower(header.substr(0, header.find_first_of("0123456789")));
  if (!name.ends_with("off") || name.find_first_not_of("stcnof") != std::string::npos) {
    return words.expected("'OFF'", header);
  }
  const auto count_from = [&words](std::string_view word, std::size_t& count) {
    return parse_word(word, count)
               ? std::nullopt
               : std::optional<Error>(words.expected("the number of vertices, faces, edges", word));
  };
  std::size_t vertices = 0;
  std::size_t faces = 0;
  std::size_t edges = 0;
  const std::string_view stuck = header.substr(name.size());
  if (auto error = count_from(stuck.empty() ? words.word() : stuck, vertices)) return *error;
  const std::size_t line = words.line();
  if (auto error = count_from(words.word(), faces)) return *error;
  // Some programs leave out the number of edges.
  const std::string_view last = words.line() == line ? words.word_of_line() : words.word();
  if (!last.empty()) {
    if (auto error = count_from(last, edges)) return *error;
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
    if (!add_polygon(soup, corners)) {
      return words.error(ErrorCode::bad_value, fmt::format("face {}: {}", i, kTooWinding));
    }
  }
  if (const std::string_view word = words.word(); !word.empty()) {
    return words.expected("the end of the file", word);
  }
  return soup;
}

}  // namespace nade::io
