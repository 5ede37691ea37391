#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "nade/draw/stage.h"
#include "nade/eval/compare.h"
#include "nade/eval/suite.h"

namespace nade::cli {

/// Of one frame, by method.
using HandsByMethod = std::array<draw::StagedHands, 2>;

/// A case of the bench, played by two methods.
struct PlayedCase {
  SuiteObject object;
  CaseRecording tracked;
  std::array<CorrectedRecording, 2> corrected;
  std::array<Method, 2> drawn{};  ///< which skin it has
};
[[nodiscard]] Result<PlayedCase> play_case(const std::array<ComparedMethod, 2>& methods,
                                           const SuiteCase& suite_case, const DrawnHands& hands);

/// Frames in which tracked skin is pressed in, a thinned list.
[[nodiscard]] std::vector<std::size_t> pressing_frames(const PlayedCase& played,
                                                       const DrawnHands& hands);

[[nodiscard]] HandsByMethod hands_in(const PlayedCase& played, std::size_t frame,
                                     const DrawnHands& drawn);

/// Puts a case's object onto a stage, frame after frame. One that stretches is another each time.
class CaseStager {
 public:
  /// All must outlive it.
  CaseStager(const PlayedCase& played, draw::Stage& stage) : played_(played), stage_(stage) {}
  [[nodiscard]] Status set_frame(std::size_t frame);

 private:
  const PlayedCase& played_;
  draw::Stage& stage_;
  bool rests_ = false;  ///< what is on the stage is the object as it was loaded
  std::optional<LoadedObject> stretched_;
};

}  // namespace nade::cli
