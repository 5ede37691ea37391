#pragma once

#include <utility>

#include "xr_platform.h"

namespace nade::xr {

/// An OpenXR object that is destroyed with its owner.
template <class Raw>
class XrHandle {
 public:
  using Destroy = XrResult(XRAPI_PTR*)(Raw);

  XrHandle() = default;
  XrHandle(Raw raw, Destroy destroy) : raw_(raw), destroy_(destroy) {}
  XrHandle(XrHandle&& other) noexcept
      : raw_(std::exchange(other.raw_, Raw{XR_NULL_HANDLE})), destroy_(other.destroy_) {}
  XrHandle& operator=(XrHandle&& other) noexcept {
    std::swap(raw_, other.raw_);
    std::swap(destroy_, other.destroy_);
    return *this;
  }
  ~XrHandle() {
    if (raw_ != Raw{XR_NULL_HANDLE}) destroy_(raw_);
  }

  [[nodiscard]] Raw get() const { return raw_; }

 private:
  Raw raw_ = XR_NULL_HANDLE;
  Destroy destroy_ = nullptr;
};

}  // namespace nade::xr
