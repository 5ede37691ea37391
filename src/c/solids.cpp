#include "nade/solids.h"

#include <cmath>

#include "arguments.h"
#include "convert.h"

namespace nade::c_abi {
namespace {

template <class Solid, class... Values>
nade_status make_solid(nade_surface** handle, Values&&... values) {
  auto held = std::make_shared<HeldSurface>();
  held->surface = std::make_unique<Solid>(std::forward<Values>(values)...);
  *handle = HandlePool<nade_surface>::take(std::move(held));
  return NADE_OK;
}

bool has_area(std::span<const Eigen::Vector2d> outline) {
  double area = 0.0;
  for (std::size_t i = 1; i + 1 < outline.size(); ++i) {
    const Eigen::Vector2d a = outline[i] - outline[0];
    const Eigen::Vector2d b = outline[i + 1] - outline[0];
    area += a.x() * b.y() - a.y() * b.x();
  }
  return std::isfinite(area) && area != 0.0;
}

}  // namespace
}  // namespace nade::c_abi

using nade::c_abi::Arguments;
using nade::c_abi::guarded;

extern "C" {

nade_status nade_surface_create_plane(nade_surface** surface) noexcept {
  return guarded(__func__, [&] {
    const Arguments arguments = Arguments().given(surface, "surface");
    if (!arguments.ok()) return arguments.status();
    return nade::c_abi::make_solid<nade::PlaneSurface>(surface);
  });
}

nade_status nade_surface_create_plate(const float* outline_xz, size_t count, float thickness_m,
                                      nade_surface** surface) noexcept {
  return guarded(__func__, [&] {
    const double thickness = thickness_m;
    Arguments arguments;
    arguments.given(surface, "surface")
        .given(outline_xz, "outline_xz")
        .at_least(count, 3, "count")
        .above_zero(thickness, "thickness_m");
    if (arguments.ok()) arguments.finite(outline_xz, 2 * count, "outline_xz");
    if (!arguments.ok()) return arguments.status();
    std::vector<Eigen::Vector2d> outline;
    outline.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      outline.emplace_back(outline_xz[2 * i], outline_xz[2 * i + 1]);
    }
    arguments.expects(nade::c_abi::has_area(outline), NADE_ERROR_ARGUMENT,
                      "outline_xz: expected an area above 0");
    if (!arguments.ok()) return arguments.status();
    return nade::c_abi::make_solid<nade::PlateSurface>(surface, outline, thickness);
  });
}

nade_status nade_surface_create_sphere(float radius_m, nade_surface** surface) noexcept {
  return guarded(__func__, [&] {
    const double radius = radius_m;
    const Arguments arguments =
        Arguments().given(surface, "surface").above_zero(radius, "radius_m");
    if (!arguments.ok()) return arguments.status();
    return nade::c_abi::make_solid<nade::SphereSurface>(surface, radius);
  });
}

nade_status nade_surface_create_ellipsoid(const float half_axes_m[3],
                                          nade_surface** surface) noexcept {
  return guarded(__func__, [&] {
    Arguments arguments;
    arguments.given(surface, "surface").given(half_axes_m, "half_axes_m");
    for (int i = 0; arguments.ok() && i < 3; ++i)
      arguments.above_zero(half_axes_m[i], "half_axes_m");
    if (!arguments.ok()) return arguments.status();
    return nade::c_abi::make_solid<nade::EllipsoidSurface>(surface,
                                                           nade::c_abi::vector_from(half_axes_m));
  });
}

nade_status nade_surface_create_box(const float half_size_m[3], float rounding_m,
                                    nade_surface** surface) noexcept {
  return guarded(__func__, [&] {
    Arguments arguments;
    arguments.given(surface, "surface").given(half_size_m, "half_size_m");
    for (int i = 0; arguments.ok() && i < 3; ++i)
      arguments.above_zero(half_size_m[i], "half_size_m");
    if (!arguments.ok()) return arguments.status();
    const nade::Vec3 half_size = nade::c_abi::vector_from(half_size_m);
    const double rounding = rounding_m;
    arguments.within(rounding, 0.0, half_size.minCoeff(), "rounding_m");
    if (!arguments.ok()) return arguments.status();
    return nade::c_abi::make_solid<nade::BoxSurface>(surface, half_size, rounding);
  });
}

nade_status nade_surface_create_cylinder(float half_height_m, float radius_m, float rounding_m,
                                         nade_surface** surface) noexcept {
  return guarded(__func__, [&] {
    const double half_height = half_height_m;
    const double radius = radius_m;
    const double rounding = rounding_m;
    const Arguments arguments =
        Arguments()
            .given(surface, "surface")
            .above_zero(half_height, "half_height_m")
            .above_zero(radius, "radius_m")
            .within(rounding, 0.0, std::min(half_height, radius), "rounding_m");
    if (!arguments.ok()) return arguments.status();
    return nade::c_abi::make_solid<nade::CylinderSurface>(surface, half_height, radius, rounding);
  });
}

nade_status nade_surface_create_capsule(float length_m, float radius_m,
                                        nade_surface** surface) noexcept {
  return guarded(__func__, [&] {
    const double length = length_m;
    const double radius = radius_m;
    const Arguments arguments =
        Arguments()
            .given(surface, "surface")
            .within(length, 0.0, std::numeric_limits<float>::max(), "length_m")
            .above_zero(radius, "radius_m");
    if (!arguments.ok()) return arguments.status();
    return nade::c_abi::make_solid<nade::CylinderSurface>(surface,
                                                          nade::capsule_surface(length, radius));
  });
}

}  // extern "C"
