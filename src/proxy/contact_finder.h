#pragma once

#include <array>
#include <limits>
#include <optional>

#include "hand/posed_hand.h"
#include "nade/flesh.h"
#include "state.h"
#include "surface/near_objects.h"
#include "surface/scaled_surface.h"
#include "tuning.h"

namespace nade {

/// A hand that is found anew is got out of the object if it lies no deeper.
inline constexpr double kDeepest_m = kWithinReach_m;

/// A hand found anew has a term for every skin point; those for a corner's other sides are left out
/// where they would be more. The rest is for what draws near, lands and holds back.
inline constexpr std::size_t kMostTerms = kMostSkinPoints + 640;

/// What the contact finder looks for in one frame, and where.
struct ContactSearch {
  const HandFlesh& flesh;
  const ScaledSurface& object;
  const ProxyTuning& tuning;
  PosedFlesh tracked;
  std::optional<PosedFlesh> before;  ///< the last frame's drawn hand; none of one found anew
  double scale = 1.0;                ///< of the tracked hand over the flesh
  double seconds = 0.0;              ///< since the last frame
  double speed_mps = 0.0;            ///< of the tracked hand's fastest joint
  double deepest_m = -1.0;           ///< `SurfaceTouch::deepest_m`
  Vec3 up = Vec3::UnitY();   ///< unit, the side of the tracked palm that looks off the surface
  bool planes_lost = false;  ///< no pad knows its side of a wall: the palm's counts
  double reach_m = 0.0;      ///< skin nearer than this to pushing gets a term
  double sink_m = 0.0;       ///< so far in a soft object is still out
};

/// A part of the hand against the surface near it.
struct PartTouch {
  double depth_m = -std::numeric_limits<double>::infinity();  ///< of the tracked skin, the deepest
  double gap_m = std::numeric_limits<double>::infinity();     ///< of the drawn skin, the nearest
  const FleshPoint* point = nullptr;                          ///< which that is
  PadPlane plane;
};

/// The bones whose skin touches; the palm stands for all that is no phalanx, and not the thumb's.
inline constexpr std::array<Joint, 16> kBones{
    Joint::palm,          Joint::thumb_metacarpal, Joint::thumb_proximal,
    Joint::thumb_distal,  Joint::index_proximal,   Joint::index_intermediate,
    Joint::index_distal,  Joint::middle_proximal,  Joint::middle_intermediate,
    Joint::middle_distal, Joint::ring_proximal,    Joint::ring_intermediate,
    Joint::ring_distal,   Joint::little_proximal,  Joint::little_intermediate,
    Joint::little_distal};

/// Drawn skin nearer than this touches.
inline constexpr double kTouches_m = 0.001;

/// The skin of a bone against the surface near it.
struct BoneTouch {
  double depth_m = 0.0;               ///< of the tracked skin, the deepest; not below 0
  double gap_m = 0.0;                 ///< of the drawn skin, the nearest
  const FleshPoint* point = nullptr;  ///< which that is; none that may touch
  PadPlane plane;
  SurfaceHint hint;  ///< of the query that found the plane
};

/// The palm's skin against the surface.
struct PalmTouch {
  Vec3 normal = Vec3::Zero();  ///< of the surface under it, times square metres
  double depth_m = -1.0;       ///< of the tracked skin, the deepest
};

/// What one look at the surface found, besides the terms.
struct FoundContacts {
  double deepest_m = -1.0;   ///< of the tracked palmar skin below the surface
  Vec3 pull = Vec3::Zero();  ///< of all adhesion together, against it: out of the surface
  HandFreedoms even_pull = HandFreedoms::Zero();  ///< of adhesion that no step changes
  PalmTouch palm;
  std::array<PartTouch, kPartCount> parts;
  std::array<BoneTouch, kBones.size()> bones;  ///< as `kBones`
};

/// Fills `state.terms` with those of the energy that concern the surface, for a posed hand.
[[nodiscard]] FoundContacts find_contacts(const ContactSearch& search, const PosedHand& posed,
                                          ProxyState& state) noexcept;

}  // namespace nade
