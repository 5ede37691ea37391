#pragma once

#include <cstdint>
#include <memory>

#include "nade/status.h"
#include "xr_platform.h"

namespace nade::xr {

/// The platforms' ways to make an OpenGL context known to a runtime.
enum class GraphicsWay : std::uint8_t {
  egl,   ///< without window or display, by XR_MNDX_egl_enable (Monado, WiVRn)
  xlib,  ///< through an unseen window of an X server, which runtimes for Linux all take
};
/// The OpenXR extension that it needs.
[[nodiscard]] constexpr const char* extension_of(GraphicsWay way) {
  return way == GraphicsWay::egl ? XR_MNDX_EGL_ENABLE_EXTENSION_NAME
                                 : XR_KHR_OPENGL_ENABLE_EXTENSION_NAME;
}

/// An OpenGL context, current on the thread that made it, as a runtime is told of it.
class GraphicsBinding {
 public:
  GraphicsBinding() = default;
  GraphicsBinding(const GraphicsBinding&) = delete;
  GraphicsBinding& operator=(const GraphicsBinding&) = delete;
  virtual ~GraphicsBinding() = default;

  /// What XrSessionCreateInfo::next points to; valid for as long as the binding.
  [[nodiscard]] virtual const void* session_link() const = 0;
};

/// The error says what the way lacks on this machine.
[[nodiscard]] Result<std::unique_ptr<GraphicsBinding>> bind(GraphicsWay way);
[[nodiscard]] Result<std::unique_ptr<GraphicsBinding>> bind_egl();
[[nodiscard]] Result<std::unique_ptr<GraphicsBinding>> bind_xlib();

}  // namespace nade::xr
