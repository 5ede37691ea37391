#pragma once

#include <optional>
#include <vector>

#include "nade/draw/image.h"
#include "nade/geometry.h"
#include "nade/study/panel.h"

namespace nade::xr {

/// The size of every panel: metres in the room, pixels in its picture.
inline constexpr int kPanelWidth_px = 1024;
inline constexpr int kPanelHeight_px = 768;
inline constexpr double kPanelWidth_m = 0.40;
inline constexpr double kPanelHeight_m = kPanelWidth_m * kPanelHeight_px / kPanelWidth_px;

/// A button's place in the picture, pixels, top left corner first.
struct ButtonPlace {
  int id = 0;
  bool enabled = true;
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

/// A panel as a picture. Text that does not fit is set smaller, down to half its size.
struct PanelPicture {
  draw::Image image;
  std::vector<ButtonPlace> buttons;

  /// The enabled button at a point of the panel, metres right and up of its middle.
  [[nodiscard]] std::optional<int> button_at(double right_m, double up_m) const;
};
[[nodiscard]] PanelPicture paint(const study::PanelView& view);

/// The middle of a button as a point of the panel, metres right and up of its middle.
[[nodiscard]] Vec3 middle_of(const ButtonPlace& button);

}  // namespace nade::xr
