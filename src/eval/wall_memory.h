#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "nade/surface.h"

namespace nade {

/// Thicker is no wall that a hand is pressed through: in it, depth is the distance to the surface.
inline constexpr double kThickestWall_m = 0.05;
/// Farther beyond a wall nothing counts as pressed through it.
inline constexpr double kDeepestThrough_m = 0.2;

/// Where what a point is in, or beyond, was entered above it.
struct EnteredSide {
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::UnitY();
  double depth_m = 0.0;  ///< along `up`
  bool thin = false;     ///< of a wall of up to `kThickestWall_m`
};
/// `up`: unit, out of the side that was entered. No value outside of everything but what is beyond
/// a thin wall.
[[nodiscard]] std::optional<EnteredSide> side_above(const Object& object, const Vec3& point,
                                                    const Vec3& up);

/// Through which walls the vertices of a skin have gone. A closest point knows no more than the
/// nearer side, which of a board that is pressed through is the wrong one.
class WallMemory {
 public:
  explicit WallMemory(std::size_t vertices) : entries_(vertices) {}

  /// The skin is not followed into the next frame.
  void forget();

  /// A vertex in the next frame, in the world.
  struct Step {
    Vec3 now;
    Vec3 bone;             ///< in the flesh: from there comes what was not followed
    double clear_m = 0.0;  ///< no surface is nearer
  };
  /// How deep it lies in or beyond a thin wall.
  [[nodiscard]] std::optional<double> follow(std::size_t vertex, const Step& step,
                                             const Object& object);

 private:
  struct Entry {
    bool followed = false;
    bool entered = false;
    Vec3 last_object = Vec3::Zero();     ///< where it was, in the object's frame
    Vec3 normal_object = Vec3::UnitY();  ///< of the side that was entered
  };
  static void cross(const Object& object, const Vec3& from, const Vec3& to, Entry& entry);

  std::vector<Entry> entries_;
};

}  // namespace nade
