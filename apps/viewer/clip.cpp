#include "clip.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdio>
#include <mutex>
#include <thread>
#include <utility>

namespace nade::viewer {
namespace {

/// One hand: whether it is there, confidence, then 26 times position, rotation and radius.
constexpr std::size_t kJointNumbers = 8;
constexpr std::size_t kHandNumbers = 2 + kJointCount * kJointNumbers;
using PackedFrame = std::array<double, 2 * kHandNumbers>;

void pack(const HandPose& hand, double* out) {
  *out++ = 1.0;
  *out++ = hand.confidence;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    const Pose& joint = hand.joints[i];
    out = std::copy_n(joint.position.data(), 3, out);
    out = std::copy_n(joint.rotation.coeffs().data(), 4, out);
    *out++ = hand.radius[i];
  }
}

std::optional<HandPose> unpack(const double* in, Handedness side) {
  if (*in++ == 0.0) return std::nullopt;
  HandPose hand;
  hand.side = side;
  hand.confidence = *in++;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    hand.joints[i].position = Vec3(in);
    hand.joints[i].rotation = Quat(in + 3);
    hand.radius[i] = in[7];
    in += kJointNumbers;
  }
  return hand;
}

struct FileCloser {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

}  // namespace

struct Clip::Impl {
  std::string path;
  RecordingReader reader;
  RecordingHeader header;
  std::unique_ptr<std::FILE, FileCloser> store;
  mutable std::mutex mutex;  ///< of `times`
  std::vector<std::int64_t> times;
  std::int64_t start_ns = 0;
  PalmTrack palms;
  std::optional<Error> failure;
  std::vector<std::string> warnings;
  std::atomic<bool> complete{false};
  std::jthread thread;

  Impl(std::string from, RecordingReader opened)
      : path(std::move(from)), reader(std::move(opened)), header(reader.header()) {}

  void read_all(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      const Result<std::optional<RecordedFrame>> frame = reader.next();
      if (!frame) {
        failure = frame.error();
        break;
      }
      if (!frame->has_value()) break;
      if (!keep(**frame)) {
        failure = Error{ErrorCode::unwritable,
                        fmt::format("{}: the disk is too full to keep its frames", path)};
        break;
      }
    }
    warnings = reader.warnings();
    complete = true;
    complete.notify_all();
  }

  [[nodiscard]] bool keep(const RecordedFrame& frame) {
    PackedFrame packed{};
    for (std::size_t side = 0; side < 2; ++side) {
      if (frame.hands[side]) pack(frame.hands[side]->pose, packed.data() + side * kHandNumbers);
    }
    const auto at = static_cast<off_t>(times.size() * sizeof(packed));
    if (::pwrite(fileno(store.get()), packed.data(), sizeof(packed), at) !=
        static_cast<ssize_t>(sizeof(packed))) {
      return false;
    }
    palms.add(frame);
    const std::lock_guard lock(mutex);
    if (times.empty()) start_ns = frame.time_ns;
    times.push_back(frame.time_ns - start_ns);
    return true;
  }
};

Clip::Clip(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Clip::Clip(Clip&&) noexcept = default;
Clip& Clip::operator=(Clip&&) noexcept = default;
Clip::~Clip() = default;

Result<Clip> Clip::open(const std::string& path) {
  Result<RecordingReader> reader = RecordingReader::open(path);
  if (!reader) return reader.error();
  auto impl = std::make_unique<Impl>(path, std::move(reader).value());
  impl->store.reset(std::tmpfile());
  if (!impl->store) {
    return Error{ErrorCode::unwritable,
                 fmt::format("{}: no temporary file could be made for its frames", path)};
  }
  impl->thread =
      std::jthread([to = impl.get()](const std::stop_token& stop) { to->read_all(stop); });
  return Clip(std::move(impl));
}

const std::string& Clip::path() const { return impl_->path; }
const RecordingHeader& Clip::header() const { return impl_->header; }
bool Clip::complete() const { return impl_->complete; }
void Clip::wait() const { impl_->complete.wait(false); }

std::optional<Error> Clip::failure() const { return complete() ? impl_->failure : std::nullopt; }

std::vector<std::string> Clip::warnings() const {
  return complete() ? impl_->warnings : std::vector<std::string>{};
}

std::int64_t Clip::start_ns() const {
  NADE_ASSERT(complete());
  return impl_->start_ns;
}

std::size_t Clip::size() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->times.size();
}

std::int64_t Clip::time_ns(std::size_t index) const {
  const std::lock_guard lock(impl_->mutex);
  NADE_ASSERT(index < impl_->times.size());
  return impl_->times[index];
}

std::size_t Clip::index_at(std::int64_t time_ns) const {
  const std::lock_guard lock(impl_->mutex);
  const auto after = std::upper_bound(impl_->times.begin(), impl_->times.end(), time_ns);
  return after == impl_->times.begin() ? 0
                                       : static_cast<std::size_t>(after - impl_->times.begin()) - 1;
}

ClipFrame Clip::frame(std::size_t index) const {
  ClipFrame frame;
  frame.time_ns = time_ns(index);
  PackedFrame packed{};
  const auto at = static_cast<off_t>(index * sizeof(packed));
  if (::pread(fileno(impl_->store.get()), packed.data(), sizeof(packed), at) !=
      static_cast<ssize_t>(sizeof(packed))) {
    return frame;
  }
  frame.hands[0] = unpack(packed.data(), Handedness::left);
  frame.hands[1] = unpack(packed.data() + kHandNumbers, Handedness::right);
  return frame;
}

const PalmTrack& Clip::palms() const {
  NADE_ASSERT(complete());
  return impl_->palms;
}

}  // namespace nade::viewer
