#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "nade/status.h"
#include "nade/study/plan.h"
#include "nade/study/session.h"

namespace nade::study {

/// Files of a participant's folder.
inline constexpr std::string_view kPlanFile = "plan.json";
inline constexpr std::string_view kAnswersFile = "answers.csv";
inline constexpr std::string_view kLogFile = "log.jsonl";
/// Of the names of all recordings.
inline constexpr std::string_view kRecordingPrefix = "trial-";

/// Where answers come from.
enum class Origin : std::uint8_t { person, simulated };

/// Whether motion belongs to the study.
enum class Motion : std::uint8_t { recorded, none };

/// The head of a participant's folder: the plan as run.
struct ParticipantPlan {
  std::string participant;
  std::string tool;  ///< "nade 0.1.0"
  Origin origin = Origin::person;
  Motion motion = Motion::recorded;
  double speed = 1.0;  ///< of the study's time against life's
  Plan plan;
  std::vector<Trial> trials;
};
[[nodiscard]] std::string participant_text(const ParticipantPlan& plan);

/// A row of answers.csv.
struct KeptAnswer {
  std::string participant;
  std::size_t trial = 1;
  std::size_t order = 1;
  std::string object;
  std::string method;
  std::string question;
  int answer = 0;
  double response_time_s = 0.0;
  std::size_t attempt = 1;
  bool changed = false;  ///< takes the place of an earlier row
};
/// The first line of a table of answers, and a row of it, each with its end.
[[nodiscard]] std::string answers_header(Origin origin);
[[nodiscard]] std::string answers_line(const KeptAnswer& answer, Origin origin);

/// A line of log.jsonl.
struct LogLine {
  std::string event;
  std::size_t trial = 0;
  std::size_t attempt = 0;
  std::string reason;
};

/// Everything in a participant's folder but the motion.
struct Participant {
  std::string folder;
  ParticipantPlan head;
  std::vector<KeptAnswer> answers;  ///< all rows
  std::vector<LogLine> log;
  /// What is wrong, a sentence each that names file and line.
  std::vector<std::string> problems;
  /// Files whose last line was cut off, which is left out here.
  std::vector<std::string> cut_files;
};

/// Reads a folder as far as it can be read. The error is of a folder that cannot be read at all.
[[nodiscard]] Result<Participant> read_participant(const std::string& folder);

/// The answers that count, in the order of trials and questions: of a trial the last attempt with
/// an answer to every question, else the last attempt; in it the last row of each question. None of
/// a trial that was skipped in the end.
[[nodiscard]] std::vector<KeptAnswer> answers_that_count(const Participant& participant);

/// How far a participant has come.
[[nodiscard]] StudyProgress progress_of(const Participant& participant);

/// The attempt whose answers count; 0 where a trial has none.
[[nodiscard]] std::size_t counting_attempt(const Participant& participant, std::size_t trial);

/// What recordings of an attempt are called, before ".tracked.jsonl.gz".
[[nodiscard]] std::string recording_stem(const Trial& trial, std::size_t attempt);

/// The folders of participants in a study's folder, in order of their numbers.
[[nodiscard]] Result<std::vector<std::string>> participant_folders(const std::string& folder);

}  // namespace nade::study
