#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>
#include <vector>

#include "mesh_formats.h"
#include "mesh_words.h"

// Based on: Turk. The PLY Polygon File Format. 1994.

namespace nade::io {
namespace {

enum class Encoding : std::uint8_t { ascii, little, big };
enum class Scalar : std::uint8_t { i8, u8, i16, u16, i32, u32, f32, f64 };

struct Property {
  std::string name;
  Scalar type = Scalar::f32;
  std::optional<Scalar> count_type;  ///< where it is a list
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

std::optional<Scalar> scalar_from(std::string_view name) {
  struct Name {
    std::string_view text;
    Scalar scalar;
  };
  constexpr std::array<Name, 16> kNames{{{"char", Scalar::i8},
                                         {"int8", Scalar::i8},
                                         {"uchar", Scalar::u8},
                                         {"uint8", Scalar::u8},
                                         {"short", Scalar::i16},
                                         {"int16", Scalar::i16},
                                         {"ushort", Scalar::u16},
                                         {"uint16", Scalar::u16},
                                         {"int", Scalar::i32},
                                         {"int32", Scalar::i32},
                                         {"uint", Scalar::u32},
                                         {"uint32", Scalar::u32},
                                         {"float", Scalar::f32},
                                         {"float32", Scalar::f32},
                                         {"double", Scalar::f64},
                                         {"float64", Scalar::f64}}};
  for (const Name& name_of : kNames) {
    if (name_of.text == name) return name_of.scalar;
  }
  return std::nullopt;
}

class PlyReader {
 public:
  explicit PlyReader(const MeshText& file) : file_(file), words_(file.path, file.content) {}

  Result<TriangleSoup> run() {
    if (std::optional<Error> error = read_header()) return *error;
    for (const Element& element : elements_) {
      for (std::size_t row = 0; row < element.count; ++row) {
        if (std::optional<Error> error = read_row(element, row)) return *error;
      }
    }
    if (std::optional<Error> error = check_end()) return *error;
    return std::move(soup_);
  }

 private:
  std::optional<Error> read_header() {
    const std::string_view magic = words_.word();
    if (magic != "ply") return words_.expected("'ply'", magic);
    while (true) {
      const std::string_view keyword = words_.word();
      if (keyword == "end_header") break;
      if (keyword == "format") {
        const std::string_view name = words_.word();
        if (name == "ascii") {
          encoding_ = Encoding::ascii;
        } else if (name == "binary_little_endian") {
          encoding_ = Encoding::little;
        } else if (name == "binary_big_endian") {
          encoding_ = Encoding::big;
        } else {
          return words_.expected("a format", name);
        }
        words_.skip_line();
      } else if (keyword == "element") {
        Element& element = elements_.emplace_back();
        element.name = words_.word();
        const std::string_view count = words_.word();
        if (!parse_word(count, element.count))
          return words_.expected("a number of elements", count);
      } else if (keyword == "property" && !elements_.empty()) {
        if (std::optional<Error> error = read_property()) return error;
      } else if (is_comment(keyword)) {
        words_.skip_line();
      } else {
        return words_.expected("'element', 'property' or 'end_header'", keyword);
      }
    }
    words_.skip_line();
    at_ = words_.offset();
    // The first data byte may look like a line feed where lines end in a carriage return alone.
    const bool two = file_.content.substr(at_).starts_with("\r\n") &&
                     (file_.content.starts_with("ply\r\n") || !file_.content.starts_with("ply\r"));
    at_ = std::min(at_ + (two ? 2 : 1), file_.content.size());
    if (std::optional<Error> error = check_coordinates()) return error;
    return check_faces();
  }

  /// Blender 2.4 wrote one that does not say so.
  [[nodiscard]] bool is_comment(std::string_view keyword) const {
    if (keyword == "comment" || keyword == "obj_info") return true;
    return elements_.empty() && !keyword.empty() && keyword != "property";
  }

  [[nodiscard]] std::optional<Error> check_coordinates() const {
    for (const Element& element : elements_) {
      if (element.name != "vertex") continue;
      for (const std::string_view axis : {"x", "y", "z"}) {
        const bool given = std::any_of(
            element.properties.begin(), element.properties.end(),
            [&](const Property& known) { return known.name == axis && !known.count_type; });
        if (given) continue;
        return Error{ErrorCode::bad_format,
                     fmt::format("{}: expected the properties x, y and z of a vertex, found no {}",
                                 file_.path, axis)};
      }
    }
    return std::nullopt;
  }

  static bool is_list_of_corners(const Property& property) {
    return property.count_type &&
           (property.name == "vertex_indices" || property.name == "vertex_index");
  }

  [[nodiscard]] std::optional<Error> check_faces() const {
    for (const Element& element : elements_) {
      if (element.count == 0) continue;
      if (element.properties.empty()) {
        return Error{ErrorCode::bad_format,
                     fmt::format("{}: element {}: expected properties, found none", file_.path,
                                 element.name.substr(0, kLongestName))};
      }
      const bool has_corners = element.name == "face" || element.name == "tristrips";
      if (!has_corners ||
          std::any_of(element.properties.begin(), element.properties.end(), is_list_of_corners)) {
        continue;
      }
      return Error{
          ErrorCode::bad_format,
          fmt::format("{}: element {}: expected a list vertex_indices, found only '{}'", file_.path,
                      element.name, element.properties[0].name.substr(0, kLongestName))};
    }
    return std::nullopt;
  }

  [[nodiscard]] std::optional<Error> check_end() {
    if (encoding_ == Encoding::ascii) {
      const std::string_view word = words_.word();
      if (word.empty()) return std::nullopt;
      return words_.expected("the end of the file", word);
    }
    const std::string_view rest = file_.content.substr(at_);
    constexpr std::string_view kPadding("\0 \t\r\n", 5);
    if (rest.find_first_not_of(kPadding) == std::string_view::npos) return std::nullopt;
    return Error{ErrorCode::bad_format,
                 fmt::format("{}: expected the end of the file after its elements, found {} bytes "
                             "more",
                             file_.path, rest.size())};
  }

  std::optional<Error> read_property() {
    Property property;
    std::string_view type = words_.word();
    if (type == "list") {
      const std::string_view count_type = words_.word();
      property.count_type = scalar_from(count_type);
      if (!property.count_type) return words_.expected("a type", count_type);
      type = words_.word();
    }
    const std::optional<Scalar> scalar = scalar_from(type);
    if (!scalar) return words_.expected("a type", type);
    property.type = *scalar;
    property.name = words_.word();
    elements_.back().properties.push_back(std::move(property));
    return std::nullopt;
  }

  std::optional<Error> read_row(const Element& element, std::size_t row) {
    Vec3 position = Vec3::Zero();
    for (const Property& property : element.properties) {
      if (!property.count_type) {
        const std::optional<double> value = read(property.type);
        if (!value) return cut_off(element, row);
        if (property.name == "x") position.x() = *value;
        if (property.name == "y") position.y() = *value;
        if (property.name == "z") position.z() = *value;
        continue;
      }
      if (std::optional<Error> error = read_list(element, row, property)) return error;
    }
    if (element.name == "vertex") soup_.vertices.emplace_back(position.cast<float>());
    return std::nullopt;
  }

  std::optional<Error> read_list(const Element& element, std::size_t row,
                                 const Property& property) {
    const std::optional<double> count = read(*property.count_type);
    if (!count || !(*count >= 0.0) || *count != std::floor(*count)) return cut_off(element, row);
    const bool strip = element.name == "tristrips";
    const bool kept = (strip || element.name == "face") && is_list_of_corners(property);
    corners_.clear();
    for (double i = 0.0; i < *count; ++i) {
      const std::optional<double> value = read(property.type);
      if (!value) return cut_off(element, row);
      if (!kept) continue;
      if (strip && *value == -1.0) {
        add_strip();
        continue;
      }
      const bool known = *value >= 0.0 && *value < static_cast<double>(soup_.vertices.size()) &&
                         *value == std::floor(*value);
      if (!known) {
        return bad_face(row, fmt::format("expected vertices below {}, found {}",
                                         soup_.vertices.size(), *value));
      }
      corners_.push_back(static_cast<std::uint32_t>(*value));
    }
    if (strip) {
      add_strip();
    } else if (!add_polygon(soup_, corners_)) {
      return bad_face(row, kTooWinding);
    }
    return std::nullopt;
  }

  [[nodiscard]] Error bad_face(std::size_t row, std::string_view what) const {
    return {ErrorCode::bad_value, fmt::format("{}: face {}: {}", file_.path, row, what)};
  }

  /// Every second triangle of a strip is wound the other way.
  void add_strip() {
    for (std::size_t i = 0; i + 2 < corners_.size(); ++i) {
      const std::size_t turned = i % 2;
      soup_.triangles.push_back({corners_[i], corners_[i + 1 + turned], corners_[i + 2 - turned]});
    }
    corners_.clear();
  }

  /// Nothing where the file ends or, in a text, has no number.
  std::optional<double> read(Scalar type) {
    if (encoding_ == Encoding::ascii) {
      double value = 0.0;
      if (!parse_word(words_.word(), value)) return std::nullopt;
      return value;
    }
    switch (type) {
      case Scalar::i8:
        return read_bytes<std::int8_t>();
      case Scalar::u8:
        return read_bytes<std::uint8_t>();
      case Scalar::i16:
        return read_bytes<std::int16_t>();
      case Scalar::u16:
        return read_bytes<std::uint16_t>();
      case Scalar::i32:
        return read_bytes<std::int32_t>();
      case Scalar::u32:
        return read_bytes<std::uint32_t>();
      case Scalar::f32:
        return read_bytes<float>();
      case Scalar::f64:
        return read_bytes<double>();
    }
    return std::nullopt;
  }

  template <class Number>
  std::optional<double> read_bytes() {
    std::array<char, sizeof(Number)> bytes;
    if (file_.content.size() - at_ < sizeof(Number)) return std::nullopt;
    std::memcpy(bytes.data(), file_.content.data() + at_, sizeof(Number));
    at_ += sizeof(Number);
    if ((encoding_ == Encoding::big) == (std::endian::native == std::endian::little)) {
      std::reverse(bytes.begin(), bytes.end());
    }
    return static_cast<double>(std::bit_cast<Number>(bytes));
  }

  [[nodiscard]] Error cut_off(const Element& element, std::size_t row) const {
    const std::string what =
        fmt::format("{} {} of {}: expected a number, found none", element.name, row, element.count);
    if (encoding_ == Encoding::ascii) return words_.error(ErrorCode::bad_format, what);
    return Error{ErrorCode::bad_format, fmt::format("{}: {}", file_.path, what)};
  }

  static constexpr std::size_t kLongestName = 40;
  const MeshText& file_;
  WordReader words_;
  Encoding encoding_ = Encoding::ascii;
  std::vector<Element> elements_;
  std::size_t at_ = 0;  ///< in a binary file's data
  std::vector<std::uint32_t> corners_;
  TriangleSoup soup_;
};

}  // namespace

Result<TriangleSoup> read_ply(const MeshText& file) { return PlyReader(file).run(); }

}  // namespace nade::io
