#pragma once

#include <cstdint>
#include <limits>

namespace nade::detail {

/// How many nodes and blocks the queries of meshes may still look at, on this thread: what a frame
/// costs grows with nothing else of an object.
inline constinit thread_local std::int64_t steps_left = std::numeric_limits<std::int64_t>::max();

/// In a frame. One that finds its hand anew on a million triangles takes six tenths of them, one
/// that goes on a hundredth.
inline constexpr std::int64_t kMostFrameSteps = 1'000'000;

/// Bounds what queries may look at as long as it lives. Once that is used up they find nothing.
class StepLimit {
 public:
  explicit StepLimit(std::int64_t most) : before_(steps_left), most_(most) { steps_left = most; }
  ~StepLimit() { steps_left = before_ - used(); }
  StepLimit(const StepLimit&) = delete;
  StepLimit& operator=(const StepLimit&) = delete;

  [[nodiscard]] std::int64_t used() const { return most_ - steps_left; }
  [[nodiscard]] bool is_used_up() const { return steps_left <= 0; }

 private:
  std::int64_t before_;
  std::int64_t most_;
};

}  // namespace nade::detail
