#pragma once

#include <tiny_gltf.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "nade/status.h"

namespace nade::gltf {

/// Reads a .glb or .gltf file, told apart by content, with its buffers but without its pictures'
/// bytes. Of a node's extensions there is KHR_node_visibility, where it hides the node. A file that
/// would have much more decoded than it has bytes is refused.
[[nodiscard]] Result<tinygltf::Model> read_model(const std::string& path);

/// The bytes of a picture of the model as the file has them, PNG or JPEG.
[[nodiscard]] Result<std::string> read_picture(const tinygltf::Model& model,
                                               const std::string& path, std::size_t index);

/// What of a model is being read, for the sentence of an error.
struct AccessorRef {
  const tinygltf::Model& model;
  const std::string& path;
  const char* what;  ///< "POSITION", …
  int index;         ///< of the accessor, as the file has it
};

/// All numbers of an accessor, `components` to an element (3 for VEC3, 16 for MAT4); integers
/// become fractions where the accessor says so. Checked against the buffer's real size.
[[nodiscard]] Result<std::vector<float>> read_floats(const AccessorRef& ref, int components);

/// As `read_floats`, for unsigned integers.
[[nodiscard]] Result<std::vector<std::uint32_t>> read_integers(const AccessorRef& ref,
                                                               int components);

/// Four of the bones of every vertex, vertex after vertex. No weight is below 0, and a bone that
/// weighs nothing may be any.
struct BoneSet {
  std::vector<std::uint32_t> joints;  ///< of the skin, unchecked
  std::vector<float> weights;
};

/// How many sets of JOINTS_n and WEIGHTS_n a primitive has: at least one, which may be missing.
[[nodiscard]] std::size_t count_bone_sets(const tinygltf::Primitive& primitive);

/// Reads JOINTS_`set` and WEIGHTS_`set`, one element for each of so many vertices.
[[nodiscard]] Result<BoneSet> read_bone_set(const tinygltf::Model& model, const std::string& path,
                                            const tinygltf::Primitive& primitive, std::size_t set,
                                            std::size_t vertices);

}  // namespace nade::gltf
