#include "gltf_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <initializer_list>

#include "json_text.h"

// Based on: The Khronos Group. glTF 2.0 Specification. 2021.

namespace nade::gltf {
namespace {

using io::Json;

constexpr std::string_view kGlbMagic = "glTF";
constexpr std::size_t kGlbHeaderBytes = 12;
constexpr std::size_t kChunkHeaderBytes = 8;

/// What may be required and not read, since the shape is the same without.
constexpr std::array<std::string_view, 6> kLooks{"KHR_materials_", "KHR_texture_", "EXT_texture_",
                                                 "MSFT_texture_",  "KHR_lights_",  "KHR_xmp"};

class Document {
 public:
  Document(const std::string& path, std::string_view bytes) : path_(path), bytes_(bytes) {}

  [[nodiscard]] Status check() {
    Status status = bytes_.starts_with(kGlbMagic) ? take_chunk() : ok_status();
    if (status.ok()) status = parse();
    if (status.ok()) status = check_version();
    if (status.ok()) status = check_extensions();
    if (status.ok()) status = check_numbers();
    return status;
  }

 private:
  [[nodiscard]] Error wrong(const std::string& sentence) const {
    return {ErrorCode::bad_format, fmt::format("{}: {}", path_, sentence)};
  }

  [[nodiscard]] std::uint32_t word_at(std::size_t offset) const {
    std::uint32_t word = 0;
    std::memcpy(&word, bytes_.data() + offset, sizeof word);
    return word;
  }

  /// Leaves of a .glb file its JSON.
  [[nodiscard]] Status take_chunk() {
    const std::size_t start = kGlbHeaderBytes + kChunkHeaderBytes;
    if (bytes_.size() < start) return wrong("expected a .glb file, found it cut off");
    if (word_at(4) != 2) {
      return wrong(fmt::format("expected version 2 of the .glb form, found {}", word_at(4)));
    }
    const std::size_t size = word_at(kGlbHeaderBytes);
    if (word_at(8) > bytes_.size() || size > bytes_.size() - start) {
      return wrong(fmt::format("expected {} bytes, found {}",
                               std::max<std::size_t>(word_at(8), start + size), bytes_.size()));
    }
    const std::size_t next = start + size;
    if (bytes_.size() >= next + kChunkHeaderBytes && word_at(next) == 0) {
      return wrong("expected bytes in the chunk behind the JSON, found none");
    }
    bytes_ = bytes_.substr(start, size);
    return ok_status();
  }

  [[nodiscard]] Status parse() {
    try {
      json_ = Json::parse(bytes_);
    } catch (const Json::parse_error& error) {
      const std::string_view before =
          bytes_.substr(0, std::clamp<std::size_t>(error.byte, 1, bytes_.size() + 1) - 1);
      const auto line = 1 + std::count(before.begin(), before.end(), '\n');
      const std::size_t column = before.size() - (before.rfind('\n') + 1) + 1;
      return wrong(fmt::format("not a readable glTF file: line {}, column {}: expected valid JSON",
                               line, column));
    } catch (const Json::exception&) {
      return wrong("not a readable glTF file: expected numbers that a double can hold");
    }
    if (json_.is_object()) return ok_status();
    return wrong(
        fmt::format("not a readable glTF file: expected an object, found {}", io::kind_of(json_)));
  }

  [[nodiscard]] Status check_version() const {
    const Json asset = json_.value("asset", Json());
    const Json version = asset.is_object() ? asset.value("version", Json()) : Json();
    if (version.is_string() && version.get_ref<const std::string&>().starts_with("2.")) {
      return ok_status();
    }
    return wrong(fmt::format("asset: version: expected \"2.0\", found {}",
                             version.is_null() ? "none" : version.dump()));
  }

  [[nodiscard]] Status check_extensions() const {
    for (const Json& name : list(json_, "extensionsRequired")) {
      if (!name.is_string()) continue;
      const auto& needed = name.get_ref<const std::string&>();
      if (needed.ends_with("_compression")) {
        return wrong(fmt::format("compressed by {}, which is not read", needed));
      }
      const bool is_look = std::any_of(kLooks.begin(), kLooks.end(), [&](std::string_view look) {
        return needed.starts_with(look);
      });
      if (is_look || needed == "KHR_mesh_quantization") continue;
      return wrong(fmt::format("requires the extension {}, which is not read", needed));
    }
    return ok_status();
  }

  /// What tinygltf takes for left out where it is not as it should be.
  [[nodiscard]] Status check_numbers() const {
    Status status = each(
        "accessor", list(json_, "accessors"), [&](const Json& accessor, const std::string& where) {
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
          each("buffer view", list(json_, "bufferViews"),
               [&](const Json& view, const std::string& where) {
                 return whole(view, where, {"buffer", "byteOffset", "byteLength", "byteStride"});
               });
    }
    if (status.ok()) {
      status = each("mesh", list(json_, "meshes"), [&](const Json& mesh, const std::string& where) {
        return each(where + ": primitive", list(mesh, "primitives"),
                    [&](const Json& primitive, const std::string& place) {
                      return whole(primitive, place, {"indices", "mode"});
                    });
      });
    }
    if (status.ok()) {
      status = each("node", list(json_, "nodes"), [&](const Json& node, const std::string& where) {
        return check_node(node, where);
      });
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
                               numbers ? std::to_string(value.size()) : value.dump()));
    }
    const Json children = node.value("children", Json::array());
    const bool known = children.is_array() &&
                       std::all_of(children.begin(), children.end(),
                                   [](const Json& child) { return child.is_number_integer(); });
    if (known) return whole(node, where, {"mesh", "skin"});
    return wrong(fmt::format("{}: children: expected the numbers of nodes, found {}", where,
                             children.dump()));
  }

  /// An array of a document, empty where it has none.
  [[nodiscard]] static const Json& list(const Json& object, const char* key) {
    static const Json kNone = Json::array();
    const auto found = object.find(key);
    return found != object.end() && found->is_array() ? *found : kNone;
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
                               found->dump()));
    }
    return ok_status();
  }

  const std::string& path_;
  std::string_view bytes_;
  Json json_;
};

}  // namespace

Status check_document(const std::string& path, std::string_view bytes) {
  return Document(path, bytes).check();
}

}  // namespace nade::gltf
