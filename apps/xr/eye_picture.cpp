#include "eye_picture.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace nade::xr {

draw::Image read_back(const draw::Target& target) {
  draw::Image image = draw::Image::blank(target.width, target.height);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, target.framebuffer);
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glReadPixels(target.x, target.y, target.width, target.height, GL_RGBA, GL_UNSIGNED_BYTE,
               image.rgba.data());
  const auto row = static_cast<std::ptrdiff_t>(4) * target.width;
  for (std::ptrdiff_t top = 0, bottom = target.height - 1; top < bottom; ++top, --bottom) {
    std::swap_ranges(image.rgba.begin() + top * row, image.rgba.begin() + (top + 1) * row,
                     image.rgba.begin() + bottom * row);
  }
  return image;
}

std::array<std::string, 2> eye_paths(const std::string& path) {
  constexpr std::string_view kEnding = ".png";
  const bool has_ending = path.size() > kEnding.size() &&
                          std::string_view(path).substr(path.size() - kEnding.size()) == kEnding;
  const std::string stem = has_ending ? path.substr(0, path.size() - kEnding.size()) : path;
  return {stem + "-left" + std::string(kEnding), stem + "-right" + std::string(kEnding)};
}

Status save_eyes(const std::string& path, const std::array<std::optional<draw::Image>, 2>& eyes) {
  const std::array<std::string, 2> names = eye_paths(path);
  for (std::size_t eye = 0; eye < 2; ++eye) {
    if (!eyes[eye]) {
      return Error{ErrorCode::unwritable,
                   fmt::format("{}: no picture of the eyes was drawn in the last frame", path)};
    }
    if (Status saved = draw::save_png(names[eye], *eyes[eye]); !saved) return saved;
  }
  return ok_status();
}

}  // namespace nade::xr
