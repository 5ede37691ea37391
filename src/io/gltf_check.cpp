#include "gltf_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>

#include "gltf_resource.h"

// Based on: The Khronos Group. glTF 2.0 Specification. 2021.

namespace nade::gltf {
namespace {

using io::Json;

constexpr std::string_view kCompression = "_compression";

class ElementCheck {
 public:
  ElementCheck(const std::string& path, const Json& document) : path_(path), document_(document) {}

  [[nodiscard]] Status run() const {
    const Status status = check_numbers();
    return status.ok() ? check_compressed() : status;
  }

 private:
  [[nodiscard]] Error wrong(const std::string& sentence) const {
    return {ErrorCode::bad_format, fmt::format("{}: {}", path_, sentence)};
  }

  /// What tinygltf takes for left out where it is not as it should be.
  [[nodiscard]] Status check_numbers() const {
    Status status =
        each("accessor", list(document_, "accessors"),
             [&](const Json& accessor, const std::string& where) {
               Status good = whole(accessor, where, {"bufferView", "byteOffset", "count"});
               const Json sparse = accessor.value("sparse", Json::object());
               for (const char* part : {"indices", "values"}) {
                 if (!good || !sparse.is_object() || !sparse.contains(part)) continue;
                 good = whole(sparse[part], fmt::format("{}: sparse: {}", where, part),
                              {"bufferView", "byteOffset"});
               }
               return good;
             });
    if (status.ok()) {
      status =
          each("buffer view", list(document_, "bufferViews"),
               [&](const Json& view, const std::string& where) {
                 return whole(view, where, {"buffer", "byteOffset", "byteLength", "byteStride"});
               });
    }
    if (status.ok()) {
      status =
          each("mesh", list(document_, "meshes"), [&](const Json& mesh, const std::string& where) {
            return each(where + ": primitive", list(mesh, "primitives"),
                        [&](const Json& primitive, const std::string& place) {
                          return whole(primitive, place, {"indices", "mode"});
                        });
          });
    }
    if (status.ok()) {
      status =
          each("node", list(document_, "nodes"),
               [&](const Json& node, const std::string& where) { return check_node(node, where); });
    }
    return status;
  }

  [[nodiscard]] Status check_node(const Json& node, const std::string& where) const {
    struct Transform {
      const char* key;
      std::size_t count;
    };
    for (const auto& [key, count] : {Transform{"translation", 3}, Transform{"rotation", 4},
                                     Transform{"scale", 3}, Transform{"matrix", 16}}) {
      if (!node.contains(key)) continue;
      const Json& value = node[key];
      const bool numbers =
          value.is_array() && std::all_of(value.begin(), value.end(),
                                          [](const Json& number) { return number.is_number(); });
      if (numbers && value.size() == count) continue;
      return wrong(fmt::format("{}: {}: expected {} numbers, found {}", where, key, count,
                               numbers ? std::to_string(value.size()) : shortened(value.dump())));
    }
    const Json children = node.value("children", Json::array());
    const bool known = children.is_array() &&
                       std::all_of(children.begin(), children.end(),
                                   [](const Json& child) { return child.is_number_integer(); });
    if (known) return whole(node, where, {"mesh", "skin"});
    return wrong(fmt::format("{}: children: expected the numbers of nodes, found {}", where,
                             shortened(children.dump())));
  }

  /// Compressed meshes may have their data in the plain form too, and are then read.
  [[nodiscard]] Status check_compressed() const {
    const Json& accessors = list(document_, "accessors");
    const auto is_empty = [&](const Json& index) {
      if (!index.is_number_unsigned() || index.get<std::size_t>() >= accessors.size()) return false;
      const Json& accessor = accessors[index.get<std::size_t>()];
      return accessor.is_object() && !accessor.contains("bufferView") &&
             !accessor.contains("sparse");
    };
    return each("mesh", list(document_, "meshes"), [&](const Json& mesh, const std::string&) {
      return each("primitive", list(mesh, "primitives"),
                  [&](const Json& primitive, const std::string&) -> Status {
                    const std::string_view by = compression_of(primitive);
                    const Json attributes = primitive.value("attributes", Json::object());
                    const bool empty = is_empty(primitive.value("indices", Json())) ||
                                       std::any_of(attributes.begin(), attributes.end(), is_empty);
                    if (by.empty() || !empty) return ok_status();
                    return compressed(path_, by);
                  });
    });
  }

  template <class Check>
  [[nodiscard]] Status each(const std::string& what, const Json& elements, Check check) const {
    for (std::size_t i = 0; i < elements.size(); ++i) {
      if (!elements[i].is_object()) continue;
      Status status = check(elements[i], fmt::format("{} {}", what, i));
      if (!status) return status;
    }
    return ok_status();
  }

  [[nodiscard]] Status whole(const Json& object, const std::string& where,
                             std::initializer_list<const char*> keys) const {
    for (const char* key : keys) {
      const auto found = object.find(key);
      if (found == object.end() || found->is_number_unsigned()) continue;
      return wrong(fmt::format("{}: {}: expected a whole number from 0 on, found {}", where, key,
                               shortened(found->dump())));
    }
    return ok_status();
  }

  const std::string& path_;
  const Json& document_;
};

}  // namespace

const Json& list(const Json& object, std::string_view key) {
  static const Json kNone = Json::array();
  const auto found = object.find(key);
  return found != object.end() && found->is_array() ? *found : kNone;
}

bool is_compression(std::string_view extension) { return extension.ends_with(kCompression); }

std::string_view compression_of(const Json& element) {
  const auto extensions = element.find("extensions");
  if (extensions == element.end() || !extensions->is_object()) return {};
  for (auto each = extensions->begin(); each != extensions->end(); ++each) {
    if (is_compression(each.key())) return each.key();
  }
  return {};
}

Error compressed(const std::string& path, std::string_view by) {
  return {ErrorCode::bad_format,
          fmt::format("{}: compressed by {}, which is not read", path, shortened(by))};
}

Status check_elements(const std::string& path, const Json& document) {
  return ElementCheck(path, document).run();
}

}  // namespace nade::gltf
