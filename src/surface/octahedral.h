#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>

// Based on: Cigolle et al. A Survey of Efficient Representations for Independent Unit Vectors.
// 2014.

namespace nade::detail {

/// A direction in four bytes, to 0.003 degrees: the sphere unfolded over an octahedron.
struct Octahedral {
  std::int16_t u;
  std::int16_t v;
};

inline constexpr float kOctahedralScale = 32767.0F;

/// `direction` must not be zero.
[[nodiscard]] inline Octahedral to_octahedral(const Eigen::Vector3f& direction) {
  const Eigen::Vector3f on = direction / direction.cwiseAbs().sum();
  float u = on.x();
  float v = on.y();
  if (on.z() < 0.0F) {
    u = std::copysign(1.0F - std::abs(on.y()), on.x());
    v = std::copysign(1.0F - std::abs(on.x()), on.y());
  }
  // `lround`, without the call.
  const auto whole = [](float x) {
    return static_cast<std::int16_t>(x * kOctahedralScale + std::copysign(0.5F, x));
  };
  return {whole(u), whole(v)};
}

/// Not normalised: its coordinates' magnitudes sum to 1.
[[nodiscard]] inline Eigen::Vector3d from_octahedral(Octahedral octahedral) {
  const double u = static_cast<double>(octahedral.u) / static_cast<double>(kOctahedralScale);
  const double v = static_cast<double>(octahedral.v) / static_cast<double>(kOctahedralScale);
  const double z = 1.0 - std::abs(u) - std::abs(v);
  const double fold = std::max(-z, 0.0);
  return Eigen::Vector3d(u - std::copysign(fold, u), v - std::copysign(fold, v), z);
}

}  // namespace nade::detail
