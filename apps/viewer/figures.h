#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "nade/draw/stage.h"
#include "nade/eval/metrics.h"
#include "nade/eval/quantile.h"

namespace nade::viewer {

/// What is plotted, frame by frame.
enum class Figure : std::uint8_t { penetration, gap, bend, pop, solve };
inline constexpr std::size_t kFigureCount = 5;

/// The last frames of one figure, oldest first; frames without a value count as 0.
class History {
 public:
  static constexpr std::size_t kLength = 240;

  void add(std::optional<double> value);
  void clear();
  [[nodiscard]] std::span<const float> values() const { return values_; }
  [[nodiscard]] std::optional<double> last() const { return last_; }
  [[nodiscard]] float highest() const;

 private:
  std::vector<float> values_;
  std::optional<double> last_;
};

/// The figures of the moment and since the start, of the worse hand where there are two.
class Figures {
 public:
  /// `meshes` must outlive it.
  explicit Figures(const draw::HandMeshes& meshes);

  /// Everything anew: another object, method or recording.
  void restart();
  /// The next frame does not go on from the last one.
  void break_off();

  /// A hand of the current frame, and how long its correction took, if that was timed.
  void add(std::int64_t time_ns, const draw::StagedHand& hand, const Object& object,
           std::optional<double> solve_us);
  /// All hands of the frame are in.
  void end_frame();

  [[nodiscard]] const History& of(Figure figure) const {
    return histories_[static_cast<std::size_t>(figure)];
  }
  /// Over all frames since the start.
  [[nodiscard]] const Metrics& running() const { return running_; }
  /// The median since the start.
  [[nodiscard]] std::optional<double> solve_us_median() const;

 private:
  void take(Figure figure, const std::optional<double>& value);

  const draw::HandMeshes* meshes_;
  std::array<std::optional<MetricsMeter>, 2> meters_{};
  std::array<std::optional<double>, kFigureCount> frame_{};
  std::array<History, kFigureCount> histories_{};
  QuantileSketch solve_us_;
  Metrics running_;
  std::size_t frames_ = 0;
};

}  // namespace nade::viewer
