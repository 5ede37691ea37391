#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <string>

#include "mesh_formats.h"
#include "mesh_words.h"

namespace nade::io {
namespace {

constexpr std::size_t kHeaderBytes = 84;
constexpr std::size_t kTriangleBytes = 50;
constexpr std::uint32_t kUnknownCount = 0xFFFFFFFF;

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

class TextReader {
 public:
  explicit TextReader(const MeshText& file) : words_(file.path, file.content) {}

  Result<TriangleSoup> run() {
    while (true) {
      const std::string_view found = words_.word();
      std::string word = lower(found);
      if (word == "end") word += lower(words_.word_of_line());
      if (word == "solid") {
        skip_name();
      } else if (word == "endsolid" && !in_facet_) {
        words_.skip_line();
      } else if (word == "facet") {
        if (in_facet_) return words_.expected("'endfacet'", found);
        in_facet_ = true;
      } else if (word == "normal") {
        for (int i = 0; i < 3; ++i) words_.word_of_line();  // the corners tell it too
      } else if (word == "vertex") {
        if (std::optional<Error> error = read_vertex()) return *error;
      } else if (word == "endfacet") {
        if (std::optional<Error> error = end_facet()) return *error;
      } else if (word.empty() && !in_facet_ && found_ == 0) {
        return std::move(soup_);  // "endsolid" is often left out
      } else if (word != "outer" && word != "loop" && word != "endloop") {
        return words_.expected("'facet', 'vertex' or 'endsolid'", found);
      }
    }
  }

 private:
  /// A solid's name, which a facet may follow on the same line.
  void skip_name() {
    std::string before;
    while (true) {
      const std::string_view word = words_.word_of_line();
      if (word.empty()) break;
      if (before == "facet" && lower(word) == "normal") {
        in_facet_ = true;
        for (int i = 0; i < 3; ++i) words_.word_of_line();
        return;
      }
      before = lower(word);
    }
    words_.skip_line();
  }

  std::optional<Error> read_vertex() {
    Vec3 position;
    for (double& coordinate : position) {
      const std::string_view number = words_.word();
      if (!parse_word(number, coordinate)) return words_.expected("a coordinate", number);
    }
    if (found_ < 3) corners_[found_] = position.cast<float>();
    ++found_;
    return std::nullopt;
  }

  std::optional<Error> end_facet() {
    if (found_ != 3) {
      return words_.error(ErrorCode::bad_format,
                          fmt::format("expected 3 vertices in a facet, found {}", found_));
    }
    add_triangle(soup_, corners_);
    found_ = 0;
    in_facet_ = false;
    return std::nullopt;
  }

  WordReader words_;
  TriangleSoup soup_;
  std::array<Eigen::Vector3f, 3> corners_;
  std::size_t found_ = 0;
  bool in_facet_ = false;
};

/// Whether a file begins as a text does.
bool begins_solid(std::string_view content) {
  if (content.starts_with(kByteOrderMark)) content.remove_prefix(kByteOrderMark.size());
  const std::size_t start = content.find_first_not_of(" \t\r\n");
  return start != std::string_view::npos && lower(content.substr(start, 5)) == "solid";
}

}  // namespace

Result<TriangleSoup> read_stl(const MeshText& file) {
  const std::string_view content = file.content;
  std::uint32_t count = 0;
  if (content.size() >= kHeaderBytes) std::memcpy(&count, content.data() + 80, sizeof count);
  const std::size_t whole = kHeaderBytes + kTriangleBytes * std::size_t{count};
  if (content.size() == whole) return read_binary(content, count);
  const bool text = begins_solid(content);
  if (text && lower(content).find("facet") != std::string::npos) return TextReader(file).run();
  // What is written as it comes has no count yet.
  const std::size_t behind = content.size() - std::min(content.size(), kHeaderBytes);
  if ((count == 0 || count == kUnknownCount) && behind > 0 && behind % kTriangleBytes == 0) {
    return read_binary(content, behind / kTriangleBytes);
  }
  // Some programs write more behind the triangles, but that is no triangles.
  if (content.size() > whole && count > 0) {
    const std::size_t more = content.size() - whole;
    if (more % kTriangleBytes != 0) return read_binary(content, count);
    return Error{ErrorCode::bad_format,
                 fmt::format("{}: expected {} triangles, as its header says, found {}", file.path,
                             count, count + more / kTriangleBytes)};
  }
  if (text && lower(content).find("endsolid") != std::string::npos) return TriangleSoup{};
  return Error{ErrorCode::bad_format,
               fmt::format("{}: expected 'solid', or {} bytes for the {} triangles of its header, "
                           "found {} bytes",
                           file.path, whole, count, content.size())};
}

}  // namespace nade::io
