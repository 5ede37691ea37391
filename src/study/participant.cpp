#include "nade/study/participant.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>

#include "answers_file.h"
#include "json_reader.h"
#include "plan_json.h"

namespace nade::study {
namespace {

using Fate = StudyProgress::Fate;

constexpr std::string_view kFolderFormat = "nade-study-participant";
constexpr int kFolderVersion = 1;

ParticipantPlan head_from(const JsonReader& json) {
  ParticipantPlan head;
  json.allow({"format", "version", "participant", "tool", "simulated", "motion", "speed", "order",
              "plan"});
  json.be(kFolderFormat, kFolderVersion);
  head.participant = json.at("participant").identifier();
  head.tool = json.at("tool").text();
  if (json.has("simulated")) {
    const Json& simulated = json.at("simulated").json();
    if (!simulated.is_boolean()) json.at("simulated").refuse("true or false");
    head.origin = simulated == true ? Origin::simulated : Origin::person;
  }
  if (json.has("motion")) {
    const Json& motion = json.at("motion").json();
    if (!motion.is_boolean()) json.at("motion").refuse("true or false");
    head.motion = motion == false ? Motion::none : Motion::recorded;
  }
  if (json.has("speed")) head.speed = json.at("speed").number(0.01, 1000.0);
  head.plan = plan_from(json.at("plan"));
  const JsonReader order = json.at("order");
  for (std::size_t i = 0; i < order.count(1); ++i) {
    const JsonReader trial = order.at(i);
    trial.allow({"trial", "object", "method"});
    const std::string method = trial.at("method").text();
    if (!method_from_name(method)) trial.at("method").refuse("\"none\", \"paper\" or \"nade\"");
    head.trials.push_back({static_cast<std::size_t>(trial.at("trial").whole(i + 1, i + 1)),
                           trial.at("object").text(),
                           method_from_name(method).value_or(Method::none)});
  }
  return head;
}

Result<ParticipantPlan> read_head(const std::string& path) {
  const Result<std::string> text = read_text(path, "a participant's plan");
  if (!text) return text.error();
  const Result<Json> json = parse_json(*text, path);
  if (!json) return json.error();
  std::optional<Error> error;
  ParticipantPlan head = head_from(JsonReader(*json, path, error));
  if (error) return *error;
  return head;
}

void read_log(Participant& participant) {
  const std::string path = fmt::format("{}/{}", participant.folder, kLogFile);
  const std::vector<FileLine> lines = read_lines(path, participant);
  for (const FileLine& line : lines) {
    const Json json = Json::parse(line.text, nullptr, false);
    const bool whole = json.is_object() && json.contains("event") && json["event"].is_string();
    if (!whole) {
      participant.problems.push_back(
          fmt::format("{}: line {}: expected an object with an \"event\"", path, line.number));
      continue;
    }
    LogLine entry;
    entry.event = json["event"].get<std::string>();
    const auto number = [&](const char* key) -> std::size_t {
      const bool there = json.contains(key) && json[key].is_number_unsigned();
      return there ? json[key].get<std::size_t>() : 0;
    };
    entry.trial = number("trial");
    entry.attempt = number("attempt");
    if (json.contains("reason") && json["reason"].is_string()) {
      entry.reason = json["reason"].get<std::string>();
    }
    participant.log.push_back(std::move(entry));
  }
}

/// The log's last word on a trial: skipped or begun again.
bool skipped_in_the_end(const Participant& participant, std::size_t trial) {
  bool skipped = false;
  for (const LogLine& line : participant.log) {
    if (line.trial != trial) continue;
    if (line.event == "skipped") skipped = true;
    if (line.event == "trial") skipped = false;
  }
  return skipped;
}

std::size_t last_attempt(const Participant& participant, std::size_t trial) {
  std::size_t last = 0;
  for (const LogLine& line : participant.log) {
    if (line.event == "trial" && line.trial == trial) last = std::max(last, line.attempt);
  }
  for (const KeptAnswer& answer : participant.answers) {
    if (answer.trial == trial) last = std::max(last, answer.attempt);
  }
  return last;
}

bool is_whole(const Participant& participant, std::size_t trial, std::size_t attempt) {
  const auto answered = [&](const Question& question) {
    return std::any_of(participant.answers.begin(), participant.answers.end(),
                       [&](const KeptAnswer& answer) {
                         return answer.trial == trial && answer.attempt == attempt &&
                                answer.question == question.id;
                       });
  };
  const auto& questions = participant.head.plan.questions;
  return std::all_of(questions.begin(), questions.end(), answered);
}

/// Beside participants an analysis may lie in a study's folder.
bool is_participants(const std::filesystem::directory_entry& entry) {
  if (!entry.is_directory() || !is_identifier(entry.path().filename().string())) return false;
  const auto has = [&](std::string_view name) {
    return std::filesystem::exists(entry.path() / name);
  };
  return has(kPlanFile) || has(kAnswersFile) || has(kLogFile);
}

/// Numbers at the end count as numbers: P2 before P10.
bool comes_before(const std::string& a, const std::string& b) {
  return a.size() != b.size() ? a.size() < b.size() : a < b;
}

}  // namespace

std::string participant_text(const ParticipantPlan& head) {
  Json json{{"format", kFolderFormat},
            {"version", kFolderVersion},
            {"participant", head.participant},
            {"tool", head.tool}};
  if (head.origin == Origin::simulated) json["simulated"] = true;
  if (head.motion == Motion::none) json["motion"] = false;
  if (head.speed != 1.0) json["speed"] = head.speed;
  json["order"] = Json::array();
  for (const Trial& trial : head.trials) {
    json["order"].push_back(
        {{"trial", trial.number}, {"object", trial.object}, {"method", name_of(trial.method)}});
  }
  json["plan"] = json_of(head.plan);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Result<Participant> read_participant(const std::string& folder) {
  Participant participant;
  participant.folder = folder;
  Result<ParticipantPlan> head = read_head(fmt::format("{}/{}", folder, kPlanFile));
  if (!head) return head.error();
  participant.head = std::move(head).value();
  const ParticipantPlan& plan = participant.head;
  if (plan.trials != trials_of(plan.plan, plan.participant)) {
    participant.problems.push_back(
        fmt::format("{}/{}: order: expected the one that the plan's seed and the participant's id "
                    "give, found another",
                    folder, kPlanFile));
  }
  if (const std::string name = std::filesystem::path(folder).filename().string();
      name != plan.participant) {
    participant.problems.push_back(fmt::format("{}/{}: participant: expected \"{}\", found \"{}\"",
                                               folder, kPlanFile, name, plan.participant));
  }
  read_answers(participant);
  read_log(participant);
  return participant;
}

std::size_t counting_attempt(const Participant& participant, std::size_t trial) {
  std::size_t last = 0;
  std::size_t last_whole = 0;
  for (const KeptAnswer& answer : participant.answers) {
    if (answer.trial != trial) continue;
    last = std::max(last, answer.attempt);
    if (is_whole(participant, trial, answer.attempt)) {
      last_whole = std::max(last_whole, answer.attempt);
    }
  }
  return last_whole > 0 ? last_whole : last;
}

std::vector<KeptAnswer> answers_that_count(const Participant& participant) {
  std::vector<KeptAnswer> counting;
  for (const Trial& trial : participant.head.trials) {
    if (skipped_in_the_end(participant, trial.number)) continue;
    const std::size_t attempt = counting_attempt(participant, trial.number);
    for (const Question& question : participant.head.plan.questions) {
      const auto found = std::find_if(
          participant.answers.rbegin(), participant.answers.rend(), [&](const KeptAnswer& answer) {
            return answer.trial == trial.number && answer.attempt == attempt &&
                   answer.question == question.id;
          });
      if (found != participant.answers.rend()) counting.push_back(*found);
    }
  }
  return counting;
}

StudyProgress progress_of(const Participant& participant) {
  StudyProgress progress;
  for (const Trial& trial : participant.head.trials) {
    const std::size_t attempt = last_attempt(participant, trial.number);
    progress.attempts.push_back(attempt);
    Fate fate = Fate::open;
    if (attempt > 0 && is_whole(participant, trial.number, attempt)) fate = Fate::finished;
    if (skipped_in_the_end(participant, trial.number)) fate = Fate::skipped;
    progress.trials.push_back(fate);
    if (attempt > 0 || fate != Fate::open) progress.practised = true;
  }
  return progress;
}

std::string recording_stem(const Trial& trial, std::size_t attempt) {
  return fmt::format("{}{:02}-{}-{}{}", kRecordingPrefix, trial.number, trial.object,
                     name_of(trial.method), attempt > 1 ? fmt::format("-attempt-{}", attempt) : "");
}

Result<std::vector<std::string>> participant_folders(const std::string& folder) {
  std::error_code code;
  std::vector<std::string> folders;
  for (const auto& entry : std::filesystem::directory_iterator(folder, code)) {
    if (is_participants(entry)) folders.push_back(entry.path().string());
  }
  if (code) {
    return Error{
        code == std::errc::no_such_file_or_directory ? ErrorCode::not_found : ErrorCode::unreadable,
        fmt::format("{}: expected a study's folder, but: {}", folder, code.message())};
  }
  std::sort(folders.begin(), folders.end(), comes_before);
  if (folders.empty()) {
    return Error{ErrorCode::not_found,
                 fmt::format("{}: expected a folder for each participant, found none", folder)};
  }
  return folders;
}

}  // namespace nade::study
