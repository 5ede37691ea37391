#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "nade/draw/gl_context.h"
#include "nade/draw/image.h"
#include "script_player.h"
#include "viewer.h"

namespace nade::viewer {

/// What a run of the viewer does by itself.
struct Run {
  int width = 1280;
  int height = 720;
  std::optional<std::size_t> frames;      ///< ends after so many; a window else when it is closed
  std::optional<std::string> screenshot;  ///< a PNG file of the last frame
  std::vector<ScriptedStep> script;
};

/// Time between two frames that are not a person's.
inline constexpr double kFixedStep_s = 1.0 / 60.0;

/// The viewer without a display: draws into memory at fixed time steps, the same on every run.
class HeadlessViewer {
 public:
  [[nodiscard]] static Result<HeadlessViewer> create(ViewerSetup setup, int width, int height);
  HeadlessViewer(HeadlessViewer&&) noexcept;
  HeadlessViewer& operator=(HeadlessViewer&&) noexcept;
  ~HeadlessViewer();

  /// Draws the next frame, in which `events` happen.
  void frame(const std::vector<Event>& events, Drawing drawing = Drawing::all);
  /// The last frame, controls and all.
  [[nodiscard]] draw::Image picture() const;
  [[nodiscard]] Viewer& viewer();

 private:
  struct Impl;
  explicit HeadlessViewer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// Runs frames without a display; 60 where `run` names no number.
[[nodiscard]] Status run_headless(ViewerSetup setup, const Run& run);

}  // namespace nade::viewer
