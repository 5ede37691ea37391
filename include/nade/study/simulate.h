#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>

#include "nade/status.h"
#include "nade/study/plan.h"

namespace nade::study {

/// How invented people answer: behind each answer lies a feeling, of which the scale's points are
/// equal steps.
struct Effect {
  /// What correction adds to the feeling, in standard deviations of `answer_spread`, by the
  /// question's id; 0 where a question is not named.
  std::map<std::string, double> shift;
  double person_spread = 0.7;    ///< how people differ from one another, standard deviation
  double answer_spread = 1.0;    ///< how one person's answers differ, standard deviation, > 0
  double baseline = -0.5;        ///< the mean feeling without correction; 0 is the scale's middle
  double points_per_unit = 1.5;  ///< of the scale in one unit of feeling, > 0
};

/// Reads "Q1=1.5,Q2=0.5,Q3=1.2", where "all=1" stands for every question not named and
/// "baseline", "person", "answer" and "points" set the numbers above. The error says what was
/// expected.
[[nodiscard]] Result<Effect> parse_effect(const std::string& text, const Plan& plan);

struct SimulationOptions {
  std::size_t participants = 15;  ///< 1 to 999
  Effect effect;
  std::uint64_t seed = 1;
  /// Seconds of invented motion for each trial; 0: none is written. Up to the plan's `trial_s`.
  double motion_s = 0.0;
  std::string tool = "nade";
};

/// Invents a whole study in a folder that is not there yet or empty: P01, P02, … Every file says
/// SIMULATED, and the same arguments give the same files.
[[nodiscard]] Status simulate_study(
    const Plan& plan, const std::string& folder, const SimulationOptions& options,
    const std::function<void(const std::string& participant)>& on_participant = {});

}  // namespace nade::study
