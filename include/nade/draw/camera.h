#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "nade/draw/scene.h"
#include "nade/hand.h"

namespace nade::draw {

/// Cameras by name, about what is looked at.
enum class View : std::uint8_t { front, side, top, three_quarter, first_person };
[[nodiscard]] std::optional<View> view_from_name(std::string_view name);
[[nodiscard]] std::string_view name_of(View view);

/// A camera on a ball about a target: what a mouse turns, pans and zooms.
struct Orbit {
  Vec3 target = Vec3::Zero();
  double azimuth_rad = 0.6;    ///< about +Y, 0 looks along -Z
  double elevation_rad = 0.4;  ///< above the horizon, within ±89 degrees
  double distance_m = 0.6;
  double vertical_view_rad = 0.6;

  [[nodiscard]] Camera camera(double aspect) const;
};

/// A camera at `eye` that looks at `target`, +Y up as far as can be.
[[nodiscard]] Camera looking_at(const Vec3& eye, const Vec3& target, double vertical_view_rad,
                                double aspect);

/// The orbit of a named view that frames a ball. `first_person` is not an orbit and gives
/// three_quarter's.
[[nodiscard]] Orbit framed(View view, const Vec3& center, double radius_m);

/// From above and behind the wrist along the hand, as its owner sees it.
[[nodiscard]] Camera first_person(const HandPose& hand, double aspect);

}  // namespace nade::draw
