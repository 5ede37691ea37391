#pragma once

#include "nade/status.h"
#include "xr_platform.h"

namespace nade::xr {

// clang-format off
#define NADE_XR_FUNCTIONS(X)                                                                       \
  X(xrDestroyInstance) X(xrGetInstanceProperties) X(xrPollEvent) X(xrGetSystem)                    \
  X(xrGetSystemProperties) X(xrEnumerateViewConfigurations) X(xrEnumerateViewConfigurationViews)   \
  X(xrEnumerateEnvironmentBlendModes) X(xrCreateSession) X(xrDestroySession)                       \
  X(xrEnumerateReferenceSpaces) X(xrCreateReferenceSpace) X(xrDestroySpace) X(xrLocateSpace)       \
  X(xrEnumerateSwapchainFormats) X(xrCreateSwapchain) X(xrDestroySwapchain)                        \
  X(xrEnumerateSwapchainImages) X(xrAcquireSwapchainImage) X(xrWaitSwapchainImage)                 \
  X(xrReleaseSwapchainImage) X(xrBeginSession) X(xrEndSession) X(xrRequestExitSession)             \
  X(xrWaitFrame) X(xrBeginFrame) X(xrEndFrame) X(xrLocateViews)                                    \
  X(xrGetOpenGLGraphicsRequirementsKHR) X(xrCreateHandTrackerEXT) X(xrDestroyHandTrackerEXT)       \
  X(xrLocateHandJointsEXT)
// clang-format on

/// OpenXR's functions. The loader is opened when it is asked for, so that everything else of the
/// program works on machines without one.
struct XrApi {
  PFN_xrGetInstanceProcAddr get = nullptr;
  PFN_xrEnumerateInstanceExtensionProperties xrEnumerateInstanceExtensionProperties = nullptr;
  PFN_xrEnumerateApiLayerProperties xrEnumerateApiLayerProperties = nullptr;
  PFN_xrCreateInstance xrCreateInstance = nullptr;
#define NADE_XR_MEMBER(name) PFN_##name name = nullptr;
  NADE_XR_FUNCTIONS(NADE_XR_MEMBER)
#undef NADE_XR_MEMBER

  /// What needs no instance. The error says that there is no loader, and what to install.
  [[nodiscard]] static Result<XrApi> open();
  /// Everything else; the instance's extensions decide which of the last ones are there.
  void load(XrInstance instance);
};

/// "XR_ERROR_INSTANCE_LOST", or the number where it has no name that we know.
[[nodiscard]] std::string name_of(XrResult result);

}  // namespace nade::xr
