#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "gltf_accessor.h"
#include "nade/io/mesh_file.h"

namespace nade::gltf {

/// What of a node an animation moves.
enum class Property : std::uint8_t { translation, rotation, scale, weights };

enum class Interpolation : std::uint8_t { step, linear, cubic };

/// How one property of one node goes over time.
struct Track {
  std::size_t node = 0;
  Property property = Property::translation;
  Interpolation interpolation = Interpolation::linear;
  std::size_t width = 3;      ///< numbers a key
  std::vector<float> times;   ///< seconds, not decreasing, at least one
  std::vector<float> values;  ///< a key's; cubic: tangent in, value, tangent out

  /// The value at a time, held before the first key and after the last. `value` holds `width`.
  void at(double time_s, std::span<double> value) const noexcept;
};

/// All animations of a model, in its order; how long each lasts is as the file says it, unchecked.
[[nodiscard]] std::vector<MeshAnimation> animations_of(const tinygltf::Model& model);

/// An animation's tracks. Channels of nodes that are not there, or of other properties, are left
/// out. `morph_targets` has the number of each node's targets.
[[nodiscard]] Result<std::vector<Track>> read_tracks(const tinygltf::Model& model,
                                                     const std::string& path,
                                                     const tinygltf::Animation& animation,
                                                     std::span<const std::size_t> morph_targets);

}  // namespace nade::gltf
