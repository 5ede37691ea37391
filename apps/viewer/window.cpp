#include "window.h"

#include <epoxy/gl.h>
// After epoxy, which brings OpenGL's names.
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <memory>
#include <string>
#include <utility>

#include "canvas.h"

namespace nade::viewer {
namespace {

constexpr double kLongestStep_s = 0.1;
/// Where so many first frames took longer than this each, the scene is drawn coarsely.
constexpr std::size_t kFramesToJudge = 12;
constexpr double kSlowFrame_s = 1.0 / 15.0;

/// What GLFW said last.
std::string& last_complaint() {
  static std::string complaint;
  return complaint;
}

void note_complaint(int /*code*/, const char* text) { last_complaint() = text; }

struct GlfwLibrary {
  GlfwLibrary() = default;
  GlfwLibrary(const GlfwLibrary&) = delete;
  GlfwLibrary& operator=(const GlfwLibrary&) = delete;
  ~GlfwLibrary() { glfwTerminate(); }
};

struct WindowCloser {
  void operator()(GLFWwindow* window) const { glfwDestroyWindow(window); }
};
using Window = std::unique_ptr<GLFWwindow, WindowCloser>;

struct KeyCode {
  int glfw;
  Key key;
};

constexpr std::array<KeyCode, 30> kKeyCodes{{
    {GLFW_KEY_SPACE, Key::space},
    {GLFW_KEY_TAB, Key::tab},
    {GLFW_KEY_ESCAPE, Key::escape},
    {GLFW_KEY_LEFT, Key::left},
    {GLFW_KEY_RIGHT, Key::right},
    {GLFW_KEY_UP, Key::up},
    {GLFW_KEY_DOWN, Key::down},
    {GLFW_KEY_HOME, Key::home},
    {GLFW_KEY_END, Key::end},
    {GLFW_KEY_LEFT_SHIFT, Key::shift},
    {GLFW_KEY_RIGHT_SHIFT, Key::shift},
    {GLFW_KEY_LEFT_CONTROL, Key::control},
    {GLFW_KEY_RIGHT_CONTROL, Key::control},
    {GLFW_KEY_KP_ADD, Key::plus},
    {GLFW_KEY_KP_SUBTRACT, Key::minus},
    {GLFW_KEY_KP_1, Key::one},
    {GLFW_KEY_KP_2, Key::two},
    {GLFW_KEY_KP_3, Key::three},
    {GLFW_KEY_KP_4, Key::four},
    {GLFW_KEY_KP_5, Key::five},
    {GLFW_KEY_1, Key::one},
    {GLFW_KEY_2, Key::two},
    {GLFW_KEY_3, Key::three},
    {GLFW_KEY_4, Key::four},
    {GLFW_KEY_5, Key::five},
    {GLFW_KEY_EQUAL, Key::plus},
    {GLFW_KEY_MINUS, Key::minus},
    {GLFW_KEY_COMMA, Key::comma},
    {GLFW_KEY_PERIOD, Key::period},
    {GLFW_KEY_F1, Key::h},
}};

/// Letters by what is printed on the person's keyboard, the rest by where they are.
std::optional<Key> key_of(int code, int scancode) {
  for (const KeyCode& known : kKeyCodes) {
    if (known.glfw == code && code != 0) return known.key;
  }
  const char* const printed = glfwGetKeyName(code, scancode);
  return printed == nullptr ? std::nullopt : key_from_name(printed);
}

Input& input_of(GLFWwindow* window) {
  return *static_cast<Input*>(glfwGetWindowUserPointer(window));
}

void on_key(GLFWwindow* window, int code, int scancode, int action, int /*mods*/) {
  if (action == GLFW_REPEAT) return;
  const std::optional<Key> key = key_of(code, scancode);
  if (!key) return;
  Event event;
  event.kind = Event::Kind::key;
  event.key = *key;
  event.change = action == GLFW_PRESS ? Change::down : Change::up;
  input_of(window).take(event);
}

/// The question mark is on another key on every keyboard.
void on_character(GLFWwindow* window, unsigned character) {
  if (character == '?') input_of(window).pressed.push_back(Key::question);
}

void on_move(GLFWwindow* window, double x, double y) {
  int width = 0;
  int height = 0;
  glfwGetWindowSize(window, &width, &height);
  const Input& input = input_of(window);
  Event event;
  event.x = x * input.width / std::max(width, 1);  // a pixel of the screen may be several of ours
  event.y = y * input.height / std::max(height, 1);
  input_of(window).take(event);
}

void on_enter(GLFWwindow* window, int entered) {
  if (entered != 0) return;
  Event event;
  event.kind = Event::Kind::leave;
  input_of(window).take(event);
}

void on_button(GLFWwindow* window, int button, int action, int /*mods*/) {
  Event event;
  event.kind = Event::Kind::button;
  event.change = action == GLFW_PRESS ? Change::down : Change::up;
  if (button == GLFW_MOUSE_BUTTON_LEFT) {
    event.button = Button::left;
  } else if (button == GLFW_MOUSE_BUTTON_RIGHT) {
    event.button = Button::right;
  } else if (button == GLFW_MOUSE_BUTTON_MIDDLE) {
    event.button = Button::middle;
  } else {
    return;
  }
  input_of(window).take(event);
}

void on_wheel(GLFWwindow* window, double /*aside*/, double notches) {
  Event event;
  event.kind = Event::Kind::wheel;
  event.wheel = notches;
  input_of(window).take(event);
}

void on_drop(GLFWwindow* window, int count, const char** paths) {
  for (int i = 0; i < count; ++i) {
    Event event;
    event.kind = Event::Kind::drop;
    event.path = paths[i];
    input_of(window).take(event);
  }
}

Result<Window> open_window(const Run& run, Input& input) {
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_DEPTH_BITS, 24);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  Window window(glfwCreateWindow(run.width, run.height, "nade", nullptr, nullptr));
  if (!window) {
    return Error{ErrorCode::not_found,
                 fmt::format("no window with OpenGL 4.5 could be opened ({}): update the graphics "
                             "driver, or try LIBGL_ALWAYS_SOFTWARE=1, or draw without a window: "
                             "nade view --headless --screenshot FILE",
                             last_complaint())};
  }
  glfwMakeContextCurrent(window.get());
  glfwSwapInterval(1);
  glfwSetWindowUserPointer(window.get(), &input);
  glfwSetKeyCallback(window.get(), on_key);
  glfwSetCharCallback(window.get(), on_character);
  glfwSetCursorPosCallback(window.get(), on_move);
  glfwSetCursorEnterCallback(window.get(), on_enter);
  glfwSetMouseButtonCallback(window.get(), on_button);
  glfwSetScrollCallback(window.get(), on_wheel);
  glfwSetDropCallback(window.get(), on_drop);
  const Status usable = draw::check_current_context();
  if (!usable) return usable.error();
  return window;
}

Status loop(GLFWwindow* window, Viewer& viewer, const Run& run, Input& input) {
  ScriptPlayer script(run.script);
  const bool scripted = !run.script.empty();
  const double start_s = glfwGetTime();
  double before_s = start_s;
  for (std::size_t i = 0; glfwWindowShouldClose(window) == 0; ++i) {
    const double now_s = glfwGetTime();
    input.start_frame(scripted ? kFixedStep_s : std::clamp(now_s - before_s, 1e-4, kLongestStep_s));
    if (!scripted) input.elapsed_s = now_s - before_s;
    before_s = now_s;
    if (!scripted && i == kFramesToJudge && now_s - start_s > kFramesToJudge * kSlowFrame_s) {
      viewer.desk().coarse = true;
    }
    glfwGetFramebufferSize(window, &input.width, &input.height);
    glfwPollEvents();
    const Result<std::vector<Event>> events = script.next(viewer.ui());
    if (!events) return events.error();
    for (const Event& event : *events) input.take(event);
    if (input.width <= 0 || input.height <= 0) {  // put away
      glfwWaitEventsTimeout(kLongestStep_s);
      continue;
    }
    viewer.frame(input, 0);
    if (viewer.wants_to_close()) break;
    if (run.frames && i + 1 >= *run.frames) {
      if (!run.screenshot) return ok_status();
      return draw::save_png(*run.screenshot, read_back(0, input.width, input.height));
    }
    glfwSwapBuffers(window);
  }
  return ok_status();
}

}  // namespace

Status run_window(ViewerSetup setup, const Run& run) {
  if (run.frames) {
    if (const Status fits = check_length(run.script, *run.frames); !fits) return fits;
  }
  glfwSetErrorCallback(note_complaint);
  if (glfwInit() == GLFW_FALSE) {
    const char* const display = std::getenv("DISPLAY");
    const bool unset = display == nullptr || *display == '\0';
    return Error{ErrorCode::not_found,
                 fmt::format("no display to open a window on ({}): start it in a desktop session, "
                             "or {}",
                             unset ? "DISPLAY is not set" : fmt::format("DISPLAY={}", display),
                             setup.study ? "in a headset: --xr"
                                         : "draw without a window: nade view --headless "
                                           "--screenshot FILE")};
  }
  const GlfwLibrary library;
  Input input;
  const Result<Window> window = open_window(run, input);
  if (!window) return window.error();
  float aside = 1.0F;
  glfwGetWindowContentScale(window->get(), &setup.scale, &aside);
  setup.scale = std::clamp(setup.scale, 1.0F, 4.0F);
  Result<std::unique_ptr<Viewer>> viewer = Viewer::create(std::move(setup));
  if (!viewer) return viewer.error();
  return loop(window->get(), **viewer, run, input);
}

}  // namespace nade::viewer
