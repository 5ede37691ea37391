// nade in the frame loop of an OpenXR program: both hands as the runtime tracks them, corrected on
// a table, once a frame. Where this prints, a program with a swapchain draws.
//   openxr_loop [FRAMES [METRES]]    the table's height above the floor

// NOLINTBEGIN(readability-identifier-naming): OpenXR's names
#define XR_USE_GRAPHICS_API_OPENGL
#define XR_USE_PLATFORM_EGL
// NOLINTEND(readability-identifier-naming)
#include <EGL/egl.h>
#include <openxr/openxr.h>
#include <openxr/openxr_platform.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <optional>

#include "nade/corrector.h"
#include "nade/draw/gl_context.h"
#include "nade/openxr.h"
#include "nade/surface.h"

namespace {

constexpr std::array kSides{nade::Handedness::left, nade::Handedness::right};
constexpr std::array<EGLint, 5> kOpenGl{EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0,
                                        EGL_NONE};

void must(XrResult result, const char* call) {
  if (XR_SUCCEEDED(result)) return;
  std::fprintf(stderr, "openxr_loop: %s: failed with %d\n", call, static_cast<int>(result));
  std::exit(1);
}

template <typename Struct>
Struct of_type(XrStructureType type) {
  Struct made{};
  made.type = type;
  return made;
}

template <typename Function>
Function find(XrInstance instance, const char* name) {
  PFN_xrVoidFunction found = nullptr;
  must(xrGetInstanceProcAddr(instance, name, &found), name);
  return reinterpret_cast<Function>(found);
}

/// What of OpenXR a program keeps.
struct Xr {
  XrInstance instance = XR_NULL_HANDLE;
  XrSession session = XR_NULL_HANDLE;
  XrSpace space = XR_NULL_HANDLE;
  std::array<XrHandTrackerEXT, 2> trackers{};
  PFN_xrLocateHandJointsEXT locate = nullptr;
};

Xr connect() {
  Xr xr;
  constexpr std::array kExtensions{XR_EXT_HAND_TRACKING_EXTENSION_NAME,
                                   XR_KHR_OPENGL_ENABLE_EXTENSION_NAME,
                                   XR_MNDX_EGL_ENABLE_EXTENSION_NAME};
  auto wanted = of_type<XrInstanceCreateInfo>(XR_TYPE_INSTANCE_CREATE_INFO);
  std::strcpy(wanted.applicationInfo.applicationName, "openxr_loop");
  wanted.applicationInfo.apiVersion = XR_MAKE_VERSION(1, 0, 0);
  wanted.enabledExtensionCount = kExtensions.size();
  wanted.enabledExtensionNames = kExtensions.data();
  must(xrCreateInstance(&wanted, &xr.instance), "xrCreateInstance");

  auto headset = of_type<XrSystemGetInfo>(XR_TYPE_SYSTEM_GET_INFO);
  headset.formFactor = XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY;
  auto session = of_type<XrSessionCreateInfo>(XR_TYPE_SESSION_CREATE_INFO);
  must(xrGetSystem(xr.instance, &headset, &session.systemId), "xrGetSystem");
  // Asked for before a session, whatever the answer.
  auto versions =
      of_type<XrGraphicsRequirementsOpenGLKHR>(XR_TYPE_GRAPHICS_REQUIREMENTS_OPENGL_KHR);
  must(find<PFN_xrGetOpenGLGraphicsRequirementsKHR>(
           xr.instance, "xrGetOpenGLGraphicsRequirementsKHR")(xr.instance, session.systemId,
                                                              &versions),
       "xrGetOpenGLGraphicsRequirementsKHR");
  auto graphics = of_type<XrGraphicsBindingEGLMNDX>(XR_TYPE_GRAPHICS_BINDING_EGL_MNDX);
  graphics.getProcAddress = eglGetProcAddress;
  graphics.display = eglGetCurrentDisplay();
  graphics.context = eglGetCurrentContext();
  EGLint count = 0;
  eglChooseConfig(graphics.display, kOpenGl.data(), &graphics.config, 1, &count);
  session.next = &graphics;
  must(xrCreateSession(xr.instance, &session, &xr.session), "xrCreateSession");

  // Hands are corrected where objects stand still: in a space of the room, not of the head.
  auto space = of_type<XrReferenceSpaceCreateInfo>(XR_TYPE_REFERENCE_SPACE_CREATE_INFO);
  space.referenceSpaceType = XR_REFERENCE_SPACE_TYPE_STAGE;
  space.poseInReferenceSpace.orientation.w = 1.0F;
  must(xrCreateReferenceSpace(xr.session, &space, &xr.space), "xrCreateReferenceSpace");

  const auto create = find<PFN_xrCreateHandTrackerEXT>(xr.instance, "xrCreateHandTrackerEXT");
  xr.locate = find<PFN_xrLocateHandJointsEXT>(xr.instance, "xrLocateHandJointsEXT");
  for (std::size_t i = 0; i < kSides.size(); ++i) {
    auto tracker = of_type<XrHandTrackerCreateInfoEXT>(XR_TYPE_HAND_TRACKER_CREATE_INFO_EXT);
    tracker.hand = i == 0 ? XR_HAND_LEFT_EXT : XR_HAND_RIGHT_EXT;
    must(create(xr.session, &tracker, &xr.trackers[i]), "xrCreateHandTrackerEXT");
  }
  return xr;
}

/// No value in frames in which the hand is not tracked.
std::optional<nade::HandPose> locate(const Xr& xr, std::size_t side, XrTime time) {
  std::array<XrHandJointLocationEXT, XR_HAND_JOINT_COUNT_EXT> joints{};
  auto locations = of_type<XrHandJointLocationsEXT>(XR_TYPE_HAND_JOINT_LOCATIONS_EXT);
  locations.jointCount = joints.size();
  locations.jointLocations = joints.data();
  auto where = of_type<XrHandJointsLocateInfoEXT>(XR_TYPE_HAND_JOINTS_LOCATE_INFO_EXT);
  where.baseSpace = xr.space;
  where.time = time;
  must(xr.locate(xr.trackers[side], &where, &locations), "xrLocateHandJointsEXT");
  if (locations.isActive == XR_FALSE) return std::nullopt;
  return nade::openxr::hand_from(kSides[side], joints);
}

/// Follows the runtime's wishes; false when the program shall end.
bool follow_events(const Xr& xr, bool& running) {
  auto event = of_type<XrEventDataBuffer>(XR_TYPE_EVENT_DATA_BUFFER);
  while (xrPollEvent(xr.instance, &event) == XR_SUCCESS) {
    if (event.type == XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED) {
      XrEventDataSessionStateChanged change;
      std::memcpy(&change, &event, sizeof change);
      if (change.state == XR_SESSION_STATE_READY) {
        auto begin = of_type<XrSessionBeginInfo>(XR_TYPE_SESSION_BEGIN_INFO);
        begin.primaryViewConfigurationType = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;
        must(xrBeginSession(xr.session, &begin), "xrBeginSession");
        running = true;
      } else if (change.state == XR_SESSION_STATE_STOPPING) {
        must(xrEndSession(xr.session), "xrEndSession");
        running = false;
      } else if (change.state == XR_SESSION_STATE_EXITING ||
                 change.state == XR_SESSION_STATE_LOSS_PENDING) {
        return false;
      }
    }
    event = of_type<XrEventDataBuffer>(XR_TYPE_EVENT_DATA_BUFFER);
  }
  return true;
}

void draw(const nade::HandPose& tracked, const nade::CorrectedHand& hand, double table_m) {
  const auto above_mm = [table_m](const nade::HandPose& pose) {
    return 1000.0 * (pose[nade::Joint::palm].position.y() - table_m);
  };
  std::printf("%s palm: tracked at %7.1f mm above the table, drawn at %7.1f mm\n",
              hand.pose.side == nade::Handedness::left ? "left " : "right", above_mm(tracked),
              above_mm(hand.pose));
}

}  // namespace

int main(int argc, char** argv) {
  const int frames = argc > 1 ? std::atoi(argv[1]) : 900;
  const double table_m = argc > 2 ? std::atof(argv[2]) : 0.9;
  const auto context = nade::draw::OffscreenContext::create();
  if (!context) {
    std::fprintf(stderr, "openxr_loop: %s\n", context.error().message.c_str());
    return 1;
  }
  const Xr xr = connect();
  const nade::PlaneSurface plane;
  nade::Placement table;
  table.pose.position.y() = table_m;
  const nade::Object object(plane, table);
  std::array<nade::HandCorrector, 2> correctors;  // one for each hand
  bool running = false;
  for (int frame = 0; frame < frames && follow_events(xr, running);) {
    if (!running) continue;
    auto state = of_type<XrFrameState>(XR_TYPE_FRAME_STATE);
    must(xrWaitFrame(xr.session, nullptr, &state), "xrWaitFrame");
    must(xrBeginFrame(xr.session, nullptr), "xrBeginFrame");
    for (std::size_t side = 0; side < kSides.size(); ++side) {
      // At the time at which the picture will be seen: so does the runtime predict the hand.
      const XrTime time = state.predictedDisplayTime;
      const std::optional<nade::HandPose> tracked = locate(xr, side, time);
      if (tracked) draw(*tracked, correctors[side].update(*tracked, object, time), table_m);
    }
    auto end = of_type<XrFrameEndInfo>(XR_TYPE_FRAME_END_INFO);
    end.displayTime = state.predictedDisplayTime;
    end.environmentBlendMode = XR_ENVIRONMENT_BLEND_MODE_OPAQUE;
    must(xrEndFrame(xr.session, &end), "xrEndFrame");
    ++frame;
  }
  must(xrDestroyInstance(xr.instance), "xrDestroyInstance");
  return 0;
}
