#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "nade/status.h"
#include "script.h"
#include "ui_kit.h"

namespace nade::viewer {

/// How many frames a script takes.
[[nodiscard]] std::size_t frames_of(const std::vector<ScriptedStep>& steps);

/// Refuses a script that goes on after a run's last frame.
[[nodiscard]] Status check_length(const std::vector<ScriptedStep>& steps, std::size_t frames);

/// Does what a script says, frame by frame: a click is a move, a press and a release, each in a
/// frame of its own.
class ScriptPlayer {
 public:
  explicit ScriptPlayer(std::vector<ScriptedStep> steps);

  /// The events of the next frame. The error names a widget that is not there.
  [[nodiscard]] Result<std::vector<Event>> next(const UiKit& ui);

 private:
  struct Timed {
    std::size_t frame;
    Event event;
  };
  [[nodiscard]] Status click(const ScriptedClick& click, const UiKit& ui);

  std::deque<ScriptedStep> steps_;
  std::deque<Timed> later_;
  std::size_t frame_ = 0;
};

}  // namespace nade::viewer
