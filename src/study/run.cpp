#include "nade/study/run.h"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "json_reader.h"
#include "nade/io/object_file.h"
#include "nade/study/motion_recorder.h"

namespace nade::study {
namespace {

using What = StudyEvent::What;

/// The plan with files named from where the program runs.
Plan with_paths(Plan plan, const std::string& folder) {
  for (StudyObject& object : plan.objects) {
    const bool is_file =
        object.spec.find_first_of("./") != std::string::npos && !object.spec.starts_with("sphere:");
    if (is_file && !folder.empty()) {
      object.spec = (std::filesystem::path(folder) / object.spec).lexically_normal().string();
    }
  }
  return plan;
}

}  // namespace

struct StudyRun::Impl {
  RunOptions options;
  StudyStore store;
  StudySession session;
  MotionRecorder recorder;
  Status status = ok_status();
  bool recording = false;
  bool begins = false;  ///< with the next frame, which knows where the object stands
  std::int64_t stroking_ns = 0;
  std::size_t dropped_before = 0;
  MotionFrame motion;

  Impl(const Plan& plan, RunOptions options_in, StudyStore store_in)
      : options(std::move(options_in)),
        store(std::move(store_in)),
        session(with_paths(plan, options.plan_folder), store.trials(), store.progress()) {}

  void fail(const Error& error) {
    if (status.ok()) status = error;
    session.fail(error.message);
    session.clear_events();
  }
  void keep_events();
  void end_recording();
  [[nodiscard]] MotionFiles files(const RunFrame& frame) const;
  void record(const RunFrame& frame);
};

void StudyRun::Impl::keep_events() {
  for (const StudyEvent& event : session.events()) {
    if (event.what == What::stroking && event.trial > 0) {
      begins = store.options().motion == Motion::recorded;
      stroking_ns = event.time_ns;
    }
    if (event.what == What::stroked || event.what == What::broken_off) end_recording();
    const Status kept = store.keep(event);
    if (!kept) return fail(kept.error());
  }
  session.clear_events();
}

void StudyRun::Impl::end_recording() {
  begins = false;
  if (!recording) return;
  recording = false;
  recorder.end();
  const std::size_t dropped = recorder.dropped() - dropped_before;
  dropped_before = recorder.dropped();
  if (dropped == 0) return;
  const Status noted = store.remark("frames_left_out", std::to_string(dropped));
  if (!noted) fail(noted.error());
}

MotionFiles StudyRun::Impl::files(const RunFrame& frame) const {
  const StudyScene& scene = session.scene();
  const Trial& trial = session.trials()[scene.trial - 1];
  const std::string stem =
      fmt::format("{}/{}", store.folder(), recording_stem(trial, scene.attempt));
  Json about{{"participant", store.options().participant},
             {"trial", scene.trial},
             {"attempt", scene.attempt}};
  const bool invented = store.options().origin == Origin::simulated;
  if (invented) about["simulated"] = "SIMULATED";
  MotionFiles files;
  files.tracked_path = stem + ".tracked.jsonl.gz";
  files.corrected_path = stem + ".corrected.jsonl.gz";
  files.tracked_header = {options.source, invented ? "" : store.now(), options.hand_scale_known,
                          Json{{"study", about}}.dump()};
  ObjectPlacing placing{scene.spec, frame.object};
  if (frame.animated_ns) {
    placing.animation_start_ns = frame.now_ns - stroking_ns - *frame.animated_ns;
  }
  Json corrected = Json::parse(with_placing(files.tracked_header.unknown_json, placing));
  corrected["method"] = name_of(scene.method);
  corrected["tool"] = store.options().tool;
  files.corrected_header = files.tracked_header;
  files.corrected_header.unknown_json = corrected.dump();
  return files;
}

void StudyRun::Impl::record(const RunFrame& frame) {
  if (begins) {
    begins = false;
    recording = true;
    recorder.begin(files(frame));
    motion.time_ns = -1;
  }
  if (!recording || frame.now_ns - stroking_ns <= motion.time_ns) return;
  motion.time_ns = frame.now_ns - stroking_ns;
  motion.head = frame.head;
  for (std::size_t side = 0; side < 2; ++side) {
    motion.tracked[side].reset();
    motion.corrected[side].reset();
    if (frame.tracked[side] != nullptr) motion.tracked[side] = *frame.tracked[side];
    if (frame.corrected[side] != nullptr) motion.corrected[side] = *frame.corrected[side];
  }
  recorder.push(motion);
}

StudyRun::StudyRun(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
StudyRun::~StudyRun() = default;

Result<std::unique_ptr<StudyRun>> StudyRun::open(const Plan& plan, RunOptions options) {
  Result<StudyStore> store = StudyStore::open(plan, options.store);
  if (!store) return store.error();
  return std::unique_ptr<StudyRun>(
      new StudyRun(std::make_unique<Impl>(plan, std::move(options), std::move(store).value())));
}

void StudyRun::frame(const RunFrame& frame) {
  impl_->session.advance(frame.now_ns);
  impl_->keep_events();
  if (impl_->session.scene().recording) impl_->record(frame);
  if (const auto failure = impl_->recorder.take_failure()) impl_->fail(*failure);
}

void StudyRun::press(int button, std::int64_t now_ns) {
  impl_->session.press(button, now_ns);
  impl_->keep_events();
}

void StudyRun::pause(std::int64_t now_ns) {
  impl_->session.pause(now_ns);
  impl_->keep_events();
}

void StudyRun::resume(std::int64_t now_ns) {
  impl_->session.resume(now_ns);
  impl_->keep_events();
}

void StudyRun::repeat(std::int64_t now_ns) {
  impl_->session.repeat(now_ns);
  impl_->keep_events();
}

void StudyRun::skip(const std::string& reason, std::int64_t now_ns) {
  impl_->session.skip(reason, now_ns);
  impl_->keep_events();
}

void StudyRun::stop(std::int64_t now_ns) {
  impl_->session.stop(now_ns);
  impl_->keep_events();
  impl_->recorder.drain();
}

bool StudyRun::withdraw() { return impl_->store.withdraw(); }
void StudyRun::drain() { impl_->recorder.drain(); }

StudyState StudyRun::state() const { return impl_->session.state(); }
bool StudyRun::over() const { return impl_->session.over(); }
const PanelView& StudyRun::view() const { return impl_->session.view(); }
std::uint64_t StudyRun::view_revision() const { return impl_->session.view_revision(); }
const StudyScene& StudyRun::scene() const { return impl_->session.scene(); }
const StudySession& StudyRun::session() const { return impl_->session; }
const StudyStore& StudyRun::store() const { return impl_->store; }
std::size_t StudyRun::dropped_frames() const { return impl_->recorder.dropped(); }
const Status& StudyRun::status() const { return impl_->status; }

}  // namespace nade::study
