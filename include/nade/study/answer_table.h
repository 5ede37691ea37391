#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "nade/status.h"

namespace nade::study {

/// One answer of one person to one question after one trial.
struct GivenAnswer {
  std::string participant;
  std::string object;
  std::string method;
  std::string question;
  /// No value where the question was left open (an empty field, NA or -).
  std::optional<double> value;
  std::optional<std::size_t> trial;
  std::optional<std::size_t> order;  ///< the trial's place in the participant's order
  std::optional<double> response_time_s;
  std::size_t attempt = 1;  ///< at the trial
  bool changed = false;     ///< takes the place of an earlier row
  bool simulated = false;   ///< invented, not given by a person
  std::size_t line = 0;     ///< in its file
};

/// The answers of one file, in its order.
struct AnswerTable {
  std::string path;
  std::vector<GivenAnswer> answers;
  std::vector<std::string> warnings;  ///< what was odd but not fatal, a sentence each
};

/// Reads a tidy table: a row an answer, columns found by their names, in any order and with others
/// between. `participant`, `object`, `method`, `question` and `answer` have to be there; the others
/// of docs/study.md, "The data", may be. The error names file, line and column.
[[nodiscard]] Result<AnswerTable> read_answer_table(const std::string& path);

/// Leaves only the rows that count: of a person's attempts at a condition the last with an answer
/// to every question that the table has, else the last; in it, of a question's rows the last. The
/// error names the line of a row that is there twice without being marked as changed.
[[nodiscard]] Result<AnswerTable> counting_answers(AnswerTable table);

}  // namespace nade::study
