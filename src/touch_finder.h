#pragma once

#include <array>
#include <limits>
#include <optional>

#include "nade/flesh.h"
#include "nade/settle.h"
#include "posed_hand.h"
#include "settle_frame.h"

namespace nade {

/// A hand found anew has a row for every skin point; those for a corner's other sides are left out
/// where they would be more. Then there are those that draw near, two for what is nearest, what
/// holds back the wrist and the digits, and what digits climb.
inline constexpr std::size_t kMostSkinRows = kMostSkinPoints;
inline constexpr std::size_t kMostContactRows = kMostSkinRows + kPulls + 1 + 1 + 2 * kDigitCount;

/// A patch of skin, drawn and tracked, against the surface near it.
struct PatchTouch {
  double gap_m = std::numeric_limits<double>::infinity();
  double depth_m = -std::numeric_limits<double>::infinity();  ///< of the tracked patch
  const FleshPoint* point = nullptr;                          ///< of the drawn one, the nearest
  Vec3 surface_point = Vec3::Zero();
  Vec3 normal = Vec3::UnitY();
  double curvature = 0.0;  ///< 1/m
  double cushion_m = 0.0;  ///< as of ContactRow
};
/// Each part's patch, and all skin: its point that is nearest to the surface, and the depth of its
/// deepest.
using PatchTouches = std::array<PatchTouch, kPulls>;
inline constexpr std::size_t kNearestSkin = kPartCount;

/// No surface is looked for farther away: a hand that is found anew is got out of the object if it
/// lies no deeper.
inline constexpr double kDeepest_m = 0.3;

/// From farther than this a patch is not drawn to the surface.
inline constexpr double kPullReach_m = 0.050038;

/// How many times as strong as on a calm hand each pull is.
using PullStrengths = std::array<double, kPulls>;

/// What a frame's rounds look for, and where.
struct TouchSearch {
  const HandFlesh& flesh;
  const ScaledSurface& object;
  PosedFlesh tracked;
  /// The last frame's drawn hand; none for a hand found anew.
  std::optional<PosedFlesh> before;
  double scale = 1.0;            ///< of the tracked hand over the flesh
  double seconds = 0.0;          ///< since the last frame
  PullStrengths pulls_before{};  ///< `ContactState::pulls` of the last frame
  PullStrengths strengths{};
  bool pulls = true;         ///< whether more is drawn to the surface than what is nearest
  JointVectors velocity{};   ///< of the tracked joints, smoothed
  double speed_mps = 0.0;    ///< of the tracked hand's fastest joint
  double nearest_m = 0.0;    ///< `ContactState::nearest_m`
  double deepest_m = 0.0;    ///< `ContactState::deepest_m`
  Vec3 push = Vec3::Zero();  ///< unit, or zero in the air
  double row_reach_m = 0.0;  ///< skin nearer than this gets a row
  double sink_m = 0.0;       ///< so far in is still out
  Eigen::Matrix3d frame = Eigen::Matrix3d::Identity();  ///< in which the rows' wrist is counted
};

/// Fills `memory.rows` and `memory.contact.pulls` for a posed hand.
[[nodiscard]] PatchTouches find_touches(const TouchSearch& search, const PosedHand& posed,
                                        SettleMemory& memory) noexcept;

}  // namespace nade
