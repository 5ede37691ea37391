#include "nade/study/motion_recorder.h"

#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "append_file.h"

namespace nade::study {
namespace {

/// How often the thread looks for frames; a frame loop that had to wake it would call the system.
constexpr std::chrono::milliseconds kLook{10};
constexpr std::int64_t kFlush_ns = 400'000'000;
constexpr double kGrains = 1e7;  // in a metre, and in a quaternion's length

/// The nearest double of so many decimals, which has a short text.
void coarsen(double& number) { number = std::round(number * kGrains) / kGrains; }

void coarsen(Pose& pose) {
  for (double* number :
       {&pose.position.x(), &pose.position.y(), &pose.position.z(), &pose.rotation.x(),
        &pose.rotation.y(), &pose.rotation.z(), &pose.rotation.w()}) {
    coarsen(*number);
  }
}

void coarsen(HandPose& hand) {
  for (Pose& joint : hand.joints) coarsen(joint);
  for (double& radius : hand.radius) coarsen(radius);
}

RecordedFrame tracked_frame(const MotionFrame& motion) {
  RecordedFrame frame;
  frame.time_ns = motion.time_ns;
  frame.head = motion.head;
  if (frame.head) coarsen(*frame.head);
  for (std::size_t side = 0; side < 2; ++side) {
    // What a tracker makes up when it has lost a hand is not kept.
    if (!motion.tracked[side] || !is_usable(*motion.tracked[side])) continue;
    frame.hands[side].emplace().pose = *motion.tracked[side];
    coarsen(frame.hands[side]->pose);
  }
  return frame;
}

RecordedFrame corrected_frame(const MotionFrame& motion) {
  RecordedFrame frame;
  frame.time_ns = motion.time_ns;
  frame.head = motion.head;
  if (frame.head) coarsen(*frame.head);
  for (std::size_t side = 0; side < 2; ++side) {
    if (!motion.corrected[side] || !is_usable(motion.corrected[side]->pose)) continue;
    const CorrectedHand& corrected = *motion.corrected[side];
    RecordedHand& hand = frame.hands[side].emplace();
    hand.pose = corrected.pose;
    hand.status = corrected.status;
    coarsen(hand.pose);
    for (std::size_t part = 0; part < kPartCount; ++part) {
      if (const auto& contact = corrected.contacts[part]) {
        hand.contact[part] =
            RecordedContact{contact->surface_point, contact->normal, contact->depth_m};
      }
    }
  }
  return frame;
}

/// Two recordings that are being written.
class FilePair {
 public:
  static Result<FilePair> open(const MotionFiles& files) {
    constexpr auto kAtOnce = OutputFile::Appears::at_once;
    auto tracked = RecordingWriter::create(files.tracked_path, files.tracked_header, kAtOnce);
    if (!tracked) return tracked.error();
    auto corrected = RecordingWriter::create(files.corrected_path, files.corrected_header, kAtOnce);
    if (!corrected) return corrected.error();
    return FilePair(files, std::move(tracked).value(), std::move(corrected).value());
  }

  Status write(const MotionFrame& frame) {
    const Status tracked = tracked_.write(tracked_frame(frame));
    if (!tracked) return tracked;
    const Status corrected = corrected_.write(corrected_frame(frame));
    if (!corrected) return corrected;
    if (flushed_ns_ && frame.time_ns - *flushed_ns_ < kFlush_ns) return ok_status();
    flushed_ns_ = frame.time_ns;
    return flush();
  }
  Status flush() {
    const Status tracked = tracked_.flush();
    return tracked ? corrected_.flush() : tracked;
  }
  Status finish() {
    const Status tracked = tracked_.finish();
    const Status corrected = corrected_.finish();
    if (!tracked) return tracked;
    if (!corrected) return corrected;
    const Status synced = sync_file(tracked_path_);
    return synced ? sync_file(corrected_path_) : synced;
  }

 private:
  FilePair(const MotionFiles& files, RecordingWriter tracked, RecordingWriter corrected)
      : tracked_path_(files.tracked_path),
        corrected_path_(files.corrected_path),
        tracked_(std::move(tracked)),
        corrected_(std::move(corrected)) {}

  std::string tracked_path_;
  std::string corrected_path_;

  RecordingWriter tracked_;
  RecordingWriter corrected_;
  std::optional<std::int64_t> flushed_ns_;
};

}  // namespace

struct MotionRecorder::Impl {
  enum class Kind : std::uint8_t { begin, frame, end };
  struct Slot {
    Kind kind = Kind::frame;
    MotionFrame frame;
  };

  explicit Impl(std::size_t capacity) : slots(capacity) {
    thread = std::thread([this] { run(); });
  }

  /// A ring with one thread at each end: `pushed` and `taken` only grow.
  [[nodiscard]] bool full() const {
    return pushed.load(std::memory_order_relaxed) - taken.load(std::memory_order_acquire) ==
           slots.size();
  }
  Slot& next() { return slots[pushed.load(std::memory_order_relaxed) % slots.size()]; }
  void publish() { pushed.store(pushed.load(std::memory_order_relaxed) + 1); }
  /// Between motions there is time to wait for room.
  void publish(Kind kind) {
    while (full()) std::this_thread::sleep_for(kLook);
    next().kind = kind;
    publish();
  }

  void run() {
    while (true) {
      if (taken.load(std::memory_order_relaxed) != pushed.load(std::memory_order_acquire)) {
        take(slots[taken.load(std::memory_order_relaxed) % slots.size()]);
        taken.store(taken.load(std::memory_order_relaxed) + 1, std::memory_order_release);
        continue;
      }
      std::unique_lock<std::mutex> lock(mutex);
      idle.notify_all();
      if (ending) break;
      wake.wait_for(lock, kLook);
    }
    finish();
  }

  void take(const Slot& slot) {
    switch (slot.kind) {
      case Kind::begin:
        finish();
        open();
        break;
      case Kind::frame:
        if (pair) keep(pair->write(slot.frame));
        break;
      case Kind::end:
        finish();
        break;
    }
  }
  void open() {
    MotionFiles files;
    {
      const std::scoped_lock lock(mutex);
      files = std::move(waiting.front());
      waiting.pop_front();
    }
    Result<FilePair> opened = FilePair::open(files);
    if (!opened) return keep(opened.error());
    pair.emplace(std::move(opened).value());
  }
  void finish() {
    if (!pair) return;
    const Status finished = pair->finish();
    pair.reset();
    keep(finished);
  }
  void keep(const Status& status) {
    if (status.ok()) return;
    pair.reset();
    const std::scoped_lock lock(mutex);
    if (!failure) failure = status.error();
    has_failed.store(true, std::memory_order_release);
  }

  std::vector<Slot> slots;
  std::atomic<std::size_t> pushed{0};
  std::atomic<std::size_t> taken{0};
  std::atomic<std::size_t> dropped{0};
  std::atomic<bool> has_failed{false};
  std::optional<FilePair> pair;  ///< the thread's own

  std::mutex mutex;
  std::condition_variable wake;
  std::condition_variable idle;
  std::deque<MotionFiles> waiting;
  std::optional<Error> failure;
  bool ending = false;
  std::thread thread;
};

MotionRecorder::MotionRecorder(std::size_t capacity) : impl_(std::make_unique<Impl>(capacity)) {}

MotionRecorder::~MotionRecorder() {
  {
    const std::scoped_lock lock(impl_->mutex);
    impl_->ending = true;
  }
  impl_->wake.notify_all();
  impl_->thread.join();
}

void MotionRecorder::begin(MotionFiles files) {
  {
    const std::scoped_lock lock(impl_->mutex);
    impl_->waiting.push_back(std::move(files));
  }
  impl_->publish(Impl::Kind::begin);
}

void MotionRecorder::push(const MotionFrame& frame) noexcept {
  if (impl_->full()) {
    impl_->dropped.fetch_add(1, std::memory_order_relaxed);
    return;
  }
  Impl::Slot& slot = impl_->next();
  slot.kind = Impl::Kind::frame;
  slot.frame = frame;
  impl_->publish();
}

void MotionRecorder::end() { impl_->publish(Impl::Kind::end); }

void MotionRecorder::drain() {
  std::unique_lock<std::mutex> lock(impl_->mutex);
  while (impl_->taken.load() != impl_->pushed.load()) {
    impl_->wake.notify_all();
    impl_->idle.wait_for(lock, kLook);
  }
}

std::size_t MotionRecorder::dropped() const noexcept {
  return impl_->dropped.load(std::memory_order_relaxed);
}

std::optional<Error> MotionRecorder::take_failure() {
  if (!impl_->has_failed.exchange(false)) return std::nullopt;
  const std::scoped_lock lock(impl_->mutex);
  return std::exchange(impl_->failure, std::nullopt);
}

}  // namespace nade::study
