#include "nade/dent.h"

#include <algorithm>
#include <cmath>

#include "nade/assert.h"
#include "ramps.h"

namespace nade {
namespace {

using Vec3f = Eigen::Vector3f;

constexpr double kSearch_m = 0.05;
/// Below the skin by this, so that the two do not flicker.
constexpr double kClear_m = 0.0002;
/// A vertex off a spot's plane counts as so many times farther than one along it: the far side of
/// an ear is not pressed in with the near one.
constexpr float kAcross = 2.5F;

}  // namespace

std::size_t find_dent_spots(const Object& object, std::span<const Vec3f> skin,
                            std::span<DentSpot> spots) noexcept {
  NADE_ASSERT(spots.size() >= skin.size());
  std::size_t count = 0;
  SurfaceHint hint;
  for (const Vec3f& vertex : skin) {
    const auto near = object.closest_point(vertex.cast<double>(), kSearch_m, hint);
    if (!near || !(near->signed_distance < 0.0)) continue;
    spots[count++] = {near->point, near->normal, -near->signed_distance};
  }
  return count;
}

void dent(std::span<const DentSpot> spots, const DentOptions& options,
          std::span<const Vec3f> vertices, std::span<Vec3f> dented) noexcept {
  NADE_ASSERT(dented.size() == vertices.size());
  NADE_ASSERT(options.plateau_m >= 0.0 && options.falloff_m > options.plateau_m);
  if (dented.data() != vertices.data()) {
    std::copy(vertices.begin(), vertices.end(), dented.begin());
  }
  const auto plateau = static_cast<float>(options.plateau_m);
  const auto falloff = static_cast<float>(options.falloff_m);
  Eigen::AlignedBox3f near;
  for (const DentSpot& spot : spots) near.extend(spot.point.cast<float>());
  for (Vec3f& vertex : dented) {
    if (!(near.squaredExteriorDistance(vertex) < falloff * falloff)) continue;
    float depth = 0.0F;
    Vec3f push = Vec3f::Zero();
    for (const DentSpot& spot : spots) {
      const Vec3f normal = spot.normal.cast<float>();
      const Vec3f away = vertex - spot.point.cast<float>();
      const float along_normal = normal.dot(away);
      const float squared =
          away.squaredNorm() + (kAcross * kAcross - 1.0F) * along_normal * along_normal;
      if (!(squared < falloff * falloff)) continue;
      const float share = smoothstep(falloff, plateau, std::sqrt(squared));
      const auto clear = static_cast<float>(std::min(kClear_m, spot.depth_m));
      const float wanted =
          share * (static_cast<float>(std::min(spot.depth_m, options.deepest_m)) + clear);
      depth = std::max(depth, wanted);
      push += wanted * share * normal;
    }
    const float length = push.norm();
    if (length > 0.0F) vertex -= depth / length * push;
  }
}

}  // namespace nade
