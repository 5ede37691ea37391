#pragma once

// The one place that brings in OpenXR's headers, after epoxy, which brings EGL's and OpenGL's
// names. What the older of the headers that we build with lack is filled in.
#include <epoxy/egl.h>
#include <epoxy/gl.h>
// Names are OpenXR's.
// NOLINTBEGIN(readability-identifier-naming)
#define XR_USE_PLATFORM_EGL
#define XR_USE_GRAPHICS_API_OPENGL
#include <openxr/openxr.h>
#include <openxr/openxr_platform.h>

#ifndef XR_EXT_local_floor
#define XR_EXT_LOCAL_FLOOR_EXTENSION_NAME "XR_EXT_local_floor"
inline constexpr XrReferenceSpaceType XR_REFERENCE_SPACE_TYPE_LOCAL_FLOOR_EXT =
    static_cast<XrReferenceSpaceType>(1000426000);
#endif

#ifndef XR_EXT_hand_tracking_data_source
#define XR_EXT_HAND_TRACKING_DATA_SOURCE_EXTENSION_NAME "XR_EXT_hand_tracking_data_source"
inline constexpr XrStructureType XR_TYPE_HAND_TRACKING_DATA_SOURCE_INFO_EXT =
    static_cast<XrStructureType>(1000428000);
inline constexpr XrStructureType XR_TYPE_HAND_TRACKING_DATA_SOURCE_STATE_EXT =
    static_cast<XrStructureType>(1000428001);
enum XrHandTrackingDataSourceEXT : int {
  XR_HAND_TRACKING_DATA_SOURCE_UNOBSTRUCTED_EXT = 1,
  XR_HAND_TRACKING_DATA_SOURCE_CONTROLLER_EXT = 2,
};
struct XrHandTrackingDataSourceInfoEXT {
  XrStructureType type;
  const void* next;
  std::uint32_t requestedDataSourceCount;
  XrHandTrackingDataSourceEXT* requestedDataSources;
};
struct XrHandTrackingDataSourceStateEXT {
  XrStructureType type;
  void* next;
  XrBool32 isActive;
  XrHandTrackingDataSourceEXT dataSource;
};
#endif
// NOLINTEND(readability-identifier-naming)
