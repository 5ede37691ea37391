#pragma once

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <numbers>
#include <random>
#include <string>

#include "nade/geometry.h"

namespace nade::test {

/// NADE_TEST_SEED where it is set, so that a failure can be tried again.
inline std::uint32_t seed() {
  const char* text = std::getenv("NADE_TEST_SEED");
  return text != nullptr ? static_cast<std::uint32_t>(std::stoul(text)) : 20231U;
}

/// Random numbers that are the same on every machine, unlike those of <random>'s distributions.
class Random {
 public:
  explicit Random(std::uint32_t start = seed()) : engine_(start) {}

  /// In [0, 1).
  double uniform() { return static_cast<double>(engine_()) * 0x1p-32; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  std::uint32_t below(std::uint32_t count) {
    return static_cast<std::uint32_t>(uniform() * static_cast<double>(count));
  }

  /// Uniform over the unit sphere.
  Vec3 direction() {
    const double y = uniform(-1.0, 1.0);
    const double turn = uniform(0.0, 2.0 * std::numbers::pi);
    const double r = std::sqrt(1.0 - y * y);
    return {r * std::cos(turn), y, r * std::sin(turn)};
  }
  /// Uniform in the box.
  Vec3 point(const Vec3& low, const Vec3& high) {
    return {uniform(low.x(), high.x()), uniform(low.y(), high.y()), uniform(low.z(), high.z())};
  }
  /// Uniform over rotations.
  Quat rotation() {
    const double u = uniform();
    const double a = uniform(0.0, 2.0 * std::numbers::pi);
    const double b = uniform(0.0, 2.0 * std::numbers::pi);
    return {std::sqrt(u) * std::cos(b), std::sqrt(1.0 - u) * std::sin(a),
            std::sqrt(1.0 - u) * std::cos(a), std::sqrt(u) * std::sin(b)};
  }

 private:
  std::mt19937 engine_;
};

}  // namespace nade::test
