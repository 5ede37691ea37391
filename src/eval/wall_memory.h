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
/// nearer side, which of a board that is pressed through is the wrong one. A finger that went
/// around an edge, and comes back through the wall to its hand, is out.
class WallMemory {
 public:
  explicit WallMemory(std::size_t vertices) : entries_(vertices) {}

  /// The skin is not followed into the next frame.
  void forget();

  /// The palm in the next frame, in the world; before its vertices.
  void follow_palm(const Vec3& now, const Object& object);

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
  [[nodiscard]] std::optional<double> follow(Entry& entry, const Step& step, const Object& object);
  void cross(const Object& object, const Vec3& from, const Vec3& to, Entry& entry) const;
  /// Whether what comes out there is where the hand is.
  [[nodiscard]] bool is_with_hand(const Object& object, const RayHit& out) const;

  std::vector<Entry> entries_;
  Entry palm_;
};

}  // namespace nade
