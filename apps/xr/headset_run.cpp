#include "headset_run.h"

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <functional>
#include <thread>
#include <utility>

#include "eye_picture.h"
#include "frame_costs.h"
#include "headset.h"
#include "headset_session.h"
#include "mirror.h"
#include "motion_files.h"
#include "nade/io/output_file.h"
#include "nade/io/plain_text.h"
#include "panel_log.h"

namespace nade::xr {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kIdle{10};
constexpr std::chrono::seconds kBetweenTries{1};
constexpr std::chrono::seconds kPatience{180};
/// A runtime that does not answer a request to leave is left without its answer.
constexpr std::chrono::seconds kFarewell{5};

std::atomic<int> interrupts{0};
extern "C" void note_interrupt(int /*signal*/) { interrupts.fetch_add(1); }

/// Ctrl-C and `kill` end the run in order, for as long as this lives.
class Interruptible {
 public:
  Interruptible() {
    interrupts.store(0);
    struct sigaction ours {};
    ours.sa_handler = note_interrupt;
    sigaction(SIGINT, &ours, &before_int_);
    sigaction(SIGTERM, &ours, &before_term_);
  }
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;
  ~Interruptible() {
    sigaction(SIGINT, &before_int_, nullptr);
    sigaction(SIGTERM, &before_term_, nullptr);
  }

 private:
  struct sigaction before_int_ {};
  struct sigaction before_term_ {};
};

void say(const std::string& sentence) {
  std::fprintf(stderr, "nade: %s\n", plain_text(sentence).c_str());
}

/// A headset, and our session on it, which is the first to go.
struct Opened {
  std::unique_ptr<Headset> headset;
  std::unique_ptr<HeadsetSession> session;
};

/// One run: what outlives sessions and runtimes, and what is done with them.
class Loop {
 public:
  /// `mirror` may be null.
  Loop(const HeadsetRun& run, Guide& guide, MirrorFeed* mirror)
      : run_(run), guide_(guide), mirror_(mirror) {}

  Status go(RoomSetup setup);

 private:
  Status begin(RoomSetup setup, const Headset& headset);
  [[nodiscard]] Result<Headset> find_headset() const;
  [[nodiscard]] Result<Opened> open(std::optional<RoomSetup> setup);
  [[nodiscard]] Result<Opened> open_again();
  Fate run_session(HeadsetSession& session);
  void show_frame(HeadsetSession& session);
  void draw_eyes(HeadsetSession& session, const TrackedFrame& frame);
  void follow_guide();
  void obey(const Guide::Wishes& wishes);
  void tell_guide(const TrackedFrame& frame);
  void record();
  void change_recording();
  void watch_recorder();
  Status finish_recording();
  Status open_outputs();
  [[nodiscard]] bool wants_out() const;

  const HeadsetRun& run_;
  Guide& guide_;
  std::unique_ptr<GraphicsBinding> binding_;
  std::unique_ptr<Room> room_;
  MirrorFeed* mirror_ = nullptr;
  std::unique_ptr<study::MotionRecorder> recorder_;
  int recording_ = 0;  ///< the last one's number
  std::optional<Error> record_failure_;
  std::optional<PanelLog> panel_log_;
  std::optional<RecordedAs> recorded_as_;  ///< while a recording goes on
  std::string headset_name_;
  FrameCosts costs_;
  std::size_t shown_ = 0;
  Moment moment_;
  std::optional<std::int64_t> recorded_from_ns_;
  study::MotionFrame recorded_;
  bool leave_ = false;
  bool warned_of_controllers_ = false;
  std::array<std::optional<draw::Image>, 2> screenshots_{};
};

bool Loop::wants_out() const {
  return leave_ || interrupts.load() > 0 || (run_.frames && shown_ >= *run_.frames) ||
         (mirror_ && mirror_->closed());
}

Status Loop::begin(RoomSetup setup, const Headset& headset) {
  Result<std::unique_ptr<GraphicsBinding>> binding = bind(headset.graphics());
  if (!binding) return binding.error();
  binding_ = std::move(binding).value();
  Result<std::unique_ptr<Room>> room = Room::create(std::move(setup));
  if (!room) return room.error();
  room_ = std::move(room).value();
  return ok_status();
}

Result<Headset> Loop::find_headset() const {
  constexpr std::array<GraphicsWay, 2> kBoth{GraphicsWay::egl, GraphicsWay::xlib};
  if (!run_.graphics) return Headset::find(kBoth);
  return Headset::find(std::array<GraphicsWay, 1>{*run_.graphics});
}

/// With `setup` the room is made, too: between headset and session, as that has OpenGL's context.
Result<Opened> Loop::open(std::optional<RoomSetup> setup) {
  Result<Headset> found = find_headset();
  if (!found) return found.error();
  auto headset = std::make_unique<Headset>(std::move(found).value());
  headset->scale_eyes(run_.eye_scale);
  if (setup) {
    if (const Status begun = begin(*std::move(setup), *headset); !begun) return begun.error();
  }
  Result<std::unique_ptr<HeadsetSession>> session = HeadsetSession::create(*headset, *binding_);
  if (!session) return session.error();
  return Opened{std::move(headset), std::move(session).value()};
}

/// A runtime that has just come back may know of no session yet.
Result<Opened> Loop::open_again() {
  const auto start = Clock::now();
  while (true) {
    std::this_thread::sleep_for(kBetweenTries);
    Result<Opened> opened = open(std::nullopt);
    if (opened || wants_out() || Clock::now() - start > kPatience) return opened;
  }
}

/// Whether all that the run is to write can be written, while nobody wears the headset yet.
Status Loop::open_outputs() {
  if (run_.record) {
    if (const Status can = check_recordable(*run_.record); !can) return can;
  }
  if (run_.screenshot) {
    for (const std::string& eye : eye_paths(*run_.screenshot)) {
      const auto opened = OutputFile::create(eye, OutputFile::Encoding::plain);
      if (!opened) return opened.error();
    }
  }
  if (!run_.panel_log) return ok_status();
  Result<PanelLog> log = PanelLog::create(*run_.panel_log);
  if (!log) return log.error();
  panel_log_.emplace(std::move(log).value());
  return ok_status();
}

Status Loop::go(RoomSetup setup_once) {
  const Interruptible interruptible;
  if (const Status opened = open_outputs(); !opened) return opened;
  std::optional<RoomSetup> setup = std::move(setup_once);
  while (true) {
    Result<Opened> opened = setup ? open(std::exchange(setup, std::nullopt)) : open_again();
    if (!opened) {
      const Status finished = finish_recording();
      return finished ? Status(opened.error()) : finished;
    }
    HeadsetSession& session = *opened->session;
    headset_name_ = opened->headset->name();
    say(headset_name_);
    room_->restart();
    const Fate fate = run_session(session);
    if (fate == Fate::failed) {
      static_cast<void>(finish_recording());
      return Error{ErrorCode::not_found, session.complaint()};
    }
    if (fate == Fate::ended || wants_out()) break;
    say(fate == Fate::session_lost
            ? "the headset's session was lost: beginning another (Ctrl-C ends)"
            : "the headset's runtime has gone: waiting for it to come back (Ctrl-C ends)");
  }
  if (Status finished = finish_recording(); !finished) return finished;
  if (run_.report) std::printf("%s\n", as_text(costs_).c_str());
  if (!run_.screenshot) return ok_status();
  return save_eyes(*run_.screenshot, screenshots_);
}

Fate Loop::run_session(HeadsetSession& session) {
  std::optional<Clock::time_point> asked_to_leave;
  while (session.poll() == Fate::goes_on) {
    if (wants_out() && !asked_to_leave) {
      session.request_exit();
      asked_to_leave = Clock::now();
    }
    if (asked_to_leave && (interrupts.load() > 1 || Clock::now() - *asked_to_leave > kFarewell)) {
      return Fate::ended;
    }
    if (!session.running()) {
      std::this_thread::sleep_for(kIdle);
      continue;
    }
    show_frame(session);
  }
  return session.fate();
}

void Loop::show_frame(HeadsetSession& session) {
  follow_guide();
  const TrackedFrame* const frame = session.begin_frame();
  if (frame == nullptr) return;
  if (frame->draw) {
    room_->update(*frame);
    draw_eyes(session, *frame);
  }
  session.end_frame();
  if (!frame->draw) return;
  ++shown_;
  costs_.add(room_->cost());
  tell_guide(*frame);
  if (!frame->own_hands && !std::exchange(warned_of_controllers_, true)) {
    say("the hands are made up from the controllers: put them down to use your own");
  }
}

void Loop::draw_eyes(HeadsetSession& session, const TrackedFrame& frame) {
  std::array<draw::Sight, 2> eyes;
  for (std::size_t eye = 0; eye < 2; ++eye) {
    const std::optional<draw::Target> target = session.acquire(eye);
    if (!target) return;
    eyes[eye] = {frame.eyes[eye], *target};
  }
  room_->draw(eyes);
  if (run_.screenshot && run_.frames && shown_ + 1 >= *run_.frames) {
    for (std::size_t eye = 0; eye < 2; ++eye) screenshots_[eye] = read_back(eyes[eye].target);
  }
  if (mirror_ != nullptr) mirror_->take(eyes[0].target, *room_);
  for (std::size_t eye = 0; eye < 2; ++eye) session.release(eye);
}

void Loop::follow_guide() {
  if (!guide_.changed()) return;
  room_->set(guide_.show());
  if (run_.record) change_recording();
}

void Loop::obey(const Guide::Wishes& wishes) {
  if (wishes.recentre) room_->recentre();
  if (wishes.raise_m != 0.0) room_->raise(wishes.raise_m);
  leave_ = leave_ || wishes.leave;
}

/// Seen from the spot: every pose, contact and normal of a hand.
void see_from(const Pose& spot, const Room::Hand& hand, std::optional<HandPose>& tracked,
              std::optional<CorrectedHand>& corrected) {
  const Pose back = spot.inverse();
  tracked = moved(hand.tracked, back);
  corrected = hand.corrected;
  corrected->pose = moved(hand.corrected.pose, back);
  for (auto& contact : corrected->contacts) {
    if (!contact) continue;
    contact->surface_point = back.apply(contact->surface_point);
    contact->normal = back.rotation * contact->normal;
  }
}

void Loop::tell_guide(const TrackedFrame& frame) {
  if (room_->pressed()) guide_.press(*room_->pressed());
  const Pose spot = room_->object_spot();
  study::MotionFrame& motion = moment_.motion;
  motion.time_ns = std::max(motion.time_ns + 1, frame.time_ns);
  motion.head.reset();
  if (frame.head) motion.head = spot.inverse() * *frame.head;
  for (std::size_t side = 0; side < 2; ++side) {
    motion.tracked[side].reset();
    motion.corrected[side].reset();
    const auto& hand = room_->hands()[side];
    if (hand) see_from(spot, *hand, motion.tracked[side], motion.corrected[side]);
  }
  moment_.object = room_->placement();
  moment_.animated_ns.reset();
  if (const auto start_ns = room_->animation_start_ns()) {
    moment_.animated_ns = frame.time_ns - *start_ns;
  }
  moment_.correction_us = costs_.last_correction_us();
  if (recorded_as_) record();
  watch_recorder();
  if (panel_log_) {
    if (const Status noted = panel_log_->note(*room_); !noted) {
      say(noted.error().message);
      panel_log_.reset();
    }
  }
  guide_.seen(moment_);
  obey(guide_.take_wishes());
}

void Loop::record() {
  if (!recorded_from_ns_) {
    // A recording starts at time 0.
    recorded_from_ns_ = moment_.motion.time_ns;
    RecordedAs as = *recorded_as_;
    if (moment_.animated_ns) as.animation_start_ns = -*moment_.animated_ns;
    recording_ = recording_ == 0 ? 1 : next_number(*run_.record, recording_);
    recorder_->begin(motion_files(numbered_path(*run_.record, recording_), as));
  }
  recorded_ = moment_.motion;
  recorded_.time_ns -= *recorded_from_ns_;
  recorder_->push(recorded_);
}

void Loop::change_recording() {
  RecordedAs as;
  as.object = room_->show().object;
  as.placement = room_->placement();
  as.method = room_->show().method;
  as.settle = room_->corrector().settle;
  as.headset = headset_name_;
  if (recorded_as_ == as) return;
  if (recorded_from_ns_) recorder_->end();
  recorded_as_.reset();
  recorded_from_ns_.reset();
  if (as.object.empty()) return;
  if (!recorder_) recorder_ = std::make_unique<study::MotionRecorder>();
  recorded_as_ = as;
}

void Loop::watch_recorder() {
  if (!recorder_) return;
  const auto failure = recorder_->take_failure();
  if (!failure) return;
  say(failure->message);
  if (!record_failure_) record_failure_ = *failure;
}

Status Loop::finish_recording() {
  if (!recorder_) return ok_status();
  if (recorded_from_ns_) recorder_->end();
  recorded_as_.reset();
  recorded_from_ns_.reset();
  recorder_->drain();
  if (record_failure_) return *record_failure_;
  if (const auto failure = recorder_->take_failure()) return *failure;
  if (const std::size_t dropped = recorder_->dropped(); dropped > 0) {
    return Error{ErrorCode::unwritable,
                 fmt::format("{}: the disk was too slow for {} frames, which the recording lacks",
                             *run_.record, dropped)};
  }
  return ok_status();
}

}  // namespace

Status run_headset(const HeadsetRun& run, RoomSetup room, Guide& guide) {
  if (!run.mirror) return Loop(run, guide, nullptr).go(std::move(room));
  Result<MirrorWindow> window = MirrorWindow::open();
  if (!window) return window.error();
  MirrorFeed feed;
  Status status = ok_status();
  // Windows belong to the main thread; the headset's frames do not care.
  std::thread frames([&] {
    status = Loop(run, guide, &feed).go(std::move(room));
    feed.end();
  });
  window->show(feed);
  frames.join();
  return status;
}

}  // namespace nade::xr
