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

nade_status nade_surface_create_plate(const float* outline_xz, size_t count, double thickness_m,
                                      nade_surface** surface) noexcept {
  return guarded(__func__, [&] {
    Arguments arguments;
    arguments.given(surface, "surface")
        .given(outline_xz, "outline_xz")
        .at_least(count, 3, "count")
        .above_zero(thickness_m, "thickness_m");
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
    return nade::c_abi::make_solid<nade::PlateSurface>(surface, outline, thickness_m);
  });
}

nade_status nade_surface_create_sphere(double radius_m, nade_surface** surface) noexcept {
  return guarded(__func__, [&] {
    const Arguments arguments =
        Arguments().given(surface, "surface").above_zero(radius_m, "radius_m");
    if (!arguments.ok()) return arguments.status();
    return nade::c_abi::make_solid<nade::SphereSurface>(surface, radius_m);
  });
}

nade_status nade_surface_create_ellipsoid(const double half_axes_m[3],
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

nade_status nade_surface_create_box(const double half_size_m[3], double rounding_m,
                                    nade_surface** surface) noexcept {
  return guarded(__func__, [&] {
    Arguments arguments;
    arguments.given(surface, "surface").given(half_size_m, "half_size_m");
    for (int i = 0; arguments.ok() && i < 3; ++i)
      arguments.above_zero(half_size_m[i], "half_size_m");
    if (!arguments.ok()) return arguments.status();
    const nade::Vec3 half_size = nade::c_abi::vector_from(half_size_m);
    arguments.within(rounding_m, 0.0, half_size.minCoeff(), "rounding_m");
    if (!arguments.ok()) return arguments.status();
    return nade::c_abi::make_solid<nade::BoxSurface>(surface, half_size, rounding_m);
  });
}

nade_status nade_surface_create_cylinder(double half_height_m, double radius_m, double rounding_m,
                                         nade_surface** surface) noexcept {
  return guarded(__func__, [&] {
    const Arguments arguments =
        Arguments()
            .given(surface, "surface")
            .above_zero(half_height_m, "half_height_m")
            .above_zero(radius_m, "radius_m")
            .within(rounding_m, 0.0, std::min(half_height_m, radius_m), "rounding_m");
    if (!arguments.ok()) return arguments.status();
    return nade::c_abi::make_solid<nade::CylinderSurface>(surface, half_height_m, radius_m,
                                                          rounding_m);
  });
}

nade_status nade_surface_create_capsule(double length_m, double radius_m,
                                        nade_surface** surface) noexcept {
  return guarded(__func__, [&] {
    const Arguments arguments =
        Arguments()
            .given(surface, "surface")
            .within(length_m, 0.0, std::numeric_limits<double>::max(), "length_m")
            .above_zero(radius_m, "radius_m");
    if (!arguments.ok()) return arguments.status();
    return nade::c_abi::make_solid<nade::CylinderSurface>(
        surface, nade::capsule_surface(length_m, radius_m));
  });
}

}  // extern "C"
