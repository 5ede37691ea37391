#include "obj_text.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "byte_source.h"
#include "mesh_formats.h"
#include "mesh_words.h"
#include "whole_file.h"

namespace nade::io {
namespace {

/// Goes through the statements, each a list of words.
class Statements {
 public:
  explicit Statements(std::string_view text) : text_(text) {}

  /// The next statement that is not empty; none at the end. Valid until the next call.
  [[nodiscard]] bool next() {
    words_.clear();
    while (words_.empty() && !text_.empty()) {
      first_line_ = line_;
      while (take_line()) {
      }
    }
    return !words_.empty();
  }
  [[nodiscard]] const std::vector<std::string_view>& words() const { return words_; }
  /// Where the statement begins, counted from 1.
  [[nodiscard]] std::size_t line() const { return first_line_; }

 private:
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
  static bool ends_line(char c) { return c == '\n' || c == '\r'; }

  /// Adds a line's words up to a comment, which a word with '#' begins; whether the statement goes
  /// on in the next line.
  bool take_line() {
    const auto end = std::find_if(text_.begin(), text_.end(), ends_line);
    std::string_view line(text_.begin(), end);
    text_ = std::string_view(end, text_.end());
    text_.remove_prefix(text_.starts_with("\r\n") ? 2 : std::min<std::size_t>(text_.size(), 1));
    ++line_;
    while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
    const bool goes_on = line.ends_with('\\');
    if (goes_on) line.remove_suffix(1);
    auto at = line.begin();
    while (true) {
      at = std::find_if_not(at, line.end(), is_blank);
      if (at == line.end()) return goes_on;
      if (*at == '#') return false;
      const auto word_end = std::find_if(at, line.end(), is_blank);
      words_.emplace_back(at, word_end);
      at = word_end;
    }
  }

  std::string_view text_;
  std::vector<std::string_view> words_;
  std::size_t line_ = 1;
  std::size_t first_line_ = 1;
};

/// An .obj file's vertices, faces, groups and materials, a statement a line, in the few spellings
/// that Assimp knows. The error names the line.
class PlainObj {
 public:
  explicit PlainObj(const MeshText& file)
      : file_(file),
        statements_(file.content.substr(
            file.content.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0)) {}

  struct Read {
    std::string plain;
    TriangleSoup soup;
  };

  Result<Read> run() {
    plain_.reserve(file_.content.size());
    while (statements_.next()) {
      const std::string_view keyword = statements_.words()[0];
      Status status = ok_status();
      if (keyword == "v") {
        ++vertices_;
        status = add_numbers({3, 6});
        soup_.vertices.emplace_back(position_.cast<float>());
      } else if (keyword == "vn") {
        status = add_numbers({3, 3});
      } else if (keyword == "vt") {
        status = add_numbers({2, 3});
      } else if (keyword == "f" || keyword == "fo") {
        status = add_face();
      } else if (keyword == "o" || keyword == "g" || keyword == "s" || keyword == "usemtl" ||
                 keyword == "mtllib") {
        add_words();
      }
      if (!status) return status.error();
    }
    if (greatest_ > vertices_) return beyond(greatest_, greatest_line_);
    if (const Status status = cut_faces(); !status) return status.error();
    return Read{std::move(plain_), std::move(soup_)};
  }

 private:
  struct Face {
    std::size_t end;  ///< in `corners_`
    std::size_t line;
  };
  struct Count {
    std::size_t least;
    std::size_t most;
  };

  [[nodiscard]] Error wrong(std::size_t line, const std::string& sentence) const {
    return {ErrorCode::bad_format, fmt::format("{}: line {}: {}", file_.path, line, sentence)};
  }
  [[nodiscard]] Error beyond(std::int64_t vertex, std::size_t line) const {
    return wrong(line, fmt::format("expected vertices up to {}, found {}", vertices_, vertex));
  }

  void add_words() {
    for (const std::string_view word : statements_.words()) {
      if (!plain_.empty() && plain_.back() != '\n') plain_ += ' ';
      plain_ += word;
    }
    plain_ += '\n';
  }

  Status add_numbers(Count count) {
    const auto& words = statements_.words();
    const std::size_t found = words.size() - 1;
    if (found < count.least) {
      return wrong(statements_.line(),
                   fmt::format("{}: expected {} numbers, found {}", words[0], count.least, found));
    }
    // Of a vertex: three numbers, a weight as the fourth, or three of a colour. More are left out.
    const bool whole = count.most == 3 || found == 4 || found >= count.most;
    const std::size_t kept = whole ? std::min(found, count.most) : count.least;
    plain_ += words[0];
    for (std::size_t i = 1; i <= found; ++i) {
      double number = 0.0;
      if (!parse_word(words[i], number)) {
        return wrong(statements_.line(),
                     fmt::format("{}: expected a number, found '{}'", words[0], shown(words[i])));
      }
      if (i == 4 && found == 4 && number == 0.0) {
        return wrong(statements_.line(), "v: expected a weight other than 0, found 0");
      }
      if (i <= kept) add_number(words[i]);
      if (i <= 3) position_[static_cast<Eigen::Index>(i) - 1] = number;
      if (i == 4 && found == 4) position_ /= number;
    }
    plain_ += '\n';
    return ok_status();
  }

  /// The importer takes ".5" and "+1" for words.
  void add_number(std::string_view word) {
    plain_ += ' ';
    if (word.starts_with('-')) plain_ += '-';
    if (word.starts_with('-') || word.starts_with('+')) word.remove_prefix(1);
    if (word.starts_with('.')) plain_ += '0';
    plain_ += word;
  }

  Status add_face() {
    const auto& words = statements_.words();
    for (std::size_t i = 1; i < words.size(); ++i) {
      std::string_view rest = words[i];
      for (std::size_t part = 0; part < 3; ++part) {
        const std::string_view digits = rest.substr(0, rest.find('/'));
        rest.remove_prefix(std::min(digits.size() + 1, rest.size()));
        if (part > 0 && digits.empty()) continue;  // a corner without texture or normal
        std::int64_t index = 0;
        const auto [end, code] =
            std::from_chars(digits.data(), digits.data() + digits.size(), index);
        if (code != std::errc{} || end != digits.data() + digits.size() || index == 0) {
          return bad_corner(words[i]);
        }
        if (part > 0) continue;
        if (index < -vertices_) return beyond(index, statements_.line());
        const std::int64_t corner = index > 0 ? index - 1 : vertices_ + index;
        corners_.push_back(static_cast<std::uint32_t>(std::min<std::int64_t>(corner, kMost)));
        // A face may stand before its vertices.
        if (index <= greatest_) continue;
        greatest_ = index;
        greatest_line_ = statements_.line();
      }
      if (!rest.empty()) return bad_corner(words[i]);
    }
    faces_.push_back({corners_.size(), statements_.line()});
    add_words();
    return ok_status();
  }

  [[nodiscard]] Status cut_faces() {
    std::size_t first = 0;
    for (const Face& face : faces_) {
      const std::span<const std::uint32_t> corners(corners_.data() + first, face.end - first);
      if (!add_polygon(soup_, corners)) return wrong(face.line, std::string(kTooWinding));
      first = face.end;
    }
    return ok_status();
  }

  [[nodiscard]] Error bad_corner(std::string_view word) const {
    return wrong(
        statements_.line(),
        fmt::format("f: expected the numbers of vertices, from 1 on, found '{}'", shown(word)));
  }

  static std::string_view shown(std::string_view word) {
    constexpr std::size_t kLongest = 40;
    return word.substr(0, kLongest);
  }

  MeshText file_;
  Statements statements_;
  std::string plain_;
  static constexpr std::int64_t kMost = 0xFFFFFFFF;
  TriangleSoup soup_;
  Vec3 position_ = Vec3::Zero();        ///< of the last statement
  std::vector<std::uint32_t> corners_;  ///< of all faces
  std::vector<Face> faces_;
  std::int64_t vertices_ = 0;
  std::int64_t greatest_ = 0;  ///< vertex of a face
  std::size_t greatest_line_ = 0;
};

}  // namespace

Result<TriangleSoup> read_obj(const MeshText& file) {
  Result<PlainObj::Read> read = PlainObj(file).run();
  if (!read) return read.error();
  return std::move(read->soup);
}

Result<std::string> plain_obj(const std::string& path) {
  const Result<std::string> content = read_whole(path);
  if (!content) return content.error();
  Result<PlainObj::Read> read = PlainObj({path, *content}).run();
  if (!read) return read.error();
  return std::move(read->plain);
}

}  // namespace nade::io
