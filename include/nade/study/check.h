#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "nade/status.h"
#include "nade/study/participant.h"

namespace nade::study {

/// One participant's line in the summary.
struct CheckedParticipant {
  std::string participant;
  Origin origin = Origin::person;
  std::size_t trials = 0;
  std::size_t finished = 0;
  std::size_t skipped = 0;
  std::size_t answers = 0;  ///< that count
  double motion_s = 0.0;    ///< recorded, of the attempts that count
  std::size_t problems = 0;
};

/// What a study's folder holds and what is wrong with it.
struct StudyCheck {
  std::vector<CheckedParticipant> participants;
  /// Damage: a sentence each, that names file and line.
  std::vector<std::string> problems;
  /// What is to be known but no damage: trials still to be done, interrupted attempts.
  std::vector<std::string> notes;
};

/// Reads every file of a study. `on_participant` hears of each before it is read. The error is of a
/// folder that is none of a study.
[[nodiscard]] Result<StudyCheck> check_study(
    const std::string& folder,
    const std::function<void(const std::string& participant)>& on_participant = {});

}  // namespace nade::study
