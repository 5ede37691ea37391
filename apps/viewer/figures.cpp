#include "figures.h"

#include <algorithm>

namespace nade::viewer {
namespace {

/// Running figures are for reading, so that they need not be new in every frame.
constexpr std::size_t kFramesBetweenSums = 10;

void keep_worse(std::optional<double>& kept, const std::optional<double>& other) {
  if (other) kept = std::max(kept.value_or(*other), *other);
}

}  // namespace

void History::add(std::optional<double> value) {
  last_ = value;
  if (values_.size() == kLength) values_.erase(values_.begin());
  values_.push_back(static_cast<float>(value.value_or(0.0)));
}

void History::clear() {
  values_.clear();
  last_.reset();
}

float History::highest() const {
  return values_.empty() ? 0.0F : *std::max_element(values_.begin(), values_.end());
}

Figures::Figures(const draw::HandMeshes& meshes) : meshes_(&meshes) {}

void Figures::restart() {
  for (auto& meter : meters_) meter.reset();
  for (History& history : histories_) history.clear();
  frame_ = {};
  solve_us_ = {};
  running_ = {};
  frames_ = 0;
}

void Figures::break_off() {
  for (auto& meter : meters_) {
    if (meter) meter->add_gap();
  }
}

void Figures::add(std::int64_t time_ns, const draw::StagedHand& hand, const Object& object,
                  std::optional<double> solve_us) {
  const std::size_t side = index_of(hand.tracked.side);
  const HandMesh& mesh = (*meshes_)[side];
  if (mesh.vertices.empty()) return;
  if (!meters_[side]) {
    const double scale = hand.scale.value_or(hand_scale(mesh, hand.tracked));
    meters_[side].emplace(mesh, MetricsOptions{scale});
  }
  const FrameReading reading = meters_[side]->add(time_ns, hand.tracked, hand.corrected, object);
  take(Figure::penetration, reading.penetration_mm);
  take(Figure::gap, reading.part_gap_mm);
  take(Figure::bend, reading.bend_added_deg);
  take(Figure::pop, reading.pop_mm);
  take(Figure::solve, solve_us);
  if (solve_us) solve_us_.add(*solve_us);
}

void Figures::take(Figure figure, const std::optional<double>& value) {
  keep_worse(frame_[static_cast<std::size_t>(figure)], value);
}

void Figures::end_frame() {
  for (std::size_t i = 0; i < kFigureCount; ++i) histories_[i].add(frame_[i]);
  frame_ = {};
  if (frames_++ % kFramesBetweenSums != 0) return;
  running_ = {};
  for (const auto& meter : meters_) {
    if (!meter) continue;
    const Metrics metrics = meter->finish();
    for (const MetricInfo& info : metric_table()) {
      keep_worse(running_.*info.value, metrics.*info.value);
    }
    running_.frames += metrics.frames;
    running_.pressing_frames += metrics.pressing_frames;
  }
}

std::optional<double> Figures::solve_us_median() const { return solve_us_.quantile(0.5); }

}  // namespace nade::viewer
