#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bvh_text.h"
#include "nade/geometry.h"

namespace nade::io {

/// Positions along X, Y, Z, then turns about them.
enum class BvhChannel : std::uint8_t { x, y, z, turn_x, turn_y, turn_z };

/// A joint of a BVH file, or what ends its last bones.
struct BvhJoint {
  std::string name;                   ///< empty where it is an end
  std::optional<std::size_t> parent;  ///< stands before it
  Vec3 offset = Vec3::Zero();         ///< from the parent, at rest, in the file's unit
  std::size_t first_channel = 0;      ///< among a frame's numbers
  std::vector<BvhChannel> channels;   ///< turns in the order in which they are multiplied
  bool is_end = false;

  [[nodiscard]] bool moves() const;  ///< whether it has channels of its position
};

struct BvhSkeleton {
  std::vector<BvhJoint> joints;
  std::size_t channel_count = 0;  ///< numbers of a frame
};

/// Reads the HIERARCHY of a file, and MOTION behind it.
[[nodiscard]] Result<BvhSkeleton> read_bvh_skeleton(BvhText& text);

/// Where the joints are with all turns 0.
[[nodiscard]] std::vector<Vec3> rest_positions(const BvhSkeleton& skeleton);

/// Where the joints are in a frame, in the file's unit. `placed[i]`: of a joint that moves, its
/// position is what its channels say, not its offset and that.
[[nodiscard]] std::vector<Pose> posed(const BvhSkeleton& skeleton,
                                      const std::vector<double>& numbers,
                                      const std::vector<bool>& placed);

/// Whether what a joint's channels say of its position replaces its offset, as some programs write
/// it, or is added to it: as is nearer in this frame.
[[nodiscard]] std::vector<bool> placed_by_channels(const BvhSkeleton& skeleton,
                                                   const std::vector<double>& numbers);

}  // namespace nade::io
