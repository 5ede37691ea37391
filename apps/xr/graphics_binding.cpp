#include "graphics_binding.h"

namespace nade::xr {

Result<std::unique_ptr<GraphicsBinding>> bind(GraphicsWay way) {
  return way == GraphicsWay::egl ? bind_egl() : bind_xlib();
}

}  // namespace nade::xr
