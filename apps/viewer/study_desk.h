#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "desk.h"
#include "input.h"
#include "nade/study/run.h"
#include "ui_kit.h"

namespace nade::viewer {

/// A participant's study on the desktop: the mouse strokes, the panel is a window, the operator has
/// keys (P pause, R repeat, S skip, Esc stop).
class StudyDesk {
 public:
  /// `speed`: of the study's time against the window's, > 0.
  StudyDesk(std::unique_ptr<study::StudyRun> run, double speed);

  /// Draws the panel, and the operator's where one is asked for; takes what is pressed on them.
  void draw(UiKit& ui, const Input& input);
  void take_keys(const Input& input);
  /// Lets the viewer show the object and correct by the method that the study says.
  void prepare(Desk& desk);
  [[nodiscard]] bool shows_object() const { return !run_->scene().object.empty(); }
  /// Goes on by a frame, in which `session` was shown from `head`.
  void go_on(const Session& session, const Pose& head, const Input& input);

  /// Whether the study is over and that was seen.
  [[nodiscard]] bool closed() const { return closed_; }
  [[nodiscard]] study::Language language() const { return run_->session().plan().language; }
  [[nodiscard]] const study::StudyRun& run() const { return *run_; }
  [[nodiscard]] study::StudyRun& run() { return *run_; }

 private:
  void draw_panel(UiKit& ui, const Input& input);
  void draw_row(UiKit& ui, const std::vector<study::PanelButton>& row);
  void draw_operator(UiKit& ui, const Input& input);
  void draw_reasons(UiKit& ui, const Input& input);

  std::unique_ptr<study::StudyRun> run_;
  double speed_;
  std::int64_t now_ns_ = 0;
  std::string prepared_;  ///< the object that the viewer shows
  bool shown_ = false;    ///< in the last frame
  bool asks_reason_ = false;
  bool closed_ = false;
};

}  // namespace nade::viewer
