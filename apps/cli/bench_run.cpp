#include "bench_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <filesystem>
#include <iterator>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>
#include <utility>

#include "console.h"
#include "nade/io/output_file.h"
#include "nade/io/recording.h"
#include "nade/version.h"

namespace nade::cli {
namespace {

Error of_case(const SuiteCase& suite_case, const Error& error) {
  return {error.code, fmt::format("{}: {}", suite_case.name(), error.message)};
}

/// Objects by name, each loaded once.
using Objects = std::map<std::string, SuiteObject>;

Result<Objects> load_objects(const std::vector<SuiteCase>& cases) {
  Objects objects;
  for (const SuiteCase& suite_case : cases) {
    if (objects.contains(suite_case.object)) continue;
    Result<SuiteObject> object = load_case_object(suite_case);
    if (!object) return of_case(suite_case, object.error());
    objects.emplace(suite_case.object, std::move(object).value());
  }
  return objects;
}

/// Takes cases off the plan, one at a time, until none is left or one has failed.
class Workers {
 public:
  Workers(const BenchPlan& plan, const DrawnHands& hands, const Objects& objects,
          BenchReport& report)
      : plan_(plan),
        hands_(hands),
        objects_(objects),
        report_(report),
        progress_("measured", plan.cases.size(), "cases") {}

  [[nodiscard]] Status run() {
    std::vector<std::thread> threads;
    for (std::size_t i = 1; i < std::min(plan_.jobs, plan_.cases.size()); ++i) {
      threads.emplace_back([this] { work(); });
    }
    work();
    for (std::thread& thread : threads) thread.join();
    return failure_ ? Status(*failure_) : ok_status();
  }

 private:
  void work() {
    for (std::size_t i = next_++; i < plan_.cases.size(); i = next_++) {
      const Status done = work_on(i);
      const std::scoped_lock lock(mutex_);
      progress_.step();
      if (done.ok()) continue;
      // Of several failures the first in the plan, whichever thread was faster.
      if (!failure_ || i < failed_) {
        failure_ = done.error();
        failed_ = i;
      }
      next_ = plan_.cases.size();
    }
  }

  [[nodiscard]] Status work_on(std::size_t index) {
    const SuiteCase& suite_case = plan_.cases[index];
    const SuiteObject& object = objects_.at(suite_case.object);
    const Result<CaseRecording> tracked = make_recording(suite_case, object);
    if (!tracked) return of_case(suite_case, tracked.error());
    bool has_paper = false;
    for (std::size_t m = 0; m < plan_.methods.size(); ++m) {
      if (!tracked->states.empty() && !plan_.methods[m].follows_objects) continue;
      CaseScore& scored = report_.scores[index * plan_.methods.size() + m];
      scored = score(suite_case, *tracked, object, hands_, plan_.methods[m]);
      if (plan_.methods[m].name != paper_.name) continue;
      report_.paper[index] = scored.metrics;
      has_paper = true;
    }
    if (!has_paper) {
      report_.paper[index] = score(suite_case, *tracked, object, hands_, paper_).metrics;
    }
    return ok_status();
  }

  const BenchPlan& plan_;
  const DrawnHands& hands_;
  const Objects& objects_;
  BenchReport& report_;
  const ComparedMethod paper_ = paper_method();
  Progress progress_;
  std::atomic<std::size_t> next_ = 0;
  std::mutex mutex_;
  std::optional<Error> failure_;
  std::size_t failed_ = 0;
};

/// A name as part of a path.
std::string slug(const std::string& name) {
  std::string text;
  for (const char character : name) {
    const bool plain = std::isalnum(static_cast<unsigned char>(character)) != 0 ||
                       character == '.' || character == '+' || character == '-';
    if (plain) {
      text += character;
    } else if (!text.empty() && text.back() != '-') {
      text += '-';
    }
  }
  return text;
}

std::string as_off(const TriangleSoup& soup) {
  std::string text = fmt::format("OFF\n{} {} 0\n", soup.vertices.size(), soup.triangles.size());
  auto out = std::back_inserter(text);
  for (const auto& at : soup.vertices) fmt::format_to(out, "{} {} {}\n", at.x(), at.y(), at.z());
  for (const auto& [a, b, c] : soup.triangles) fmt::format_to(out, "3 {} {} {}\n", a, b, c);
  return text;
}

CaseSet set_of(const SuiteCase& suite_case) {
  if (suite_case.scene) return CaseSet::scenes;
  return suite_case.is_held_out() ? CaseSet::held_out : CaseSet::strokes;
}

Status write_recording(const std::string& path, const RecordingHeader& header,
                       const std::vector<RecordedFrame>& frames) {
  Result<RecordingWriter> writer = RecordingWriter::create(path, header);
  if (!writer) return writer.error();
  for (const RecordedFrame& frame : frames) {
    const Status written = writer->write(frame);
    if (!written.ok()) return written;
  }
  return writer->finish();
}

/// One case as files in `folder`.
Status dump_case(const BenchPlan& plan, const DrawnHands& hands, const SuiteCase& suite_case,
                 const std::filesystem::path& folder) {
  const Result<SuiteObject> object = load_case_object(suite_case);
  if (!object) return of_case(suite_case, object.error());
  Result<CaseRecording> tracked = make_recording(suite_case, *object);
  if (!tracked) return of_case(suite_case, tracked.error());
  if (!tracked->states.empty()) {
    warn(fmt::format("{}: not written, for a recording cannot say how its object moves",
                     suite_case.name()));
    return ok_status();
  }
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed) {
    return Error{ErrorCode::unwritable, fmt::format("{}: {}", folder.string(), failed.message())};
  }
  RecordingHeader header = tracked->header;
  if (object->loaded.soup && object->loaded.file.empty()) {
    const std::string mesh = (folder / (slug(suite_case.object) + ".off")).string();
    const Status written = write_whole(mesh, as_off(*object->loaded.soup));
    if (!written.ok()) return written;
    header.unknown_json = with_placing(header.unknown_json, {mesh, tracked->placement});
  }
  const Status written =
      write_recording((folder / "tracked.jsonl.gz").string(), header, tracked->frames);
  if (!written.ok()) return written;
  for (const ComparedMethod& method : plan.methods) {
    auto json = nlohmann::ordered_json::parse(header.unknown_json);
    json["method"] = method.name;
    json["tool"] = fmt::format("nade {}", NADE_VERSION);
    RecordingHeader corrected_header = header;
    corrected_header.unknown_json = json.dump();
    const CorrectedRecording corrected = correct(*tracked, *object, hands, method);
    const Status done = write_recording((folder / (method.name + ".jsonl.gz")).string(),
                                        corrected_header, corrected.frames);
    if (!done.ok()) return done;
  }
  return ok_status();
}

}  // namespace

Result<BenchReport> run_bench(const BenchPlan& plan, const DrawnHands& hands) {
  const Result<Objects> objects = load_objects(plan.cases);
  if (!objects) return objects.error();
  BenchReport report;
  for (const ComparedMethod& method : plan.methods) report.methods.push_back(method.name);
  for (const SuiteCase& suite_case : plan.cases) {
    report.cases.push_back({suite_case.name(), set_of(suite_case), suite_case.is_flat()});
  }
  report.scores.resize(plan.cases.size() * plan.methods.size());
  report.paper.resize(plan.cases.size());
  Workers workers(plan, hands, *objects, report);
  const Status done = workers.run();
  if (!done.ok()) return done.error();
  return report;
}

Status dump_worst(const BenchPlan& plan, const DrawnHands& hands, const BenchReport& report,
                  const std::string& folder) {
  std::string index;
  std::map<std::size_t, std::string> cases;
  for (const BenchFigure& figure : bench_figures()) {
    if (figure.metric == nullptr) continue;  // a slow case looks like any other
    for (std::size_t m = 0; m < report.methods.size(); ++m) {
      const auto summary = summary_of(report, m, figure);
      if (!summary) continue;
      const std::string name = slug(report.cases[summary->worst_case].name);
      cases.emplace(summary->worst_case, name);
      index +=
          fmt::format("{} {} {:.6g} {}\n", figure.key, report.methods[m], summary->worst, name);
    }
  }
  for (const auto& [i, name] : cases) {
    const Status dumped =
        dump_case(plan, hands, plan.cases[i], std::filesystem::path(folder) / name);
    if (!dumped.ok()) return dumped;
  }
  return write_whole((std::filesystem::path(folder) / "worst.txt").string(), index);
}

}  // namespace nade::cli
