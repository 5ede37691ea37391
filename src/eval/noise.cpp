#include "nade/eval/noise.h"

#include <cmath>
#include <numbers>

// Based on: Steele, Lea and Flood. Fast Splittable Pseudorandom Number Generators. 2014.
// Based on: Box and Muller. A Note on the Generation of Random Normal Deviates. 1958.

namespace nade {
namespace {

/// Deviations of one kind of error: what varies slowly, and what is new in each frame.
struct Deviation {
  double slow = 0.0;
  double white = 0.0;
};

struct ModelDeviations {
  double lowest_hz = 0.0;
  double highest_hz = 0.0;
  Deviation shift_m;
  Deviation turn_rad;
  Deviation flexion_rad;
  Deviation abduction_rad;
};

// Set so that joints err by what is published for the trackers: three shifts of 0.7 mm make
// 1.2 mm, and a fingertip 80 mm out adds 1.4 mm for each degree at its base.
constexpr ModelDeviations kQuest{
    .lowest_hz = 0.1,
    .highest_hz = 1.0,
    .shift_m = {0.7e-3, 0.25e-3},
    .turn_rad = {0.5 * kDegree, 0.1 * kDegree},
    .flexion_rad = {0.8 * kDegree, 0.15 * kDegree},
    .abduction_rad = {0.4 * kDegree, 0.08 * kDegree},
};
constexpr ModelDeviations kLeap{
    .lowest_hz = 0.03,
    .highest_hz = 0.15,
    .shift_m = {4.0e-3, 0.1e-3},
    .turn_rad = {1.5 * kDegree, 0.04 * kDegree},
    .flexion_rad = {1.5 * kDegree, 0.05 * kDegree},
    .abduction_rad = {0.5 * kDegree, 0.03 * kDegree},
};

const ModelDeviations& deviations_of(NoiseModel model) {
  return model == NoiseModel::leap ? kLeap : kQuest;
}

}  // namespace

std::string_view name_of(NoiseModel model) {
  switch (model) {
    case NoiseModel::none:
      return "none";
    case NoiseModel::quest:
      return "quest";
    case NoiseModel::leap:
      return "leap";
  }
  return "none";
}

std::optional<NoiseModel> noise_from_name(std::string_view name) {
  for (const NoiseModel model : {NoiseModel::none, NoiseModel::quest, NoiseModel::leap}) {
    if (name == name_of(model)) return model;
  }
  return std::nullopt;
}

std::uint64_t Random::next() {
  std::uint64_t bits = (state_ += 0x9e3779b97f4a7c15u);
  bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9u;
  bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebu;
  return bits ^ (bits >> 31);
}

double Random::uniform() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }

double Random::normal() {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
  return radius * std::cos(2.0 * std::numbers::pi * uniform());
}

double TrackerNoise::SlowError::at(double time_s) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < kSines; ++i) sum += std::sin(rad_per_s[i] * time_s + phase[i]);
  return sum * std::sqrt(2.0 / static_cast<double>(kSines));
}

TrackerNoise::TrackerNoise(NoiseModel model, std::uint64_t seed) : model_(model), random_(seed) {
  const ModelDeviations& deviations = deviations_of(model);
  const double octaves = std::log(deviations.highest_hz / deviations.lowest_hz);
  for (SlowError& slow : slow_) {
    for (std::size_t i = 0; i < SlowError::kSines; ++i) {
      const double hz = deviations.lowest_hz * std::exp(octaves * random_.uniform());
      slow.rad_per_s[i] = 2.0 * std::numbers::pi * hz;
      slow.phase[i] = 2.0 * std::numbers::pi * random_.uniform();
    }
  }
}

TrackerError TrackerNoise::next(double time_s) {
  TrackerError error;
  if (model_ == NoiseModel::none) return error;
  const ModelDeviations& deviations = deviations_of(model_);
  std::size_t channel = 0;
  const auto draw = [&](const Deviation& deviation) {
    return deviation.slow * slow_[channel++].at(time_s) + deviation.white * random_.normal();
  };
  for (Eigen::Index i = 0; i < 3; ++i) error.palm.position(i) = draw(deviations.shift_m);
  Vec3 turn;
  for (Eigen::Index i = 0; i < 3; ++i) turn(i) = draw(deviations.turn_rad);
  if (turn.norm() > 0.0) {
    error.palm.rotation = Quat(Eigen::AngleAxisd(turn.norm(), turn.normalized()));
  }
  for (DigitAngles& digit : error.angles) {
    for (HingeAngles& hinge : digit) hinge.flexion = draw(deviations.flexion_rad);
    digit.front().abduction = draw(deviations.abduction_rad);
  }
  return error;
}

}  // namespace nade
