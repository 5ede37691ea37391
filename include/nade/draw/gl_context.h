#pragma once

#include <memory>

#include "nade/status.h"

namespace nade::draw {

/// An OpenGL 4.5 core context without window or display (EGL, surfaceless), current on the thread
/// that made it for as long as it lives.
class OffscreenContext {
 public:
  /// The error says what is missing: no EGL, no surfaceless platform, no OpenGL 4.5.
  [[nodiscard]] static Result<OffscreenContext> create();
  OffscreenContext(OffscreenContext&&) noexcept;
  OffscreenContext& operator=(OffscreenContext&&) noexcept;
  ~OffscreenContext();

 private:
  struct Impl;
  explicit OffscreenContext(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// Whether the current context, whoever made it, is one that `Renderer` can draw in; the error
/// names what it is instead.
[[nodiscard]] Status check_current_context();

}  // namespace nade::draw
