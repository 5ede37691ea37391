#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>

#include "hand/posed_hand.h"
#include "surface/scaled_surface.h"

namespace nade {

// What stands in for the surface near a pad of skin.

/// The local plane that stands in for the surface near a pad.
struct PadPlane {
  Vec3 middle = Vec3::Zero();  ///< of the pad, for which it was found
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::UnitY();  ///< unit, out of the solid
};

/// The sides of an inside corner besides the nearest: three meet in a point.
struct OtherSides {
  std::array<PadPlane, 2> planes;
  std::size_t count = 0;

  [[nodiscard]] std::span<const PadPlane> seen() const noexcept { return {planes.data(), count}; }
};

/// What is remembered of a pad.
struct PadMemory {
  SurfaceHint hint;
  std::optional<PadPlane> plane;
  OtherSides beside;              ///< of the inside corner that it is in
  Vec3 seen_from = Vec3::Zero();  ///< where it, or one whose ball it shares, looked from last
  Vec3 outward = Vec3::Zero();    ///< unit, off the surface, where it was too far; zero elsewhere
  double curvature = 0.0;         ///< there, along the way that the pad went, 1/m; convex above 0
  double same_m = 0.0;            ///< the plane serves within this of there; below 0: no more
  bool is_side_lost = false;      ///< it had one of what has moved since: the palm's side counts
  double clearance_m = 0.0;       ///< there; more where its skin faces away
  double free_m = 0.0;            ///< what was left of that when last seen, plus `travel_m` then
  /// By how much the tracked hand's pad is out of the object at the least, plus `way_m`.
  double out_until_m = -std::numeric_limits<double>::infinity();
};

/// The surface's normal at its point nearest to `from`, unit: its own where that runs smoothly,
/// the direction to `from` at an edge or a tip, where its own turns in a moment.
[[nodiscard]] Vec3 outward_normal(const SurfacePoint& nearest, const Vec3& from) noexcept;

/// A ball that no surface is in.
struct FreeBall {
  Vec3 middle = Vec3::Zero();
  double radius_m = 0.0;
};

/// The last few free balls that were found. What is far for one pad often is for its neighbours.
class FreeBalls {
 public:
  void add(const FreeBall& ball) noexcept { balls_[next_++ % balls_.size()] = ball; }
  /// The one that leaves the most room around a point, if that is more than `room_m`.
  [[nodiscard]] const FreeBall* around(const Vec3& point, double room_m) const noexcept;

 private:
  std::array<FreeBall, 8> balls_{};
  std::size_t next_ = 0;
};

/// How the pads of a hand look at the surface in one round.
struct PadLooks {
  const ScaledSurface& object;
  const PosedFlesh* before;  ///< the last frame's hand, if any
  Vec3 palm = Vec3::Zero();
  bool are_sides_lost = false;  ///< of a hand found anew: the palm's counts
  double travel_m = 0.0;        ///< `ProxyState::travel_m`
  FreeBalls free;
};

/// How much of a pad's clearance is left, at least, that has its middle there now; metres.
[[nodiscard]] double left_of(const Vec3& middle, double travel_m, PadMemory& known) noexcept;

/// Whether a pad whose middle is there now is within `reach_m`; its plane then is found anew, or as
/// it was. Where a thin wall is between it and the palm of a hand found anew, the palm's side of it
/// counts; where a wall is on the way that it came since the last frame, the side that it came
/// from.
[[nodiscard]] bool find_plane(PadLooks& looks, const FleshPoint& point, const Vec3& middle,
                              double reach_m, PadMemory& known) noexcept;

/// The plane for a pad that has gone on since its own was found, over a surface that goes on to
/// bend as it did on the way there.
[[nodiscard]] PadPlane bent_plane(const PadMemory& known, const Vec3& middle) noexcept;

/// How far a pad may go on with its plane whose skin is so far from the surface; metres.
[[nodiscard]] double plane_serves(const PadMemory& known, double gap_m) noexcept;

}  // namespace nade
