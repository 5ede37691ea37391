#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "graphics_binding.h"
#include "xr_api.h"
#include "xr_handle.h"

namespace nade::xr {

/// What each eye's picture is to be.
struct EyeSize {
  int width = 0;
  int height = 0;
};

/// A runtime that was found, and the headset it offers: OpenXR's instance and system.
class Headset {
 public:
  /// `graphics` are the ways of drawing that may be taken, the best first. The error says in one
  /// sentence what is missing, and what to do: no loader, no runtime, no headset, no hand tracking,
  /// no OpenGL.
  [[nodiscard]] static Result<Headset> find(std::span<const GraphicsWay> graphics);

  /// Makes each eye's picture so many times as wide and high as the headset asks, but no larger
  /// than it can be.
  void scale_eyes(double factor);

  [[nodiscard]] const XrApi& api() const { return api_; }
  [[nodiscard]] XrInstance instance() const { return instance_.get(); }
  [[nodiscard]] XrSystemId system() const { return system_; }
  [[nodiscard]] const std::array<EyeSize, 2>& eyes() const { return eyes_; }
  [[nodiscard]] XrEnvironmentBlendMode blend_mode() const { return blend_mode_; }
  [[nodiscard]] GraphicsWay graphics() const { return graphics_; }
  [[nodiscard]] bool has_local_floor() const { return local_floor_; }
  [[nodiscard]] bool has_data_source() const { return data_source_; }
  /// The runtime's and the headset's own names.
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  Headset() = default;
  [[nodiscard]] Status create_instance(std::span<const GraphicsWay> graphics);
  [[nodiscard]] Status find_system();
  [[nodiscard]] Status find_views();

  XrApi api_;
  XrHandle<XrInstance> instance_;
  XrSystemId system_ = XR_NULL_SYSTEM_ID;
  std::array<EyeSize, 2> eyes_{};
  std::array<EyeSize, 2> largest_eyes_{};
  XrEnvironmentBlendMode blend_mode_ = XR_ENVIRONMENT_BLEND_MODE_OPAQUE;
  GraphicsWay graphics_ = GraphicsWay::egl;
  bool local_floor_ = false;
  bool data_source_ = false;
  std::string name_;
};

}  // namespace nade::xr
