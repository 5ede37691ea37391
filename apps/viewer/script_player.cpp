#include "script_player.h"

#include <fmt/format.h>

#include <algorithm>

namespace nade::viewer {
namespace {

/// A click is let go so many frames after it came.
constexpr std::size_t kClickEnds = 2;

}  // namespace

std::size_t frames_of(const std::vector<ScriptedStep>& steps) {
  std::size_t needed = 0;
  for (const ScriptedStep& step : steps) {
    const bool clicks = std::holds_alternative<ScriptedClick>(step.act);
    needed = std::max(needed, step.frame + 1 + (clicks ? kClickEnds : 0));
  }
  return needed;
}

Status check_length(const std::vector<ScriptedStep>& steps, std::size_t frames) {
  const std::size_t needed = frames_of(steps);
  if (needed <= frames) return ok_status();
  return Error{
      ErrorCode::bad_value,
      fmt::format("script: the run ends after {} frames, and steps are left over: expected "
                  "--frames {} or more",
                  frames, needed)};
}

ScriptPlayer::ScriptPlayer(std::vector<ScriptedStep> steps) : steps_(steps.begin(), steps.end()) {}

Result<std::vector<Event>> ScriptPlayer::next(const UiKit& ui) {
  while (!steps_.empty() && steps_.front().frame <= frame_) {
    const ScriptedStep step = steps_.front();
    // Before the first frame is drawn there is nothing to click on.
    if (frame_ == 0 && std::holds_alternative<ScriptedClick>(step.act)) break;
    steps_.pop_front();
    if (const Event* const event = std::get_if<Event>(&step.act)) {
      later_.push_back({frame_, *event});
      continue;
    }
    const Status clicked = click(std::get<ScriptedClick>(step.act), ui);
    if (!clicked) return clicked.error();
  }
  std::vector<Event> events;
  std::deque<Timed> rest;
  for (const Timed& timed : later_) {
    if (timed.frame <= frame_) {
      events.push_back(timed.event);
    } else {
      rest.push_back(timed);
    }
  }
  later_ = std::move(rest);
  ++frame_;
  return events;
}

Status ScriptPlayer::click(const ScriptedClick& click, const UiKit& ui) {
  const Widget* const widget = ui.find(click.widget);
  if (widget == nullptr) {
    return Error{ErrorCode::bad_value,
                 fmt::format("script: frame {}: no widget is called '{}'", frame_, click.widget)};
  }
  Event event;
  event.x = widget->left + click.across * (widget->right - widget->left);
  event.y = 0.5 * (widget->top + widget->bottom);
  later_.push_back({frame_, event});
  event.kind = Event::Kind::button;
  event.change = Change::down;
  later_.push_back({frame_ + 1, event});
  event.change = Change::up;
  later_.push_back({frame_ + kClickEnds, event});
  return ok_status();
}

}  // namespace nade::viewer
