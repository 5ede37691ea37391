#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "nade/geometry.h"
#include "nade/skeleton.h"

namespace nade {

/// Which tracker's errors a synthetic hand bears. Errors are a rigid motion of the hand and small
/// joint angles, so that bones keep their lengths, as trackers that fit a hand model keep them.
enum class NoiseModel : std::uint8_t {
  none,
  /// Headset cameras: slow errors of 1 to 2 mm (0.1 to 1 Hz), growing toward the fingertips, and
  /// about 0.5 mm from frame to frame.
  quest,
  /// Leap Motion: a palm that drifts by 5 to 10 mm over many seconds, below 0.5 mm of jitter.
  leap,
};

/// "none", "quest", "leap".
[[nodiscard]] std::string_view name_of(NoiseModel model);
[[nodiscard]] std::optional<NoiseModel> noise_from_name(std::string_view name);

/// Random numbers that are the same on every machine: SplitMix64.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  /// 64 random bits.
  std::uint64_t next();
  /// Uniform, 0 up to but not 1.
  double uniform();
  /// Normal, mean 0, deviation 1: Box-Muller.
  double normal();

 private:
  std::uint64_t state_;
};

/// What a tracker gets wrong in one frame.
struct TrackerError {
  Pose palm;            ///< of the whole hand, in the palm's frame, as a right hand has it
  HandAngles angles{};  ///< to be added to the hinges'
};

/// The errors of one hand in one recording, frame by frame. The same model, seed and times give
/// the same errors.
class TrackerNoise {
 public:
  TrackerNoise(NoiseModel model, std::uint64_t seed);

  /// The next frame's, at `time_s`; nothing wrong for `NoiseModel::none`.
  [[nodiscard]] TrackerError next(double time_s);

 private:
  /// A sum of sines of random frequencies and phases: smooth, and independent of the frame rate.
  struct SlowError {
    static constexpr std::size_t kSines = 4;
    std::array<double, kSines> rad_per_s{};
    std::array<double, kSines> phase{};
    [[nodiscard]] double at(double time_s) const;  ///< mean 0, deviation 1
  };
  static constexpr std::size_t kMotions = 6;                                  // 3 shifts, 3 turns
  static constexpr std::size_t kHinges = kDigitCount * kHingeCount;           // each flexes
  static constexpr std::size_t kChannels = kMotions + kHinges + kDigitCount;  // each digit abducts

  NoiseModel model_;
  Random random_;
  std::array<SlowError, kChannels> slow_;
};

}  // namespace nade
