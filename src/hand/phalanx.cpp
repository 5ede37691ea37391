#include "phalanx.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nade {

// Based on: Ericson. Real-Time Collision Detection. 2005, 5.1.9.
NearestPoints nearest_of(const HandPose& hand, std::size_t one, std::size_t other) noexcept {
  const Vec3& one_start = hand.joints[one - 1].position;
  const Vec3& other_start = hand.joints[other - 1].position;
  const Vec3 one_way = hand.joints[one].position - one_start;
  const Vec3 other_way = hand.joints[other].position - other_start;
  const Vec3 between = one_start - other_start;
  const double a = one_way.squaredNorm();
  const double e = other_way.squaredNorm();
  const double f = other_way.dot(between);
  const double c = one_way.dot(between);
  const double b = one_way.dot(other_way);
  double s = 0.0;
  double t = 0.0;
  if (a > 0.0 && e > 0.0) {
    const double determinant = a * e - b * b;
    if (determinant > 0.0) s = std::clamp((b * f - c * e) / determinant, 0.0, 1.0);
    t = (b * s + f) / e;
    if (t < 0.0 || t > 1.0) {
      t = std::clamp(t, 0.0, 1.0);
      s = std::clamp((b * t - c) / a, 0.0, 1.0);
    }
  } else if (a > 0.0) {
    s = std::clamp(-c / a, 0.0, 1.0);
  } else if (e > 0.0) {
    t = std::clamp(f / e, 0.0, 1.0);
  }
  return {between + s * one_way - t * other_way, s, t};
}

std::array<double, kJointCount> phalanx_radii(const HandPose& hand, std::span<const Vec3> skin) {
  std::array<double, kJointCount> radius_m{};
  for (const std::size_t end : kPhalanges) {
    const Vec3 middle = 0.5 * (hand.joints[end - 1].position + hand.joints[end].position);
    double nearest_m = std::numeric_limits<double>::infinity();
    for (const Vec3& point : skin) nearest_m = std::min(nearest_m, (point - middle).norm());
    radius_m[end] = std::isfinite(nearest_m) ? nearest_m : 0.0;
  }
  return radius_m;
}

}  // namespace nade
