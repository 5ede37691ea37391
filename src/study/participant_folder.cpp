#include "participant_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>
#include <vector>

#include "nade/study/participant.h"

namespace nade::study {
namespace {

GivenAnswer given(const KeptAnswer& kept, Origin origin) {
  GivenAnswer answer;
  answer.participant = kept.participant;
  answer.object = kept.object;
  answer.method = kept.method;
  answer.question = kept.question;
  answer.value = kept.answer;
  answer.trial = kept.trial;
  answer.order = kept.order;
  answer.response_time_s = kept.response_time_s;
  answer.attempt = kept.attempt;
  answer.changed = kept.changed;
  answer.simulated = origin == Origin::simulated;
  return answer;
}

/// Trials without an answer for which the log has a reason.
void add_skipped(const Participant& participant, const std::vector<KeptAnswer>& counting,
                 StudyData& data) {
  for (const LogLine& line : participant.log) {
    const auto& trials = participant.head.trials;
    if (line.event != "skipped" || line.trial < 1 || line.trial > trials.size()) continue;
    const bool answered =
        std::any_of(counting.begin(), counting.end(),
                    [&](const KeptAnswer& answer) { return answer.trial == line.trial; });
    if (answered) continue;
    const Trial& trial = trials[line.trial - 1];
    data.skipped.push_back({participant.head.participant, trial.object,
                            std::string(name_of(trial.method)), line.reason});
  }
}

/// The recordings of the attempts whose answers count.
void add_recordings(const Participant& participant, const std::vector<KeptAnswer>& counting,
                    StudyData& data) {
  const std::filesystem::path folder(participant.folder);
  for (const Trial& trial : participant.head.trials) {
    const auto answer =
        std::find_if(counting.begin(), counting.end(),
                     [&](const KeptAnswer& counted) { return counted.trial == trial.number; });
    if (answer == counting.end()) continue;
    const std::string stem = recording_stem(trial, answer->attempt);
    RecordedTrial recorded{participant.head.participant, trial.object,
                           std::string(name_of(trial.method)),
                           (folder / (stem + ".tracked.jsonl.gz")).string(),
                           (folder / (stem + ".corrected.jsonl.gz")).string()};
    std::error_code aside;
    if (!std::filesystem::exists(recorded.tracked_path, aside)) continue;
    if (!std::filesystem::exists(recorded.corrected_path, aside)) continue;
    data.recordings.push_back(std::move(recorded));
  }
}

/// Notes what sets a participant apart.
void add_head(const ParticipantPlan& head, StudyData& data) {
  data.participants.push_back(head.participant);
  data.simulated = data.simulated || head.origin == Origin::simulated;
  if (head.speed != 1.0) {
    data.warnings.push_back(
        fmt::format("{} ran at {:g} times life's speed", head.participant, head.speed));
  }
  if (!data.plan) {
    data.plan = head.plan;
    return;
  }
  const std::string difference = difference_of(*data.plan, head.plan);
  if (difference.empty()) return;
  data.warnings.push_back(fmt::format("{}: the plan differs from {} in \"{}\"", head.participant,
                                      data.participants.size() > 1
                                          ? data.participants.front() + "'s"
                                          : std::string("the one given"),
                                      difference));
}

}  // namespace

Status add_participant(const std::string& folder, StudyData& data) {
  const Result<Participant> participant = read_participant(folder);
  if (!participant) return participant.error();
  if (!participant->problems.empty()) {
    return Error{ErrorCode::bad_value, participant->problems.front()};
  }
  for (const std::string& file : participant->cut_files) {
    data.warnings.push_back(fmt::format("{}: cut off in the last line, which is left out", file));
  }
  add_head(participant->head, data);
  const std::vector<KeptAnswer> counting = answers_that_count(*participant);
  add_skipped(*participant, counting, data);
  add_recordings(*participant, counting, data);
  for (const KeptAnswer& answer : counting) {
    data.answers.push_back(given(answer, participant->head.origin));
  }
  return ok_status();
}

}  // namespace nade::study
