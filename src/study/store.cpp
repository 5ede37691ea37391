#include "nade/study/store.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>
#include <ctime>
#include <filesystem>
#include <optional>
#include <utility>

#include "append_file.h"
#include "json_reader.h"
#include "nade/io/output_file.h"

namespace nade::study {
namespace {

namespace fs = std::filesystem;

using What = StudyEvent::What;

std::string system_time() {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
}

/// What the log calls an event; null where it is none of the log's.
const char* name_of(What what) {
  switch (what) {
    case What::practice:
      return "practice";
    case What::trial:
      return "trial";
    case What::stroking:
      return "stroking";
    case What::stroked:
      return "stroked";
    case What::broken_off:
      return "broken_off";
    case What::answered:
      return nullptr;
    case What::finished:
      return "finished";
    case What::skipped:
      return "skipped";
    case What::repeated:
      return "repeated";
    case What::rest:
      return "rest";
    case What::paused:
      return "paused";
    case What::resumed:
      return "resumed";
    case What::stopped:
      return "stopped";
    case What::completed:
      return "completed";
  }
  return nullptr;
}

/// Whether what follows depends on it having been kept.
bool is_vital(What what) {
  return what == What::trial || what == What::skipped || what == What::repeated;
}

/// Why a folder cannot be gone on with, where it cannot.
std::optional<Error> misfit(const Participant& found, const ParticipantPlan& wanted) {
  const std::string path = fmt::format("{}/{}", found.folder, kPlanFile);
  if (const std::string key = difference_of(found.head.plan, wanted.plan); !key.empty()) {
    return Error{ErrorCode::bad_value,
                 fmt::format("{}: the participant began with another plan: expected the same "
                             "\"{}\" in both; go on with the plan as it was, or take another "
                             "participant's id",
                             path, key)};
  }
  if (found.head.speed != wanted.speed) {
    return Error{ErrorCode::bad_value,
                 fmt::format("{}: the participant began at speed {}: expected the same, found {}",
                             path, found.head.speed, wanted.speed)};
  }
  if (found.head.origin != wanted.origin) {
    return Error{
        ErrorCode::bad_value,
        fmt::format("{}: expected a person's folder or a SIMULATED one, found the other", path)};
  }
  if (!found.problems.empty()) return Error{ErrorCode::bad_value, found.problems.front()};
  return std::nullopt;
}

/// What was lost of a participant's files, where something was.
std::optional<Error> loss(const std::string& folder) {
  std::error_code aside;
  const fs::path path(folder);
  const auto lost = [&](std::string_view what, std::string_view beside) {
    return Error{ErrorCode::not_found,
                 fmt::format("{}/{}: expected it beside {}, found no such file: put it back from a "
                             "copy, or take another participant's id",
                             folder, what, beside)};
  };
  if (fs::exists(path / kPlanFile, aside)) {
    for (const std::string_view file : {kAnswersFile, kLogFile}) {
      if (!fs::exists(path / file, aside)) return lost(file, kPlanFile);
    }
    return std::nullopt;
  }
  // What was killed before it wrote its plan leaves these files, but nothing in them.
  for (const std::string_view file : {kAnswersFile, kLogFile}) {
    if (fs::file_size(path / file, aside) > 0 && !aside) return lost(kPlanFile, file);
  }
  for (const auto& entry : fs::directory_iterator(path, aside)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(kRecordingPrefix)) return lost(kPlanFile, name);
  }
  return std::nullopt;
}

/// The outermost folder of a path that is not there yet; empty where all of it is.
fs::path first_missing(fs::path path) {
  std::error_code aside;
  fs::path missing;
  for (; !path.empty() && !fs::exists(path, aside); path = path.parent_path()) missing = path;
  return missing;
}

}  // namespace

struct StudyStore::Impl {
  StoreOptions options;
  std::string folder;
  bool is_new = false;
  fs::path made;  ///< the outermost folder that was made for it; empty where none was
  ParticipantPlan head;
  StudyProgress progress;
  std::vector<std::string> notes;
  std::optional<AppendFile> answers;
  std::optional<AppendFile> log;
  std::optional<std::int64_t> first_ns;
  std::optional<Error> failure;

  [[nodiscard]] std::string path(std::string_view name) const {
    return fmt::format("{}/{}", folder, name);
  }
  [[nodiscard]] Reach reach() const {
    return options.safety == StoreOptions::Safety::synced ? Reach::disk : Reach::system;
  }
  [[nodiscard]] std::string now() const {
    return options.wall_clock ? options.wall_clock() : system_time();
  }

  Status open_files();
  Status begin();
  Status go_on();
  Status mend(AppendFile& file, std::string_view name, Participant& found);
  Status add_to_log(Json line, Reach how);
  Status keep_answer(const StudyEvent& event);
};

Status StudyStore::Impl::open_files() {
  Result<AppendFile> opened = AppendFile::open(path(kLogFile));
  if (!opened) return opened.error();
  log.emplace(std::move(opened).value());
  if (!log->lock()) {
    return Error{ErrorCode::unwritable,
                 fmt::format("{}: expected to be the only program at it, but another one runs this "
                             "participant's study",
                             folder)};
  }
  opened = AppendFile::open(path(kAnswersFile));
  if (!opened) return opened.error();
  answers.emplace(std::move(opened).value());
  return ok_status();
}

Status StudyStore::Impl::begin() { return write_whole(path(kPlanFile), participant_text(head)); }

Status StudyStore::Impl::go_on() {
  Result<Participant> found = read_participant(folder);
  if (!found) return found.error();
  if (const auto error = misfit(*found, head)) return *error;
  head = found->head;
  const Status mended_log = mend(*log, kLogFile, *found);
  if (!mended_log) return mended_log;
  const Status mended_answers = mend(*answers, kAnswersFile, *found);
  if (!mended_answers) return mended_answers;
  progress = progress_of(*found);
  for (std::size_t i = 0; i < progress.trials.size(); ++i) {
    const bool broken = progress.trials[i] == StudyProgress::Fate::open && progress.attempts[i] > 0;
    if (!broken) continue;
    const Status noted = add_to_log(
        {{"event", "interrupted"}, {"trial", i + 1}, {"attempt", progress.attempts[i]}}, reach());
    if (!noted) return noted;
  }
  return ok_status();
}

/// Cuts a torn line away and says so.
Status StudyStore::Impl::mend(AppendFile& file, std::string_view name, Participant& found) {
  const Result<std::size_t> cut = file.cut_torn_line();
  if (!cut) return cut.error();
  if (*cut == 0) return ok_status();
  const std::size_t lines =
      name == kLogFile ? found.log.size() : found.answers.size() + 1;  // with the names of columns
  notes.push_back(fmt::format("{}: line {} was cut off and is left out ({} bytes)", path(name),
                              lines + 1, *cut));
  return add_to_log({{"event", "mended"}, {"reason", notes.back()}}, reach());
}

Status StudyStore::Impl::add_to_log(Json line, Reach how) {
  Json stamped{{"at", now()}};
  stamped.update(line);
  return log->append(stamped.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n", how);
}

Status StudyStore::Impl::keep_answer(const StudyEvent& event) {
  const Trial& trial = head.trials[event.trial - 1];
  KeptAnswer row;
  row.participant = head.participant;
  row.trial = event.trial;
  row.order = event.order;
  row.object = trial.object;
  row.method = name_of(trial.method);
  row.question = head.plan.questions[event.question].id;
  row.answer = event.answer;
  row.response_time_s = 1e-9 * static_cast<double>(event.response_ns);
  row.attempt = event.attempt;
  row.changed = event.changed;
  return answers->append(answers_line(row, head.origin), reach());
}

StudyStore::StudyStore(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
StudyStore::StudyStore(StudyStore&&) noexcept = default;
StudyStore& StudyStore::operator=(StudyStore&&) noexcept = default;
StudyStore::~StudyStore() = default;

Result<StudyStore> StudyStore::open(const Plan& plan, StoreOptions options) {
  if (!is_identifier(options.participant)) {
    return Error{ErrorCode::out_of_range,
                 fmt::format("participant '{}': expected 1 to 40 letters, digits, - and _ (no "
                             "names)",
                             options.participant)};
  }
  auto impl = std::make_unique<Impl>();
  impl->head = {options.participant,
                options.tool,
                options.origin,
                options.motion,
                options.speed,
                plan,
                trials_of(plan, options.participant)};
  impl->folder = (fs::path(options.folder) / options.participant).lexically_normal().string();
  impl->options = std::move(options);
  if (const auto lost = loss(impl->folder)) return *lost;
  impl->made = first_missing(impl->folder);
  const Status made = make_folder(impl->folder);
  if (!made) return made.error();
  const Status opened = impl->open_files();
  if (!opened) return opened.error();
  impl->is_new = !fs::exists(impl->path(kPlanFile));
  const Status ready = impl->is_new ? impl->begin() : impl->go_on();
  if (!ready) return ready.error();
  if (impl->answers->empty()) {
    const Status named = impl->answers->append(answers_header(impl->head.origin), impl->reach());
    if (!named) return named.error();
  }
  const Status synced = sync_folder(impl->folder);
  if (!synced) return synced.error();
  const Status noted = impl->add_to_log(
      {{"event", impl->is_new ? "begun" : "taken_up"}, {"tool", impl->options.tool}},
      impl->reach());
  if (!noted) return noted.error();
  return StudyStore(std::move(impl));
}

const std::vector<Trial>& StudyStore::trials() const { return impl_->head.trials; }
const StudyProgress& StudyStore::progress() const { return impl_->progress; }
const std::vector<std::string>& StudyStore::notes() const { return impl_->notes; }
const std::string& StudyStore::folder() const { return impl_->folder; }
const StoreOptions& StudyStore::options() const { return impl_->options; }
std::string StudyStore::now() const { return impl_->now(); }

Status StudyStore::keep(const StudyEvent& event) {
  if (impl_->failure) return *impl_->failure;
  if (!impl_->first_ns) impl_->first_ns = event.time_ns;
  Status kept = ok_status();
  if (event.what == What::answered) {
    kept = impl_->keep_answer(event);
  } else {
    const double t = 1e-9 * static_cast<double>(event.time_ns - *impl_->first_ns);
    Json line{{"t", t}, {"event", name_of(event.what)}, {"trial", event.trial}};
    line["attempt"] = event.attempt;
    if (!event.reason.empty()) line["reason"] = event.reason;
    kept =
        impl_->add_to_log(std::move(line), is_vital(event.what) ? impl_->reach() : Reach::system);
  }
  if (!kept.ok()) impl_->failure = kept.error();
  return kept;
}

bool StudyStore::withdraw() {
  if (!impl_->is_new || impl_->first_ns) return false;
  impl_->first_ns = 0;
  impl_->failure = Error{ErrorCode::not_found, fmt::format("{}: was withdrawn", impl_->folder)};
  std::error_code aside;
  for (const std::string_view file : {kPlanFile, kAnswersFile, kLogFile}) {
    fs::remove(impl_->path(file), aside);
  }
  if (impl_->made.empty()) return true;
  // Only what is empty goes.
  for (fs::path folder = impl_->folder; fs::remove(folder, aside) && folder != impl_->made;) {
    folder = folder.parent_path();
  }
  return true;
}

Status StudyStore::remark(const std::string& event, const std::string& reason) {
  return impl_->add_to_log({{"event", event}, {"reason", reason}}, Reach::system);
}

}  // namespace nade::study
