#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "nade/eval/quantile.h"
#include "nade/geometry.h"

namespace nade {

/// A tracked palm that goes less far along the surface in all does not stroke it: there is nothing
/// to follow.
inline constexpr double kShortestStroke_m = 0.05;

/// How the corrected palm's velocity follows the tracked palm's, over a surface.
struct Linkage {
  std::optional<double> gain;
  std::optional<double> r;
  std::optional<double> lag_ms;
};

/// One step of both palms from a frame to the next, in the tangent plane.
struct PalmStep {
  double seconds = 0.0;  ///< > 0
  Vec3 tracked_m = Vec3::Zero();
  Vec3 corrected_m = Vec3::Zero();
};

/// Gathers what gain, correlation and lag need, in sums and a short memory.
///
/// Gain and correlation are about zero (no motion is no motion), over the pooled components of
/// the velocity. The lag is where the cross-correlation about the means is highest, within
/// 250 ms and 128 frames either way, between frames by a parabola; it has no value where the
/// velocity hardly changes, for then nothing shows a lag. Without a stroke none of them has a
/// value.
class LinkageMeter {
 public:
  void add(const PalmStep& step);
  /// The next step does not go on from the last one.
  void break_off();
  void merge(const LinkageMeter& other);
  [[nodiscard]] Linkage finish() const;

 private:
  static constexpr std::ptrdiff_t kMaxLag = 128;
  static constexpr std::size_t kLagCount = 2 * kMaxLag + 1;

  struct Velocities {
    Vec3 tracked;
    Vec3 corrected;
  };
  /// Sums over pairs of velocities some frames apart.
  struct Sums {
    double count = 0.0;
    double product = 0.0;
    double tracked_square = 0.0;
    double corrected_square = 0.0;
    Vec3 tracked = Vec3::Zero();
    Vec3 corrected = Vec3::Zero();

    void add(const Vec3& tracked_velocity, const Vec3& corrected_velocity);
    void merge(const Sums& other);
    /// About the means; none where either hardly varies.
    [[nodiscard]] std::optional<double> correlation() const;
  };
  [[nodiscard]] const Sums& at_lag(std::ptrdiff_t frames) const {
    return sums_[static_cast<std::size_t>(frames + kMaxLag)];
  }
  [[nodiscard]] std::optional<double> find_lag_frames(double frame_seconds) const;

  std::array<Sums, kLagCount> sums_{};  ///< by lag of the corrected hand, in frames
  std::array<Velocities, kMaxLag + 1> past_{};
  std::size_t newest_ = 0;  ///< in past_
  std::size_t known_ = 0;   ///< how many of past_ belong to the unbroken run
  QuantileSketch seconds_;
  double path_m_ = 0.0;  ///< of the tracked palm
};

}  // namespace nade
