#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "nade/surface.h"

namespace nade {

/// Several objects as one: what a hand may touch at the same time, or slide over to, as a ball on a
/// table. Where they stand is in the group's frame; most simply that is the world's, or a vehicle's
/// where they go along with one: what goes by at several metres a second is met anew in each frame.
///
/// For a few that belong together, as the parts of a thing, and where a `Surface` is wanted. A
/// query asks all of them: of many, or where several move, make a `Scene`, which finds what is near
/// the hand by itself.
///
/// Solids that overlap are one: outside of them all answers are exact; inside two of them the depth
/// is that in the one that is entered deeper, and a ray from inside one ends at its surface, also
/// within another.
class SurfaceGroup final : public Surface {
 public:
  static constexpr std::size_t kMostMembers = 255;

  /// Up to `kMostMembers`. Their surfaces must outlive the group.
  explicit SurfaceGroup(std::vector<Object> members);

  [[nodiscard]] std::span<const Object> members() const { return members_; }

  /// Moves, turns or scales a member. A hand on it rides along; while one moves, nothing of the
  /// surface is remembered from frame to frame. Where it stands already costs nothing. Does not
  /// allocate. Not while another thread queries.
  void place(std::size_t member, const Placement& placement) noexcept;

  [[nodiscard]] std::optional<RayHit> first_hit(const Ray& ray) const noexcept override;
  [[nodiscard]] std::optional<SurfacePoint> closest_point(
      const Vec3& query, double max_distance, SurfaceHint& hint) const noexcept override;
  [[nodiscard]] std::uint64_t shape() const noexcept override;
  /// Of all members, where each of them has some.
  [[nodiscard]] std::optional<SurfaceBounds> bounds() const noexcept override;

 private:
  std::vector<Object> members_;
  std::uint64_t placing_;  ///< another number whenever one is placed
};

}  // namespace nade
