#include "nade/study/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>

#include "nade/io/recording.h"

namespace nade::study {
namespace {

using Fate = StudyProgress::Fate;

/// A recording that ends so much before its trial is not whole.
constexpr double kMissingMost_s = 1.0;

/// What one recording holds.
struct Measured {
  std::size_t frames = 0;
  double length_s = 0.0;
  std::vector<std::string> warnings;
};

Result<Measured> read_motion(const std::string& path) {
  Result<RecordingReader> reader = RecordingReader::open(path);
  if (!reader) return reader.error();
  Measured motion;
  while (true) {
    const Result<std::optional<RecordedFrame>> frame = reader->next();
    if (!frame) return frame.error();
    if (!*frame) break;
    ++motion.frames;
    motion.length_s = 1e-9 * static_cast<double>((*frame)->time_ns);
  }
  motion.warnings = reader->warnings();
  return motion;
}

/// Checks one participant's folder.
class Checker {
 public:
  Checker(const Participant& participant, StudyCheck& check)
      : participant_(participant), check_(check) {}

  CheckedParticipant run() {
    const std::size_t before = check_.problems.size();
    const ParticipantPlan& head = participant_.head;
    for (const std::string& problem : participant_.problems) check_.problems.push_back(problem);
    for (const std::string& file : participant_.cut_files) {
      check_.problems.push_back(fmt::format(
          "{}: cut off in its last line; nade study run with this participant mends it", file));
    }
    const StudyProgress progress = progress_of(participant_);
    line_.participant = head.participant;
    line_.origin = head.origin;
    line_.trials = head.trials.size();
    line_.answers = answers_that_count(participant_).size();
    for (const Trial& trial : head.trials) check_trial(trial, progress.trials[trial.number - 1]);
    check_end();
    check_strangers();
    line_.problems = check_.problems.size() - before;
    return line_;
  }

 private:
  void check_trial(const Trial& trial, Fate fate) {
    if (fate == Fate::skipped) {
      ++line_.skipped;
      return;
    }
    const std::size_t attempt = counting_attempt(participant_, trial.number);
    if (fate == Fate::finished) ++line_.finished;
    if (fate == Fate::open) note(trial, "is still to be done");
    if (attempt == 0) return;
    check_recordings(trial, attempt, fate);
  }

  void check_recordings(const Trial& trial, std::size_t attempt, Fate fate) {
    if (participant_.head.motion == Motion::none) return;
    const std::string stem =
        fmt::format("{}/{}", participant_.folder, recording_stem(trial, attempt));
    double shortest_s = 1e9;
    std::size_t frames[2] = {0, 0};
    std::size_t at = 0;
    for (const std::string_view kind : {"tracked", "corrected"}) {
      const std::string path = fmt::format("{}.{}.jsonl.gz", stem, kind);
      const Result<Measured> motion = read_motion(path);
      if (!motion) {
        check_.problems.push_back(motion.error().message);
        return;
      }
      for (const std::string& warning : motion->warnings) {
        const bool cut = warning.find("cut off") != std::string::npos;
        (cut && fate == Fate::finished ? check_.problems : check_.notes).push_back(warning);
      }
      shortest_s = std::min(shortest_s, motion->length_s);
      frames[at++] = motion->frames;
    }
    line_.motion_s += shortest_s;
    if (frames[0] != frames[1]) {
      check_.problems.push_back(
          fmt::format("{}.corrected.jsonl.gz: expected {} frames as in the "
                      "tracked recording, found {}",
                      stem, frames[0], frames[1]));
    }
    // Invented people may stroke for a moment only.
    const bool real = participant_.head.origin == Origin::person;
    const double expected_s = participant_.head.plan.trial_s;
    // A frame is that much longer in a study that runs faster than life.
    const double missing_most_s = kMissingMost_s * std::max(1.0, participant_.head.speed);
    if (real && shortest_s < expected_s - missing_most_s) {
      check_.problems.push_back(
          fmt::format("{}.tracked.jsonl.gz: expected {:g} s of motion, found "
                      "{:.2f}",
                      stem, expected_s, shortest_s));
    }
  }

  /// A study that says it was done has every answer.
  void check_end() {
    const bool completed =
        std::any_of(participant_.log.begin(), participant_.log.end(),
                    [](const LogLine& line) { return line.event == "completed"; });
    if (!completed || line_.finished + line_.skipped == line_.trials) return;
    check_.problems.push_back(fmt::format(
        "{}/{}: expected answers to all of {} trials of a study that was completed, "
        "found {}",
        participant_.folder, kAnswersFile, line_.trials - line_.skipped, line_.finished));
  }

  /// Files that are none of the study's.
  void check_strangers() {
    std::set<std::string> known{std::string(kPlanFile), std::string(kAnswersFile),
                                std::string(kLogFile)};
    const StudyProgress progress = progress_of(participant_);
    for (const Trial& trial : participant_.head.trials) {
      for (std::size_t attempt = 1; attempt <= progress.attempts[trial.number - 1]; ++attempt) {
        for (const std::string_view kind : {"tracked", "corrected"}) {
          known.insert(fmt::format("{}.{}.jsonl.gz", recording_stem(trial, attempt), kind));
        }
      }
    }
    for (const auto& entry : std::filesystem::directory_iterator(participant_.folder)) {
      const std::string name = entry.path().filename().string();
      if (known.count(name) > 0) continue;
      check_.notes.push_back(
          fmt::format("{}/{}: is none of the study's files", participant_.folder, name));
    }
  }

  void note(const Trial& trial, std::string_view what) {
    check_.notes.push_back(fmt::format("{}: trial {} ({}, {}) {}", participant_.folder,
                                       trial.number, trial.object, name_of(trial.method), what));
  }

  const Participant& participant_;
  StudyCheck& check_;
  CheckedParticipant line_;
};

}  // namespace

Result<StudyCheck> check_study(const std::string& folder,
                               const std::function<void(const std::string&)>& on_participant) {
  const Result<std::vector<std::string>> folders = participant_folders(folder);
  if (!folders) return folders.error();
  StudyCheck check;
  std::optional<Participant> first;
  for (const std::string& path : *folders) {
    const std::string name = std::filesystem::path(path).filename().string();
    if (on_participant) on_participant(name);
    Result<Participant> participant = read_participant(path);
    if (!participant) {
      check.problems.push_back(participant.error().message);
      check.participants.emplace_back();
      check.participants.back().participant = name;
      check.participants.back().problems = 1;
      continue;
    }
    check.participants.push_back(Checker(*participant, check).run());
    if (!first) {
      first = std::move(participant).value();
      continue;
    }
    const std::string key = difference_of(first->head.plan, participant->head.plan);
    if (key.empty() || key == "language") continue;
    check.problems.push_back(fmt::format("{}/{}: plan.{}: expected the same as {}'s", path,
                                         kPlanFile, key, first->head.participant));
    ++check.participants.back().problems;
  }
  return check;
}

}  // namespace nade::study
