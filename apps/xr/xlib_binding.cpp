#include <epoxy/gl.h>
#include <epoxy/glx.h>
// Xlib's macros would be in the way of our names.
#undef Bool
#undef None
#undef Status
#undef Success
// After epoxy, which brings OpenGL's names.
#include <GLFW/glfw3.h>
#define XR_USE_PLATFORM_XLIB  // NOLINT(readability-identifier-naming): OpenXR's
#include "graphics_binding.h"
#include "nade/draw/gl_context.h"

namespace nade::xr {
namespace {

class XlibBinding final : public GraphicsBinding {
 public:
  XlibBinding() = default;
  /// The window stays to the program's end: the operator's may still be using GLFW.
  ~XlibBinding() override { glfwMakeContextCurrent(nullptr); }

  [[nodiscard]] Status describe() {
    Display* const display = glXGetCurrentDisplay();
    const GLXContext context = glXGetCurrentContext();
    if (display == nullptr || context == nullptr) return none();
    int id = 0;
    int count = 0;
    if (glXQueryContext(display, context, GLX_FBCONFIG_ID, &id) != 0) return none();
    const int wanted[] = {GLX_FBCONFIG_ID, id, 0};
    GLXFBConfig* const configs = glXChooseFBConfig(display, DefaultScreen(display), wanted, &count);
    if (configs == nullptr || count < 1) return none();
    const GLXFBConfig config = configs[0];
    XFree(configs);
    int visual = 0;
    glXGetFBConfigAttrib(display, config, GLX_VISUAL_ID, &visual);
    link_.type = XR_TYPE_GRAPHICS_BINDING_OPENGL_XLIB_KHR;
    link_.xDisplay = display;
    link_.visualid = static_cast<std::uint32_t>(visual);
    link_.glxFBConfig = config;
    link_.glxDrawable = glXGetCurrentDrawable();
    link_.glxContext = context;
    return ok_status();
  }

  [[nodiscard]] const void* session_link() const override { return &link_; }

 private:
  static Error none() {
    return {ErrorCode::not_found,
            "the X server's OpenGL (GLX) does not say how its context is made"};
  }

  XrGraphicsBindingOpenGLXlibKHR link_{};
};

}  // namespace

Result<std::unique_ptr<GraphicsBinding>> bind_xlib() {
  if (!glfwInit()) {
    return Error{ErrorCode::not_found,
                 "this OpenXR runtime takes pictures only through an X server, and none could be "
                 "reached: start it from a desktop session (or with DISPLAY set)"};
  }
  glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  GLFWwindow* const window = glfwCreateWindow(64, 64, "nade xr", nullptr, nullptr);
  auto binding = std::make_unique<XlibBinding>();
  if (window == nullptr) {
    return Error{ErrorCode::not_found,
                 "drawing needs OpenGL 4.5, and the X server offers no such context"};
  }
  glfwMakeContextCurrent(window);
  if (Status checked = draw::check_current_context(); !checked) return checked.error();
  if (Status described = binding->describe(); !described) return described.error();
  return std::unique_ptr<GraphicsBinding>(std::move(binding));
}

}  // namespace nade::xr
