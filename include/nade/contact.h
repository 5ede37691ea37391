#pragma once

#include <array>
#include <optional>

#include "nade/hand.h"
#include "nade/hand_mesh.h"
#include "nade/surface.h"

namespace nade {

/// What is tested against the surface, Eq. (1).
enum class TestPoint : std::uint8_t {
  skin,   ///< p_j - c_j: the correction is zero at first touch and grows from there
  joint,  ///< p_j, as the paper prints it: the part jumps by c_j on entry
};

/// Which hits of a part's ray count.
enum class CountedHits : std::uint8_t {
  from_inside,  ///< only where the ray leaves the solid, and the test point lies in it
  any,          ///< the first hit, whichever way: a hand under a table jumps onto it
};

/// Where a fingertip's ray goes.
enum class FingerRay : std::uint8_t {
  hand_back,       ///< along `b`, as the palm's
  fingertip_back,  ///< along the back of that fingertip
};

/// Whether the palm's ray keeps its direction while the palm stays below the surface.
enum class PalmRay : std::uint8_t { held, follows_hand };

/// Whether a part that was pushed right through a thin wall stays on the side it came from.
enum class EntrySide : std::uint8_t { remembered, forgotten };

/// The open points of the paper's first step; the defaults are how docs/paper.md settles them.
struct ContactOptions {
  TestPoint test_point = TestPoint::skin;
  CountedHits counted_hits = CountedHits::from_inside;
  FingerRay finger_ray = FingerRay::hand_back;
  PalmRay palm_ray = PalmRay::held;
  EntrySide entry_side = EntrySide::remembered;
  /// Depth at which c_j, and with it the palm, has turned from the ray's direction to the
  /// surface normal; 0 turns at once. Metres, 0 to 0.2.
  double full_turn_depth_m = 0.015;
  /// Farther than this along its ray a part that was pushed through is free again. Metres.
  double push_through_limit_m = 0.25;
};

/// A part that touches. World frame. By method `nade` the ray begins at the tracked skin whose
/// drawn skin is the nearest to the surface, `depth_m` is the part's deepest, and `turn` stays 0.
struct PartContact {
  Vec3 ray_origin = Vec3::Zero();       ///< the tested point, in or behind the solid
  Vec3 ray_direction = Vec3::UnitY();   ///< unit
  Vec3 surface_point = Vec3::Zero();    ///< s_j
  Vec3 normal = Vec3::UnitY();          ///< out of the solid, at s_j
  Vec3 skin_direction = Vec3::UnitY();  ///< of c_j: from the ray's to the normal with depth
  Vec3 target = Vec3::Zero();           ///< p_vr_j
  double skin_depth_m = 0.0;            ///< length of c_j
  double depth_m = 0.0;                 ///< of the tracked skin below the surface
  double turn = 0.0;                    ///< 0 at first touch to 1 at the full turn's depth
};
using Contacts = std::array<std::optional<PartContact>, kPartCount>;

/// What find_contacts remembers of a hand from frame to frame, in the object's frame.
struct ContactMemory {
  std::optional<Vec3> held_palm_ray;                         ///< unit, while the palm is below
  std::array<std::optional<Vec3>, kPartCount> last_point{};  ///< s_j of the parts that touch
  std::array<SurfaceHint, kPartCount> hints{};
};

/// Step 1, Eq. (1): which parts of a usable hand touch, and where they belong. `skin` is at the
/// hand's own size.
[[nodiscard]] Contacts find_contacts(const HandPose& tracked, const SkinDepths& skin,
                                     const Object& object, const ContactOptions& options,
                                     ContactMemory& memory) noexcept;

/// The contact with its surface point at another hit, of a ray that was turned to
/// `ray_direction`.
[[nodiscard]] PartContact moved_to(PartContact contact, const Vec3& ray_direction,
                                   const RayHit& hit) noexcept;

/// The shortest rotation that takes a fraction of the way from one unit vector to another; none
/// where the first has no length.
[[nodiscard]] Quat turn_toward(const Vec3& from, const Vec3& to, double fraction) noexcept;

}  // namespace nade
