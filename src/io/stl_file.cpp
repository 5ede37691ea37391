#include <array>
#include <cstring>

#include "mesh_formats.h"
#include "mesh_words.h"

namespace nade::io {
namespace {

constexpr std::size_t kHeaderBytes = 84;
constexpr std::size_t kTriangleBytes = 50;

void add_triangle(TriangleSoup& soup, const std::array<Eigen::Vector3f, 3>& corners) {
  const auto first = static_cast<std::uint32_t>(soup.vertices.size());
  soup.vertices.insert(soup.vertices.end(), corners.begin(), corners.end());
  soup.triangles.push_back({first, first + 1, first + 2});
}

TriangleSoup read_binary(std::string_view content, std::size_t count) {
  TriangleSoup soup;
  soup.vertices.reserve(3 * count);
  soup.triangles.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    // The normal comes first; the corners tell it too.
    std::array<float, 12> numbers;
    std::memcpy(numbers.data(), content.data() + kHeaderBytes + i * kTriangleBytes, sizeof numbers);
    std::array<Eigen::Vector3f, 3> corners;
    for (std::size_t k = 0; k < 3; ++k)
      corners[k] = Eigen::Map<Eigen::Vector3f>(&numbers[3 * k + 3]);
    add_triangle(soup, corners);
  }
  return soup;
}

Result<TriangleSoup> read_ascii(const MeshText& file) {
  WordReader words(file.path, file.content);
  TriangleSoup soup;
  std::array<Eigen::Vector3f, 3> corners;
  std::size_t found = 0;
  bool open = false;
  while (true) {
    const std::string_view word = words.word();
    if (word == "solid") {
      open = true;
      words.skip_line();
    } else if (word == "endsolid") {
      open = false;
      words.skip_line();
    } else if (word == "vertex") {
      Vec3 position;
      for (double& coordinate : position) {
        const std::string_view number = words.word();
        if (!parse_word(number, coordinate)) return words.expected("a coordinate", number);
      }
      if (found < 3) corners[found] = position.cast<float>();
      ++found;
    } else if (word == "endfacet") {
      if (found != 3)
        return words.error(ErrorCode::bad_format,
                           fmt::format("expected 3 vertices in a facet, found {}", found));
      add_triangle(soup, corners);
      found = 0;
    } else if (word == "facet" || word == "outer" || word == "endloop") {
      words.skip_line();
    } else if (word.empty() && !open) {
      return soup;
    } else {
      return words.expected("'facet', 'vertex' or 'endsolid'", word);
    }
  }
}

}  // namespace

Result<TriangleSoup> read_stl(const MeshText& file) {
  const std::string_view content = file.content;
  std::uint32_t count = 0;
  if (content.size() >= kHeaderBytes) std::memcpy(&count, content.data() + 80, sizeof count);
  const std::size_t whole = kHeaderBytes + kTriangleBytes * std::size_t{count};
  if (content.size() == whole) return read_binary(content, count);
  if (content.starts_with("solid") && content.find("facet") != std::string_view::npos) {
    return read_ascii(file);
  }
  // Some programs write more behind the triangles, but that is no triangles.
  if (content.size() > whole && count > 0) {
    const std::size_t more = content.size() - whole;
    if (more % kTriangleBytes != 0) return read_binary(content, count);
    return Error{ErrorCode::bad_format,
                 fmt::format("{}: expected {} triangles, as its header says, found {}", file.path,
                             count, count + more / kTriangleBytes)};
  }
  if (content.starts_with("solid") && content.find("endsolid") != std::string_view::npos) {
    return TriangleSoup{};
  }
  return Error{ErrorCode::bad_format,
               fmt::format("{}: expected {} bytes for {} triangles, found {}", file.path, whole,
                           count, content.size())};
}

}  // namespace nade::io
