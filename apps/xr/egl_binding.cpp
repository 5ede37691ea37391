#include <utility>

#include "graphics_binding.h"
#include "nade/draw/gl_context.h"

namespace nade::xr {
namespace {

class EglBinding final : public GraphicsBinding {
 public:
  explicit EglBinding(draw::OffscreenContext context) : context_(std::move(context)) {
    link_.type = XR_TYPE_GRAPHICS_BINDING_EGL_MNDX;
    link_.getProcAddress = reinterpret_cast<PFNEGLGETPROCADDRESSPROC>(&get_proc_address);
    link_.display = eglGetCurrentDisplay();
    link_.context = eglGetCurrentContext();
    // The context is of no configuration; runtimes that look at this one only ask of what kind.
    EGLint count = 0;
    constexpr EGLint kOpenGl[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0,
                                  EGL_NONE};
    if (!eglChooseConfig(link_.display, kOpenGl, &link_.config, 1, &count) || count < 1) {
      link_.config = nullptr;
    }
  }

  [[nodiscard]] const void* session_link() const override { return &link_; }

 private:
  using Function = void (*)();
  // epoxy's eglGetProcAddress is a variable, not a function that could be handed on.
  static Function get_proc_address(const char* name) {
    return reinterpret_cast<Function>(eglGetProcAddress(name));
  }

  draw::OffscreenContext context_;
  XrGraphicsBindingEGLMNDX link_{};
};

}  // namespace

Result<std::unique_ptr<GraphicsBinding>> bind_egl() {
  Result<draw::OffscreenContext> context = draw::OffscreenContext::create();
  if (!context) return context.error();
  return std::unique_ptr<GraphicsBinding>(std::make_unique<EglBinding>(std::move(context).value()));
}

}  // namespace nade::xr
