#include "frame_pipe.h"

#include <exception>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "channel.h"

namespace nade::cli {
namespace {

/// Handing over costs as much as a frame or two.
constexpr std::size_t kFramesATime = 64;
constexpr std::size_t kMostOnTheirWay = 4;

using Frames = std::vector<RecordedFrame>;

/// A stage on a thread of its own, which ends with this object. What it throws comes out of
/// `end`.
class Stage {
 public:
  template <class Work>
  explicit Stage(Work work)
      : thread_([this, work = std::move(work)] {
          try {
            work();
          } catch (...) {
            thrown_ = std::current_exception();
          }
        }) {}
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;
  ~Stage() {
    if (thread_.joinable()) thread_.join();
  }

  void end() {
    thread_.join();
    if (thrown_) std::rethrow_exception(thrown_);
  }

 private:
  std::exception_ptr thrown_;
  std::thread thread_;
};

/// Closes a channel on the way out, however that is, so that the stage at its other end ends.
class Closing {
 public:
  explicit Closing(Channel<Frames>& channel) : channel_(channel) {}
  Closing(const Closing&) = delete;
  Closing& operator=(const Closing&) = delete;
  ~Closing() { channel_.close(); }

 private:
  Channel<Frames>& channel_;
};

}  // namespace

Result<std::size_t> pipe_frames(RecordingReader& reader, std::optional<RecordedFrame> first,
                                const std::function<void(RecordedFrame&)>& change,
                                RecordingWriter& writer) {
  Channel<Frames> read(kMostOnTheirWay);
  Channel<Frames> changed(kMostOnTheirWay);
  Status reading = ok_status();
  Status writing = ok_status();
  std::size_t count = 0;
  {
    Stage reads([&] {
      const Closing closing(read);
      Frames frames;
      if (first) frames.push_back(*std::move(first));
      while (true) {
        Result<std::optional<RecordedFrame>> next = reader.next();
        if (!next) {
          reading = next.error();
          return;
        }
        if (!*next) break;
        frames.push_back(**std::move(next));
        if (frames.size() == kFramesATime && !read.push(std::exchange(frames, {}))) return;
      }
      static_cast<void>(read.push(std::move(frames)));
    });
    Stage writes([&] {
      const Closing closing(changed);
      while (const std::optional<Frames> frames = changed.pop()) {
        for (const RecordedFrame& frame : *frames) {
          writing = writer.write(frame);
          if (!writing) return;
        }
      }
    });
    {
      const Closing no_more_read(read);
      const Closing no_more_changed(changed);
      while (std::optional<Frames> frames = read.pop()) {
        for (RecordedFrame& frame : *frames) change(frame);
        count += frames->size();
        if (!changed.push(*std::move(frames))) break;
      }
    }
    reads.end();
    writes.end();
  }
  if (!reading) return reading.error();
  if (!writing) return writing.error();
  return count;
}

}  // namespace nade::cli
