#include "gltf_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <map>
#include <utility>

#include "gltf_check.h"
#include "gltf_resource.h"

// Based on: The Khronos Group. glTF 2.0 Specification. 2021.

namespace nade::gltf {
namespace {

using io::Json;

constexpr std::string_view kGlbMagic = "glTF";
constexpr std::size_t kGlbHeaderBytes = 12;
constexpr std::size_t kChunkHeaderBytes = 8;
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;
constexpr std::uint32_t kBinaryChunk = 0x004E4942;

/// What may be required and not read, since the shape is the same without: how the names begin.
constexpr std::array<std::string_view, 32> kShapeless{"ADOBE_materials_",
                                                      "AGI_",
                                                      "CESIUM_primitive_outline",
                                                      "EXT_instance_features",
                                                      "EXT_lights_",
                                                      "EXT_materials_",
                                                      "EXT_mesh_features",
                                                      "EXT_mesh_manifold",
                                                      "EXT_structural_metadata",
                                                      "EXT_texture_",
                                                      "FB_geometry_metadata",
                                                      "GODOT_",
                                                      "KHR_animation_pointer",
                                                      "KHR_audio",
                                                      "KHR_collision_shapes",
                                                      "KHR_implicit_shapes",
                                                      "KHR_interactivity",
                                                      "KHR_lights_",
                                                      "KHR_materials_",
                                                      "KHR_node_hoverability",
                                                      "KHR_node_selectability",
                                                      "KHR_physics_",
                                                      "KHR_technique",
                                                      "KHR_texture_",
                                                      "KHR_xmp",
                                                      "MSFT_lod",
                                                      "MSFT_packing_",
                                                      "MSFT_texture_",
                                                      "NV_materials_",
                                                      "OMI_",
                                                      "VRM",
                                                      "XMP"};
/// What is read.
constexpr std::array<std::string_view, 2> kRead{"KHR_mesh_quantization", "KHR_node_visibility"};

/// What of a file is handed on to tinygltf.
constexpr std::array<std::string_view, 12> kUsed{"accessors", "animations", "asset",  "bufferViews",
                                                 "buffers",   "materials",  "meshes", "nodes",
                                                 "scene",     "scenes",     "skins",  "textures"};

/// Buffers that may have one file between them: a short file could be named any number of times.
constexpr int kMostUses = 16;

/// Elements of one kind that a file may have, and more for each of its bytes: "{}," is all that
/// an element of some hundred bytes takes in it.
constexpr std::size_t kMostElements = 100'000;
constexpr std::size_t kMostMaterials = 10'000;
constexpr std::size_t kBytesPerElement = 32;
constexpr std::size_t kBytesPerMaterial = 256;

/// Without what is never read. No deeper than `check_json_size` lets it be.
void strip(Json& value) {
  if (value.is_object()) {
    value.erase("extras");
    value.erase("extensions");
  }
  if (!value.is_structured()) return;
  for (Json& element : value) strip(element);
}

bool is_hidden(const Json& node) {
  static const Json::json_pointer kVisible("/extensions/KHR_node_visibility/visible");
  return node.is_object() && node.contains(kVisible) && node[kVisible] == false;
}

class DocumentReader {
 public:
  DocumentReader(const std::string& path, std::string_view bytes)
      : path_(path), size_(bytes.size()), bytes_(bytes) {}

  [[nodiscard]] Result<Document> read() {
    Status status = bytes_.starts_with(kGlbMagic) ? take_chunks() : ok_status();
    if (status.ok()) status = parse();
    if (status.ok()) status = check_version();
    if (status.ok()) status = check_extensions();
    if (status.ok()) status = check_counts();
    if (status.ok()) status = check_elements(path_, document_.json);
    if (status.ok()) status = read_buffers();
    if (!status) return status.error();
    leave_used();
    return std::move(document_);
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

  /// Leaves of a .glb file its JSON, and the buffer behind it.
  [[nodiscard]] Status take_chunks() {
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
    if (word_at(kGlbHeaderBytes + 4) != kJsonChunk) {
      return wrong("expected JSON in the first chunk, found another kind");
    }
    const std::size_t next = start + size;
    if (bytes_.size() >= next + kChunkHeaderBytes) {
      const std::size_t room = bytes_.size() - next - kChunkHeaderBytes;
      if (word_at(next) == 0) {
        return wrong("expected bytes in the chunk behind the JSON, found none");
      }
      if (word_at(next + 4) != kBinaryChunk || word_at(next) > room) {
        return wrong(fmt::format(
            "expected a binary chunk of {} bytes behind the JSON, found another kind or fewer",
            word_at(next)));
      }
      chunk_ = bytes_.substr(next + kChunkHeaderBytes, word_at(next));
    }
    bytes_ = bytes_.substr(start, size);
    return ok_status();
  }

  [[nodiscard]] Status parse() {
    // How many values there may be is said by what they stand for: `check_counts`.
    const Status depth = io::check_json_size(bytes_, std::numeric_limits<std::size_t>::max());
    if (!depth) return wrong(depth.error().message);
    try {
      document_.json = Json::parse(bytes_);
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
    if (document_.json.is_object()) return ok_status();
    return wrong(fmt::format("not a readable glTF file: expected an object, found {}",
                             io::kind_of(document_.json)));
  }

  [[nodiscard]] Status check_version() const {
    const Json asset = document_.json.value("asset", Json());
    const Json version = asset.is_object() ? asset.value("version", Json()) : Json();
    if (version.is_string() && version.get_ref<const std::string&>().starts_with("2.")) {
      return ok_status();
    }
    return wrong(fmt::format("asset: version: expected \"2.0\", found {}",
                             version.is_null() ? "none" : shortened(version.dump())));
  }

  [[nodiscard]] Status check_extensions() const {
    for (const Json& name : list(document_.json, "extensionsRequired")) {
      if (!name.is_string()) continue;
      const auto& needed = name.get_ref<const std::string&>();
      if (is_compression(needed)) return compressed(path_, needed);
      const bool is_shapeless =
          std::any_of(kShapeless.begin(), kShapeless.end(),
                      [&](std::string_view begin) { return needed.starts_with(begin); });
      const bool is_read = std::find(kRead.begin(), kRead.end(), needed) != kRead.end();
      if (is_shapeless || is_read) continue;
      return wrong(fmt::format("requires the extension {}, which is not read", shortened(needed)));
    }
    return ok_status();
  }

  [[nodiscard]] Status check_counts() const {
    for (const std::string_view key : kUsed) {
      const bool is_small = key != "materials";
      const std::size_t most = is_small ? kMostElements + size_ / kBytesPerElement
                                        : kMostMaterials + size_ / kBytesPerMaterial;
      const std::size_t count = list(document_.json, key).size();
      if (count > most) {
        return wrong(fmt::format("{}: expected at most {}, found {}", key, most, count));
      }
    }
    return ok_status();
  }

  /// Reads the buffers, and numbers them in the place of their uris.
  [[nodiscard]] Status read_buffers() {
    if (!document_.json.contains("buffers")) return ok_status();
    Json& buffers = document_.json["buffers"];
    if (!buffers.is_array()) return ok_status();
    for (std::size_t i = 0; i < buffers.size(); ++i) {
      if (!buffers[i].is_object()) return wrong(fmt::format("buffer {}: expected an object", i));
      const Status status = read_buffer(fmt::format("buffer {}", i), buffers[i]);
      if (!status) return status;
      buffers[i]["uri"] = std::to_string(i);
    }
    return ok_status();
  }

  [[nodiscard]] Status read_buffer(const std::string& where, const Json& buffer) {
    const auto length = buffer.find("byteLength");
    if (length == buffer.end() || !length->is_number_unsigned()) {
      return wrong(fmt::format("{}: byteLength: expected a whole number", where));
    }
    const auto uri = buffer.find("uri");
    std::string bytes;
    if (uri != buffer.end() && uri->is_string() && !uri->get_ref<const std::string&>().empty()) {
      Result<Resource> resource = read_resource(path_, where, uri->get_ref<const std::string&>());
      if (!resource) return resource.error();
      if (!resource->file.empty() && ++uses_[resource->file] > kMostUses) {
        return wrong(fmt::format("{}: expected at most {} buffers of one file, found more", where,
                                 kMostUses));
      }
      bytes = std::move(resource->bytes);
    } else if (!chunk_.empty()) {
      bytes = std::exchange(chunk_, {});
    } else if (const std::string_view by = compression_of(buffer); !by.empty()) {
      return compressed(path_, by);
    } else {
      return wrong(
          fmt::format("{}: expected a uri that says where its bytes are, found none", where));
    }
    const auto needed = length->get<std::size_t>();
    if (bytes.size() < needed || needed == 0) {
      return wrong(fmt::format("{}: expected {} bytes, found {}", where,
                               std::max<std::size_t>(needed, 1), bytes.size()));
    }
    bytes.resize(needed);
    document_.buffers.push_back(std::move(bytes));
    return ok_status();
  }

  void leave_used() {
    static const Json::json_pointer kRepeated("/extensions/" + std::string(kInstancing));
    Json& all = document_.json;
    document_.pictures = list(all, "images");
    Json used = Json::object();
    for (const std::string_view key : kUsed) {
      const auto found = all.find(key);
      if (found == all.end()) continue;
      Json& kept = used[std::string(key)] = std::move(*found);
      if (key != "nodes" || !kept.is_array()) {
        strip(kept);
        continue;
      }
      for (Json& node : kept) {
        const bool hidden = is_hidden(node);
        const bool repeated = node.contains(kRepeated);
        strip(node);
        if (hidden) node["extensions"]["KHR_node_visibility"]["visible"] = false;
        if (repeated) node[kRepeated] = Json::object();
      }
    }
    all = std::move(used);
    if (!all.contains("animations")) return;
    for (Json& animation : all["animations"]) leave_channels_of_nodes(animation);
  }

  /// What moves something else, as a light, has no node, which tinygltf asks for.
  static void leave_channels_of_nodes(Json& animation) {
    if (!animation.is_object()) return;
    Json left = Json::array();
    for (const Json& channel : list(animation, "channels")) {
      const bool other = channel.is_object() && channel.contains("target") &&
                         channel["target"].is_object() && !channel["target"].contains("node");
      if (!other) left.push_back(channel);
    }
    animation["channels"] = std::move(left);
  }

  const std::string& path_;
  std::size_t size_;
  std::string_view bytes_;
  std::string_view chunk_;  ///< of a .glb file, until a buffer has it
  std::map<std::filesystem::path, int> uses_;
  Document document_;
};

}  // namespace

Result<Document> read_document(const std::string& path, std::string_view bytes) {
  return DocumentReader(path, bytes).read();
}

}  // namespace nade::gltf
