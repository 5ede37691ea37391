#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "nade/status.h"
#include "nade/study/answer_table.h"
#include "nade/study/plan.h"

namespace nade::study {

/// A trial's motion, as files.
struct RecordedTrial {
  std::string participant;
  std::string object;
  std::string method;
  std::string tracked_path;
  std::string corrected_path;
};

/// A trial that the operator left out, and why.
struct SkippedTrial {
  std::string participant;
  std::string object;
  std::string method;
  std::string why;
};

/// What was gathered from all participants.
struct StudyData {
  std::string source;                ///< the folder or file that it was read from
  std::vector<GivenAnswer> answers;  ///< those that count, one to a question and condition
  // In the order in which they are reported:
  std::vector<std::string> participants;  ///< also those without an answer
  std::vector<std::string> objects;
  std::vector<std::string> methods;
  std::vector<Question> questions;  ///< without texts where there is no plan
  double scale_low = 1.0;           ///< the answers' scale
  double scale_high = 7.0;
  std::optional<Plan> plan;  ///< of the first participant
  std::vector<RecordedTrial> recordings;
  std::vector<SkippedTrial> skipped;
  bool simulated = false;  ///< any of it was invented
  std::vector<std::string> warnings;
};

/// Reads a study's folder (docs/study.md, "The data"), one participant's, or one table of
/// everybody's answers. `plan_path` names the plan of a table, for its questions and scale; a
/// folder has its own. Of a table without attempts and changed answers, two rows for the same
/// question and condition are refused. The error names file and line.
[[nodiscard]] Result<StudyData> read_study_data(const std::string& path,
                                                const std::optional<std::string>& plan_path = {});

}  // namespace nade::study
