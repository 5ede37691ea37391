#include "nade/surface_group.h"

#include <utility>

#include "member_hint.h"
#include "nade/assert.h"
#include "surface_query.h"

namespace nade {

SurfaceGroup::SurfaceGroup(std::vector<Object> members)
    : members_(std::move(members)), placing_(new_shape()) {
  static_assert(SurfaceGroup::kMostMembers == nade::kMostMembers);
  NADE_ASSERT(members_.size() <= kMostMembers);
}

void SurfaceGroup::place(std::size_t member, const Placement& placement) noexcept {
  NADE_ASSERT(member < members_.size());
  const Object before = members_[member];
  members_[member] = Object(before.surface(), placement, before.identity().instance);
  if (members_[member].placement() != before.placement()) placing_ = new_shape();
}

std::optional<RayHit> SurfaceGroup::first_hit(const Ray& ray) const noexcept {
  std::optional<RayHit> first;
  if (!is_query(ray)) return first;
  for (const Object& member : members_) {
    const double reach = first ? first->distance : ray.max_distance;
    const auto hit = member.first_hit({ray.origin, ray.direction, reach});
    if (hit && (!first || hit->distance < first->distance)) first = hit;
  }
  return first;
}

std::optional<SurfacePoint> SurfaceGroup::closest_point(const Vec3& query, double max_distance,
                                                        SurfaceHint& hint) const noexcept {
  std::optional<SurfacePoint> deepest;
  if (!is_query(query, max_distance)) return deepest;
  const SurfaceHint before = hint;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    SurfaceHint its = hint_in(i, before);
    const auto found = members_[i].closest_point(query, max_distance, its);
    if (!found || (deepest && found->signed_distance >= deepest->signed_distance)) continue;
    deepest = found;
    hint = hint_for_all(i, its);
  }
  return deepest;
}

std::optional<SurfaceBounds> SurfaceGroup::bounds() const noexcept {
  std::optional<SurfaceBounds> all;
  for (const Object& member : members_) {
    const Placement& placement = member.placement();
    if (placement.scale == 0.0) continue;
    const std::optional<SurfaceBounds> its = member.surface().bounds();
    if (!its) return std::nullopt;
    for (unsigned corner = 0; corner < 8; ++corner) {
      const auto end = [&](Eigen::Index axis) {
        return (corner >> axis & 1U) != 0 ? its->high[axis] : its->low[axis];
      };
      const Vec3 point = placement.to_world({end(0), end(1), end(2)});
      if (!all) all = SurfaceBounds{point, point};
      all->low = all->low.cwiseMin(point);
      all->high = all->high.cwiseMax(point);
    }
  }
  return all ? all : SurfaceBounds{};
}

std::uint64_t SurfaceGroup::shape() const noexcept {
  std::uint64_t mixed = placing_;
  for (const Object& member : members_) mixed = with_shape(mixed, member.surface().shape());
  return mixed;
}

}  // namespace nade
