#include "nade/study/export.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "bids_motion.h"
#include "json_reader.h"
#include "nade/io/output_file.h"
#include "nade/study/participant.h"

namespace nade::study {
namespace {

constexpr const char* kBidsVersion = "1.9.0";

/// Labels of BIDS have letters and digits only.
std::string label_of(const std::string& participant) {
  std::string label;
  std::copy_if(participant.begin(), participant.end(), std::back_inserter(label),
               [](char letter) { return letter != '-' && letter != '_'; });
  return label;
}

Status make_folders(const std::string& path) {
  std::error_code code;
  std::filesystem::create_directories(path, code);
  if (!code) return ok_status();
  return Error{ErrorCode::unwritable,
               fmt::format("{}: expected to make the folder, but: {}", path, code.message())};
}

/// Writes the dataset, a participant at a time.
class Exporter {
 public:
  explicit Exporter(std::string out) : bids_(out + "/bids"), out_(std::move(out)) {}

  Status add(const Participant& participant);
  Status finish(const Participant& first);
  [[nodiscard]] const StudyExport& result() const { return result_; }

 private:
  enum class Dataset : std::uint8_t { raw, derived };

  Status add_motion(const Participant& participant, const std::string& label);
  Status add_trial(const Participant& participant, const std::string& label, const Trial& trial,
                   std::size_t attempt, std::string& scans);
  Status add_behaviour(const Participant& participant, const std::string& label,
                       const std::vector<KeptAnswer>& answers);
  Status describe_dataset(const std::string& folder, const Participant& first, Dataset what) const;

  std::string bids_;
  std::string out_;
  StudyExport result_;
  bool simulated_ = false;
  std::string answers_;
  std::string participants_ = "participant_id\ttrials_answered\n";
  std::map<std::string, std::string> labels_;
};

Status Exporter::add(const Participant& participant) {
  const std::string& id = participant.head.participant;
  const std::string label = label_of(id);
  if (const auto [other, fresh] = labels_.emplace(label, id); !fresh) {
    return Error{ErrorCode::bad_value,
                 fmt::format("{}: expected ids that differ in letters and digits, for BIDS has no "
                             "others; found {} too",
                             participant.folder, other->second)};
  }
  const bool simulated = participant.head.origin == Origin::simulated;
  if (result_.participants == 0) {
    simulated_ = simulated;
    answers_ = answers_header(participant.head.origin);
  } else if (simulated != simulated_) {
    return Error{ErrorCode::bad_value,
                 fmt::format("{}: expected people only or SIMULATED ones only, found both",
                             participant.folder)};
  }
  const std::vector<KeptAnswer> answers = answers_that_count(participant);
  for (const KeptAnswer& answer : answers) {
    answers_ += answers_line(answer, participant.head.origin);
  }
  const std::size_t questions = std::max<std::size_t>(participant.head.plan.questions.size(), 1);
  participants_ += fmt::format("sub-{}\t{}\n", label, answers.size() / questions);
  ++result_.participants;
  result_.answers += answers.size();
  const Status behaviour = add_behaviour(participant, label, answers);
  if (!behaviour) return behaviour;
  return participant.head.motion == Motion::none ? ok_status() : add_motion(participant, label);
}

Status Exporter::add_behaviour(const Participant& participant, const std::string& label,
                               const std::vector<KeptAnswer>& answers) {
  const std::string folder = fmt::format("{}/sub-{}/beh", bids_, label);
  const Status made = make_folders(folder);
  if (!made) return made;
  std::string table = "trial\tobject\tmethod\tquestion\tanswer\tresponse_time\n";
  for (const KeptAnswer& answer : answers) {
    table += fmt::format("{}\t{}\t{}\t{}\t{}\t{:.3f}\n", answer.trial, answer.object, answer.method,
                         answer.question, answer.answer, answer.response_time_s);
  }
  const Plan& plan = participant.head.plan;
  Json levels = Json::object();
  for (const Question& question : plan.questions) {
    levels[question.id] = question.text.in(plan.language);
  }
  Json json{{"TaskName", "stroking"}};
  if (simulated_) json["Simulated"] = "SIMULATED";
  json["question"] = {{"Description", "the question asked after the trial"}, {"Levels", levels}};
  json["answer"] = {
      {"Description", fmt::format("1 ({}) to {} ({})", plan.scale.low.in(plan.language),
                                  plan.scale.points, plan.scale.high.in(plan.language))}};
  json["method"] = {{"Description", "how the drawn hand was corrected"}};
  json["object"] = {{"Description", "what was stroked"}};
  json["trial"] = {{"Description", "place in the participant's order"}};
  json["response_time"] = {{"Description", "from the question's appearance"}, {"Units", "s"}};
  const std::string stem = fmt::format("{}/sub-{}_task-stroking_beh", folder, label);
  const Status described = write_whole(stem + ".json", json.dump(2) + "\n");
  return described ? write_whole(stem + ".tsv", table) : described;
}

Status Exporter::add_motion(const Participant& participant, const std::string& label) {
  for (const std::string& base : {bids_, bids_ + "/derivatives/nade"}) {
    const Status made = make_folders(fmt::format("{}/sub-{}/motion", base, label));
    if (!made) return made;
  }
  std::string scans = "filename\tobject\tmethod\n";
  const StudyProgress progress = progress_of(participant);
  for (const Trial& trial : participant.head.trials) {
    const std::size_t attempt = counting_attempt(participant, trial.number);
    const bool skipped = progress.trials[trial.number - 1] == StudyProgress::Fate::skipped;
    if (attempt == 0 || skipped) continue;
    const Status added = add_trial(participant, label, trial, attempt, scans);
    if (!added) return added;
  }
  const std::string stem = fmt::format("{0}/sub-{1}/sub-{1}_scans", bids_, label);
  const Json json{{"object", {{"Description", "what was stroked"}}},
                  {"method", {{"Description", "how the drawn hand was corrected"}}}};
  const Status described = write_whole(stem + ".json", json.dump(2) + "\n");
  return described ? write_whole(stem + ".tsv", scans) : described;
}

Status Exporter::add_trial(const Participant& participant, const std::string& label,
                           const Trial& trial, std::size_t attempt, std::string& scans) {
  const std::string from = fmt::format("{}/{}", participant.folder, recording_stem(trial, attempt));
  BidsMotion motion;
  motion.recording = from + ".tracked.jsonl.gz";
  motion.folder = fmt::format("{}/sub-{}/motion", bids_, label);
  motion.stem = fmt::format("sub-{}_task-stroking", label);
  motion.run = fmt::format("_run-{:02}", trial.number);
  motion.with_head = true;
  std::string instructions;
  for (const Text& text : participant.head.plan.instructions) {
    instructions += (instructions.empty() ? "" : " ") + text.in(participant.head.plan.language);
  }
  // Validators refuse keys that BIDS does not know; object and method are columns of the scans.
  Json about;
  about["TaskDescription"] =
      fmt::format("{}Stroking a virtual {} with the bare hand; method {}",
                  simulated_ ? "SIMULATED: " : "", trial.object, name_of(trial.method));
  about["Instructions"] = instructions;
  about["SoftwareVersions"] = participant.head.tool;
  motion.about_json = about.dump();
  const Result<std::vector<std::string>> written = write_bids_motion(motion);
  if (!written) return written.error();
  for (const std::string& name : *written) {
    scans += fmt::format("{}\t{}\t{}\n", name, trial.object, name_of(trial.method));
  }
  motion.recording = from + ".corrected.jsonl.gz";
  motion.folder = fmt::format("{}/derivatives/nade/sub-{}/motion", bids_, label);
  motion.run += "_desc-corrected";
  motion.with_head = false;
  const Result<std::vector<std::string>> corrected = write_bids_motion(motion);
  if (!corrected) return corrected.error();
  ++result_.motions;
  return ok_status();
}

Status Exporter::describe_dataset(const std::string& folder, const Participant& first,
                                  Dataset what) const {
  Json json{{"Name", fmt::format("{}{}", simulated_ ? "SIMULATED: " : "", first.head.plan.title)},
            {"BIDSVersion", kBidsVersion},
            {"DatasetType", what == Dataset::derived ? "derivative" : "raw"}};
  if (what == Dataset::derived) {
    Json tool{{"Name", "nade"}};
    tool["Description"] =
        fmt::format("the hands as they were drawn, corrected; {}", first.head.tool);
    json["GeneratedBy"] = Json::array();
    json["GeneratedBy"].push_back(tool);
  }
  return write_whole(folder + "/dataset_description.json", json.dump(2) + "\n");
}

Status Exporter::finish(const Participant& first) {
  const Status answers = write_whole(out_ + "/answers.csv", answers_);
  if (!answers) return answers;
  const Status described = describe_dataset(bids_, first, Dataset::raw);
  if (!described) return described;
  if (result_.motions > 0) {
    const Status derived = describe_dataset(bids_ + "/derivatives/nade", first, Dataset::derived);
    if (!derived) return derived;
  }
  const Json columns{{"trials_answered", {{"Description", "trials with answers that count"}}}};
  const Status explained = write_whole(bids_ + "/participants.json", columns.dump(2) + "\n");
  if (!explained) return explained;
  const Status listed = write_whole(bids_ + "/participants.tsv", participants_);
  if (!listed) return listed;
  return write_whole(
      bids_ + "/README",
      fmt::format("{}{}\n\nHands stroking virtual objects, with and without a correction of the "
                  "drawn hand.\nmotion: the hands as tracked, and the head; derivatives/nade: the "
                  "hands as drawn;\nbeh: the answers after each trial. Positions in metres, "
                  "orientations as unit quaternions.\n",
                  simulated_ ? "SIMULATED DATA, no person took part.\n\n" : "",
                  first.head.plan.title));
}

Status export_into(const std::vector<std::string>& folders, const std::string& out,
                   const std::function<void(const std::string&)>& on_participant,
                   StudyExport& result) {
  Exporter exporter(out);
  std::optional<Participant> first;
  for (const std::string& folder : folders) {
    if (on_participant) on_participant(std::filesystem::path(folder).filename().string());
    Result<Participant> participant = read_participant(folder);
    if (!participant) return participant.error();
    if (!participant->problems.empty()) {
      return Error{ErrorCode::bad_value, participant->problems.front()};
    }
    const Status added = exporter.add(*participant);
    if (!added) return added;
    if (!first) first = std::move(participant).value();
  }
  const Status finished = exporter.finish(*first);
  if (!finished) return finished;
  result = exporter.result();
  return ok_status();
}

}  // namespace

Result<StudyExport> export_study(const std::string& folder, const std::string& out,
                                 const std::function<void(const std::string&)>& on_participant) {
  const Result<std::vector<std::string>> folders = participant_folders(folder);
  if (!folders) return folders.error();
  std::error_code aside;
  const std::string target = std::filesystem::path(out + "/.").lexically_normal().parent_path();
  if (std::filesystem::exists(target, aside) && !std::filesystem::is_empty(target, aside)) {
    return Error{ErrorCode::unwritable,
                 fmt::format("{}: expected a new or an empty folder, found files in it", target)};
  }
  // Whole or not at all.
  const std::string beside = target + ".part";
  std::filesystem::remove_all(beside, aside);
  const Status made = make_folders(beside);
  if (!made) return made.error();
  StudyExport result;
  const Status done = export_into(*folders, beside, on_participant, result);
  if (!done) {
    std::filesystem::remove_all(beside, aside);
    return done.error();
  }
  std::error_code code;
  std::filesystem::rename(beside, target, code);
  if (code) {
    return Error{ErrorCode::unwritable,
                 fmt::format("{}: expected to write it, but: {}", target, code.message())};
  }
  return result;
}

}  // namespace nade::study
