#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "nade/hand_check.h"
#include "warnings.h"

namespace nade::io {

/// Values of a whole recording in memory that does not grow: every one, then every second, every
/// fourth …
class ThinnedValues {
 public:
  void add(double value);
  [[nodiscard]] std::optional<double> median() const;

 private:
  std::vector<double> kept_;
  std::size_t stride_ = 1;
  std::size_t seen_ = 0;
};

/// "centimetres", … by a unit's size.
[[nodiscard]] std::string_view name_of_length_unit(double unit_m);

/// Takes in the hands and times of a recording, and says at its end whether they are of another
/// convention than ours.
class HandIntake {
 public:
  /// Where the rotations come from: those inferred from the points follow the hand's side.
  enum class Rotations { read, inferred };

  /// `tick_s`: the unit that the file's times are expected in, 1, 1e-3, 1e-6 or 1e-9.
  explicit HandIntake(double tick_s, Rotations rotations = Rotations::read)
      : tick_s_(tick_s), rotations_(rotations) {}

  /// Makes rotations unit. False, with a warning, where the hand cannot be used even so. `place`
  /// is what warnings name ("clip.jsonl: line 3").
  [[nodiscard]] bool admit(HandPose& hand, const std::string& place, Warnings& warnings);
  /// The time of the next frame.
  void add_time(std::int64_t time_ns);

  /// What most frames make doubtful so far, a sentence each that begins with `name`.
  [[nodiscard]] std::vector<std::string> doubts(const std::string& name) const;

 private:
  struct Side {
    std::size_t hands = 0;
    std::size_t odd_lengths = 0;
    std::array<std::size_t, kHandCauseCount> causes{};  ///< of the rotations
    std::array<std::optional<HandCheck>, kHandCauseCount> first{};
    ThinnedValues length_m;
    ThinnedValues bone_angle_rad;
  };

  void judge(const HandPose& hand);
  [[nodiscard]] std::optional<std::string> doubt_of_time() const;

  double tick_s_;
  Rotations rotations_;
  std::array<Side, 2> sides_;  ///< by index_of(Handedness)
  std::optional<std::int64_t> last_ns_;
  ThinnedValues step_s_;
};

}  // namespace nade::io
