#include "nade/draw/gl_context.h"

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <array>
#include <string>
#include <string_view>

namespace nade::draw {
namespace {

constexpr int kLeastVersion = 45;

Error lacking(std::string message) { return {ErrorCode::not_found, std::move(message)}; }

/// As EGL names its errors.
std::string egl_error() { return fmt::format("EGL error 0x{:04x}", eglGetError()); }

bool client_offers(std::string_view extension) {
  const char* const all = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  return all != nullptr && std::string_view(all).find(extension) != std::string_view::npos;
}

/// A display that needs no display: Mesa's surfaceless one, or the first graphics card.
EGLDisplay open_display() {
  EGLDisplay display = EGL_NO_DISPLAY;
  if (client_offers("EGL_MESA_platform_surfaceless")) {
    display = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr)) return display;
  }
  if (client_offers("EGL_EXT_platform_device") && client_offers("EGL_EXT_device_enumeration")) {
    EGLDeviceEXT device = nullptr;
    EGLint count = 0;
    if (eglQueryDevicesEXT(1, &device, &count) && count > 0) {
      display = eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr);
      if (display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr)) return display;
    }
  }
  return EGL_NO_DISPLAY;
}

/// A window system's context (GLX) is not EGL's; asked only of a library that is loaded already.
bool glx_has_context() {
  for (const char* const name : {"libGLX.so.0", "libGL.so.1"}) {
    void* const library = dlopen(name, RTLD_LAZY | RTLD_NOLOAD);
    if (library == nullptr) continue;
    using CurrentContext = void* (*)();
    const auto current = reinterpret_cast<CurrentContext>(dlsym(library, "glXGetCurrentContext"));
    const bool has = current != nullptr && current() != nullptr;
    dlclose(library);
    if (has) return true;
  }
  return false;
}

bool egl_is_there() {
  void* const library = dlopen("libEGL.so.1", RTLD_LAZY);
  if (library == nullptr) return false;
  dlclose(library);
  return true;
}

}  // namespace

struct OffscreenContext::Impl {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;

  Impl() = default;
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  ~Impl() {
    if (display == EGL_NO_DISPLAY) return;
    if (context != EGL_NO_CONTEXT) {
      if (eglGetCurrentContext() == context) {
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
      }
      eglDestroyContext(display, context);
    }
    // The display stays: another context of this program may be of it, and EGL does not count.
  }
};

OffscreenContext::OffscreenContext(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
OffscreenContext::OffscreenContext(OffscreenContext&&) noexcept = default;
OffscreenContext& OffscreenContext::operator=(OffscreenContext&&) noexcept = default;
OffscreenContext::~OffscreenContext() = default;

Result<OffscreenContext> OffscreenContext::create() {
  if (!egl_is_there()) {
    return lacking(
        "drawing without a window needs EGL, and libEGL.so.1 is not on this machine "
        "(Debian: libegl1 and libegl-mesa0)");
  }
  auto impl = std::make_unique<Impl>();
  impl->display = open_display();
  if (impl->display == EGL_NO_DISPLAY) {
    return lacking(
        "drawing without a window needs EGL's surfaceless or device platform, and "
        "neither could be opened (Debian: libegl-mesa0 and libgl1-mesa-dri; " +
        egl_error() + ")");
  }
  constexpr std::array<EGLint, 7> kCore{EGL_CONTEXT_MAJOR_VERSION,
                                        4,
                                        EGL_CONTEXT_MINOR_VERSION,
                                        5,
                                        EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                        EGL_NONE};
  if (eglBindAPI(EGL_OPENGL_API)) {
    impl->context =
        eglCreateContext(impl->display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, kCore.data());
  }
  if (impl->context == EGL_NO_CONTEXT ||
      !eglMakeCurrent(impl->display, EGL_NO_SURFACE, EGL_NO_SURFACE, impl->context)) {
    return lacking(
        "drawing needs OpenGL 4.5, and EGL offers no such context without a window "
        "(Debian: libgl1-mesa-dri; " +
        egl_error() + ")");
  }
  if (Status checked = check_current_context(); !checked) return checked.error();
  return OffscreenContext(std::move(impl));
}

Status check_current_context() {
  const bool egl = egl_is_there() && eglGetCurrentContext() != EGL_NO_CONTEXT;
  if (!egl && !glx_has_context()) {
    return lacking("drawing needs OpenGL 4.5, and no context is current on this thread");
  }
  const auto* const version = reinterpret_cast<const char*>(glGetString(GL_VERSION));
  const auto* const renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  const std::string what = fmt::format("\"{}\" on \"{}\"", version != nullptr ? version : "?",
                                       renderer != nullptr ? renderer : "?");
  if (!epoxy_is_desktop_gl()) {
    return lacking("drawing needs desktop OpenGL 4.5, and the current context is " + what);
  }
  if (epoxy_gl_version() < kLeastVersion) {
    return lacking("drawing needs OpenGL 4.5, and the current context is " + what);
  }
  return ok_status();
}

}  // namespace nade::draw
