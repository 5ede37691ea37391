#include "headset.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string_view>
#include <utility>
#include <vector>

// Based on: The Khronos Group. The OpenXR Specification, version 1.0. Chapters 4 and 5.

namespace nade::xr {
namespace {

Error missing(std::string sentence) { return {ErrorCode::not_found, std::move(sentence)}; }

Error no_runtime(XrResult result) {
  return missing(fmt::format(
      "no OpenXR runtime answers ({}): start the headset's own (Monado, WiVRn, SteamVR) and make "
      "it the active one, or name its file in XR_RUNTIME_JSON",
      name_of(result)));
}

bool offers(const std::vector<XrExtensionProperties>& all, std::string_view name) {
  return std::any_of(all.begin(), all.end(), [name](const XrExtensionProperties& extension) {
    return name == extension.extensionName;
  });
}

template <std::size_t kSize>
void put(char (&into)[kSize], std::string_view text) {
  const std::size_t length = std::min(text.size(), kSize - 1);
  std::memcpy(into, text.data(), length);
  into[length] = '\0';
}

}  // namespace

Result<Headset> Headset::find(std::span<const GraphicsWay> graphics) {
  Headset headset;
  Result<XrApi> api = XrApi::open();
  if (!api) return api.error();
  headset.api_ = *api;
  if (Status status = headset.create_instance(graphics); !status) return status.error();
  if (Status status = headset.find_system(); !status) return status.error();
  if (Status status = headset.find_views(); !status) return status.error();
  return headset;
}

void Headset::scale_eyes(double factor) {
  const auto scaled = [factor](int length, int largest) {
    return std::clamp(static_cast<int>(std::lround(factor * length)), 1, std::max(largest, length));
  };
  for (std::size_t eye = 0; eye < 2; ++eye) {
    eyes_[eye] = {scaled(eyes_[eye].width, largest_eyes_[eye].width),
                  scaled(eyes_[eye].height, largest_eyes_[eye].height)};
  }
}

Status Headset::create_instance(std::span<const GraphicsWay> graphics) {
  std::uint32_t count = 0;
  XrResult result = api_.xrEnumerateInstanceExtensionProperties(nullptr, 0, &count, nullptr);
  if (XR_FAILED(result)) return no_runtime(result);
  std::vector<XrExtensionProperties> offered(count, {XR_TYPE_EXTENSION_PROPERTIES, nullptr, {}, 0});
  result = api_.xrEnumerateInstanceExtensionProperties(nullptr, count, &count, offered.data());
  if (XR_FAILED(result)) return no_runtime(result);

  if (!offers(offered, XR_KHR_OPENGL_ENABLE_EXTENSION_NAME)) {
    return missing(
        "the OpenXR runtime takes no pictures made with OpenGL (XR_KHR_opengl_enable), which nade "
        "draws with: use another runtime for this headset, such as Monado, WiVRn or SteamVR");
  }
  const auto way = std::find_if(graphics.begin(), graphics.end(), [&](GraphicsWay each) {
    return offers(offered, extension_of(each));
  });
  if (way == graphics.end()) {
    return missing(
        fmt::format("the OpenXR runtime does not offer {}: leave --graphics out, or use another "
                    "runtime",
                    extension_of(graphics.front())));
  }
  graphics_ = *way;
  if (!offers(offered, XR_EXT_HAND_TRACKING_EXTENSION_NAME)) {
    return missing(
        "the OpenXR runtime tracks no hands (XR_EXT_hand_tracking): switch hand tracking on in its "
        "settings, or use a headset or a runtime that has it");
  }
  std::vector<const char*> wanted{XR_KHR_OPENGL_ENABLE_EXTENSION_NAME,
                                  XR_EXT_HAND_TRACKING_EXTENSION_NAME};
  if (graphics_ == GraphicsWay::egl) wanted.push_back(extension_of(graphics_));
  local_floor_ = offers(offered, XR_EXT_LOCAL_FLOOR_EXTENSION_NAME);
  if (local_floor_) wanted.push_back(XR_EXT_LOCAL_FLOOR_EXTENSION_NAME);
  data_source_ = offers(offered, XR_EXT_HAND_TRACKING_DATA_SOURCE_EXTENSION_NAME);
  if (data_source_) wanted.push_back(XR_EXT_HAND_TRACKING_DATA_SOURCE_EXTENSION_NAME);

  XrInstanceCreateInfo create{};
  create.type = XR_TYPE_INSTANCE_CREATE_INFO;
  put(create.applicationInfo.applicationName, "nade");
  put(create.applicationInfo.engineName, "nade");
  create.applicationInfo.apiVersion = XR_MAKE_VERSION(1, 0, 0);
  create.enabledExtensionCount = static_cast<std::uint32_t>(wanted.size());
  create.enabledExtensionNames = wanted.data();
  XrInstance instance = XR_NULL_HANDLE;
  result = api_.xrCreateInstance(&create, &instance);
  if (XR_FAILED(result)) return no_runtime(result);
  api_.load(instance);
  instance_ = {instance, api_.xrDestroyInstance};
  return ok_status();
}

Status Headset::find_system() {
  XrSystemGetInfo wanted{XR_TYPE_SYSTEM_GET_INFO, nullptr, XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY};
  const XrResult result = api_.xrGetSystem(instance(), &wanted, &system_);
  if (XR_FAILED(result)) {
    return missing(
        fmt::format("the OpenXR runtime is there but no headset is ({}): connect it, switch it on, "
                    "and put it on or wake it",
                    name_of(result)));
  }
  XrSystemHandTrackingPropertiesEXT hands{XR_TYPE_SYSTEM_HAND_TRACKING_PROPERTIES_EXT, nullptr, 0};
  XrSystemProperties system{};
  system.type = XR_TYPE_SYSTEM_PROPERTIES;
  system.next = &hands;
  if (XR_FAILED(api_.xrGetSystemProperties(instance(), system_, &system)) ||
      hands.supportsHandTracking == XR_FALSE) {
    return missing(
        fmt::format("the headset \"{}\" tracks no hands: switch its hand tracking on, put its "
                    "controllers down, or use one that has it",
                    system.systemName));
  }
  XrInstanceProperties runtime{};
  runtime.type = XR_TYPE_INSTANCE_PROPERTIES;
  if (XR_SUCCEEDED(api_.xrGetInstanceProperties(instance(), &runtime))) {
    name_ = fmt::format("{} {}.{}.{}, {}", runtime.runtimeName,
                        XR_VERSION_MAJOR(runtime.runtimeVersion),
                        XR_VERSION_MINOR(runtime.runtimeVersion),
                        XR_VERSION_PATCH(runtime.runtimeVersion), system.systemName);
  }
  return ok_status();
}

Status Headset::find_views() {
  constexpr XrViewConfigurationType kStereo = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;
  std::array<XrViewConfigurationView, 2> views{};
  for (auto& view : views) view.type = XR_TYPE_VIEW_CONFIGURATION_VIEW;
  std::uint32_t count = 0;
  const XrResult result =
      api_.xrEnumerateViewConfigurationViews(instance(), system_, kStereo, 2, &count, views.data());
  if (XR_FAILED(result) || count != 2) {
    return missing(
        fmt::format("the headset shows no two pictures, one for each eye ({}): use one "
                    "that does",
                    name_of(result)));
  }
  for (std::size_t eye = 0; eye < 2; ++eye) {
    eyes_[eye] = {static_cast<int>(views[eye].recommendedImageRectWidth),
                  static_cast<int>(views[eye].recommendedImageRectHeight)};
    largest_eyes_[eye] = {static_cast<int>(views[eye].maxImageRectWidth),
                          static_cast<int>(views[eye].maxImageRectHeight)};
  }
  std::array<XrEnvironmentBlendMode, 8> modes{};
  if (XR_SUCCEEDED(api_.xrEnumerateEnvironmentBlendModes(instance(), system_, kStereo,
                                                         static_cast<std::uint32_t>(modes.size()),
                                                         &count, modes.data())) &&
      count > 0 &&
      std::find(modes.begin(), modes.begin() + count, XR_ENVIRONMENT_BLEND_MODE_OPAQUE) ==
          modes.begin() + count) {
    blend_mode_ = modes[0];
  }
  return ok_status();
}

}  // namespace nade::xr
