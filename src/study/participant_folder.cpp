#include "participant_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <sstream>
#include <utility>

#include "nade/study/answer_table.h"
#include "plan_json.h"

namespace nade::study {
namespace {

namespace fs = std::filesystem;

/// A participant's plan.json, as docs/study.md has it.
struct ParticipantPlan {
  std::string participant;
  std::map<std::size_t, Trial> trials;  ///< by number
  Plan plan;
  bool simulated = false;
  double speed = 1.0;
};

Trial trial_from(const JsonReader& json) {
  Trial trial;
  trial.number = json.at("trial").whole(1, 9999);
  trial.object = json.at("object").text();
  const auto method = method_from_name(json.at("method").text());
  if (!method) json.at("method").refuse("\"none\", \"paper\" or \"nade\"");
  trial.method = method.value_or(Method::none);
  return trial;
}

Result<ParticipantPlan> read_participant_plan(const std::string& path) {
  const Result<std::string> text = read_text(path, "a participant's plan");
  if (!text) return text.error();
  const Result<Json> json = parse_json(*text, path);
  if (!json) return json.error();
  std::optional<Error> error;
  const JsonReader reader(*json, path, error);
  ParticipantPlan read;
  read.participant = reader.at("participant").text();
  const JsonReader order = reader.at("order");
  for (std::size_t i = 0; i < order.count(0); ++i) {
    const Trial trial = trial_from(order.at(i));
    read.trials[trial.number] = trial;
  }
  read.plan = plan_from(reader.at("plan"));
  if (reader.has("simulated")) {
    const Json& simulated = reader.at("simulated").json();
    read.simulated = !simulated.is_boolean() || simulated.get<bool>();
  }
  if (reader.has("speed")) read.speed = reader.at("speed").number(0.0, 1e6);
  if (error) return *error;
  return read;
}

/// Reasons are worth having, but a log that is damaged is no reason to stop: `nade study check`
/// says so.
void add_skipped(const std::string& path, const ParticipantPlan& plan, StudyData& data) {
  const Result<std::string> text = read_text(path, "a log");
  if (!text) return;
  std::istringstream lines(*text);
  for (std::string line; std::getline(lines, line);) {
    const Json json = Json::parse(line, nullptr, false);
    if (!json.is_object() || json.value("event", Json()) != "skipped") continue;
    const Json number = json.value("trial", Json());
    if (!number.is_number_unsigned()) continue;
    const auto trial = plan.trials.find(number.get<std::size_t>());
    if (trial == plan.trials.end()) continue;
    const Json reason = json.value("reason", Json());
    data.skipped.push_back({plan.participant, trial->second.object,
                            std::string(method_name(trial->second.method)),
                            reason.is_string() ? reason.get<std::string>() : std::string()});
  }
}

/// The recordings of the attempts that count.
void add_recordings(const fs::path& folder, const ParticipantPlan& plan,
                    const std::vector<GivenAnswer>& answers, StudyData& data) {
  for (const auto& [number, trial] : plan.trials) {
    const std::string method(method_name(trial.method));
    const auto answer = std::find_if(answers.begin(), answers.end(), [&](const GivenAnswer& given) {
      return given.object == trial.object && given.method == method;
    });
    if (answer == answers.end()) continue;
    const std::string attempt =
        answer->attempt > 1 ? fmt::format("-attempt-{}", answer->attempt) : std::string();
    const std::string stem =
        fmt::format("trial-{:02}-{}-{}{}", number, trial.object, method, attempt);
    RecordedTrial recorded{plan.participant, trial.object, method,
                           (folder / (stem + ".tracked.jsonl.gz")).string(),
                           (folder / (stem + ".corrected.jsonl.gz")).string()};
    std::error_code aside;
    if (!fs::exists(recorded.tracked_path, aside)) continue;
    if (!fs::exists(recorded.corrected_path, aside)) continue;
    data.recordings.push_back(std::move(recorded));
  }
}

void take_plan(const ParticipantPlan& plan, StudyData& data) {
  data.participants.push_back(plan.participant);
  data.simulated = data.simulated || plan.simulated;
  if (plan.speed != 1.0) {
    data.warnings.push_back(
        fmt::format("{} ran at {:g} times life's speed", plan.participant, plan.speed));
  }
  if (!data.plan) {
    data.plan = plan.plan;
    return;
  }
  const std::string difference = difference_of(*data.plan, plan.plan);
  if (difference.empty()) return;
  data.warnings.push_back(fmt::format("{}: its plan differs from {}'s in {}", plan.participant,
                                      data.participants.front(), difference));
}

}  // namespace

bool is_participant_folder(const std::string& path) {
  std::error_code aside;
  const fs::path folder(path);
  return fs::exists(folder / "answers.csv", aside) || fs::exists(folder / "plan.json", aside);
}

Status add_participant(const std::string& path, StudyData& data) {
  const fs::path folder(path);
  const Result<ParticipantPlan> plan = read_participant_plan((folder / "plan.json").string());
  if (!plan) return plan.error();
  take_plan(*plan, data);
  add_skipped((folder / "log.jsonl").string(), *plan, data);
  const fs::path answers_path = folder / "answers.csv";
  std::error_code aside;
  if (!fs::exists(answers_path, aside)) return ok_status();
  Result<AnswerTable> answers = read_answer_table(answers_path.string());
  if (answers) answers = counting_answers(std::move(answers).value());
  if (!answers) return answers.error();
  for (std::string& warning : answers->warnings) data.warnings.push_back(std::move(warning));
  add_recordings(folder, *plan, answers->answers, data);
  for (GivenAnswer& answer : answers->answers) data.answers.push_back(std::move(answer));
  return ok_status();
}

}  // namespace nade::study
