#include "sheet_canvas.h"

#include <algorithm>
#include <cmath>

#include "nade/draw/text.h"

namespace nade::cli {
namespace {

constexpr float kCornerPx = 14.0F;

float to_srgb(float c) {
  return c <= 0.0031308F ? 12.92F * c : 1.055F * std::pow(c, 1.0F / 2.4F) - 0.055F;
}

float distance_to_segment(const Spot& p, const Spot& a, const Spot& b) {
  const Spot along = b - a;
  const float length = along.squaredNorm();
  const float t = length > 0.0F ? std::clamp((p - a).dot(along) / length, 0.0F, 1.0F) : 0.0F;
  return (p - a - t * along).norm();
}

/// How much of the pixel lies in a rounded rectangle that begins at (0, 0).
float rounded_cover(float x, float y, float width, float height) {
  const float dx = std::max({kCornerPx - x, x - (width - kCornerPx), 0.0F});
  const float dy = std::max({kCornerPx - y, y - (height - kCornerPx), 0.0F});
  return std::clamp(kCornerPx + 0.5F - std::hypot(dx, dy), 0.0F, 1.0F);
}

}  // namespace

SheetCanvas::SheetCanvas(int width, int height) : image_(draw::Image::blank(width, height)) {
  std::fill(image_.rgba.begin(), image_.rgba.end(), std::uint8_t{255});
}

void SheetCanvas::blend(int x, int y, const draw::Color& color, float cover) {
  if (x < 0 || y < 0 || x >= image_.width || y >= image_.height || cover <= 0.0F) return;
  const auto index = 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image_.width) +
                          static_cast<std::size_t>(x));
  for (std::size_t k = 0; k < 3; ++k) {
    const float over = 255.0F * to_srgb(color[static_cast<Eigen::Index>(k)]);
    const auto under = static_cast<float>(image_.rgba[index + k]);
    image_.rgba[index + k] = static_cast<std::uint8_t>(
        std::lround(std::clamp(under + cover * (over - under), 0.0F, 255.0F)));
  }
}

void SheetCanvas::paste(const draw::Image& picture, int left, int top) {
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const int to_x = left + x;
      const int to_y = top + y;
      if (to_x < 0 || to_y < 0 || to_x >= image_.width || to_y >= image_.height) continue;
      const float cover =
          rounded_cover(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F,
                        static_cast<float>(picture.width), static_cast<float>(picture.height));
      const auto from = 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                             static_cast<std::size_t>(x));
      const auto to = 4 * (static_cast<std::size_t>(to_y) * static_cast<std::size_t>(image_.width) +
                           static_cast<std::size_t>(to_x));
      for (std::size_t k = 0; k < 3; ++k) {
        const auto under = static_cast<float>(image_.rgba[to + k]);
        const auto over = static_cast<float>(picture.rgba[from + k]);
        image_.rgba[to + k] =
            static_cast<std::uint8_t>(std::lround(under + cover * (over - under)));
      }
    }
  }
}

/// Colours where `distance`, in pixels, is below zero, with soft edges.
template <class Distance>
void SheetCanvas::fill(const Spot& low, const Spot& high, const draw::Color& color,
                       const Distance& distance) {
  for (int y = static_cast<int>(low.y()) - 1; y <= static_cast<int>(high.y()) + 1; ++y) {
    for (int x = static_cast<int>(low.x()) - 1; x <= static_cast<int>(high.x()) + 1; ++x) {
      const Spot at(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
      blend(x, y, color, std::clamp(0.5F - distance(at), 0.0F, 1.0F));
    }
  }
}

void SheetCanvas::line(const Spot& from, const Spot& to, float width_px, const draw::Color& color) {
  const Spot reach = Spot::Constant(width_px);
  fill(from.cwiseMin(to) - reach, from.cwiseMax(to) + reach, color,
       [&](const Spot& at) { return distance_to_segment(at, from, to) - 0.5F * width_px; });
}

void SheetCanvas::disc(const Spot& center, float radius_px, const draw::Color& color) {
  const Spot reach = Spot::Constant(radius_px);
  fill(center - reach, center + reach, color,
       [&](const Spot& at) { return (at - center).norm() - radius_px; });
}

void SheetCanvas::arrow(const Spot& from, const Spot& to, float width_px,
                        const draw::Color& color) {
  const Spot along = (to - from).normalized();
  const float head = 4.0F * width_px;
  line(from, to - 0.8F * head * along, width_px, color);
  const Spot reach = Spot::Constant(head);
  fill(from.cwiseMin(to) - reach, from.cwiseMax(to) + reach, color, [&](const Spot& at) {
    const float back = (to - at).dot(along);
    const float side = std::abs(along.x() * (at - to).y() - along.y() * (at - to).x());
    return std::max({-back, back - head, side - 0.5F * back});
  });
}

void SheetCanvas::text(const Spot& at, std::string_view utf8, float height_px,
                       const draw::Color& color) {
  draw::draw_text(image_, at.x(), at.y(), utf8, height_px, color);
}

void SheetCanvas::centered(const Spot& at, std::string_view utf8, float height_px,
                           const draw::Color& color) {
  text({at.x() - 0.5F * draw::text_width(utf8, height_px), at.y()}, utf8, height_px, color);
}

}  // namespace nade::cli
