#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "nade/settle.h"
#include "settle_frame.h"

namespace nade {

// What stands in for the surface near a pad of skin.

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
  std::optional<Vec3> palm;  ///< of a hand found anew
  double travel_m = 0.0;     ///< `SettleMemory::travel_m`
  FreeBalls free;
};

/// How much of a pad's clearance is left, at least, that has its middle there now; metres.
[[nodiscard]] double left_of(const Vec3& middle, double travel_m, PadMemory& known) noexcept;

/// Whether a pad is within `reach_m`; its plane then is found anew, or as it was. Where a thin wall
/// is between it and the palm of a hand found anew, the palm's side of it counts; where a wall is
/// on the way that it came since the last frame, the side that it came from.
[[nodiscard]] bool find_plane(PadLooks& looks, const Vec3& middle, const Vec3& way, double reach_m,
                              PadMemory& known) noexcept;

/// The plane for a pad that has gone on since its own was found, over a surface that goes on to
/// bend as it did on the way there.
[[nodiscard]] PadPlane bent_plane(const PadMemory& known, const Vec3& middle) noexcept;

/// How far a pad may go on with its plane whose skin is so far from the surface; metres.
[[nodiscard]] double plane_serves(const PadMemory& known, double gap_m) noexcept;

}  // namespace nade
