#include <limits>

#include "arguments.h"
#include "convert.h"
#include "custom_surface.h"
#include "nade/surface.h"

namespace nade::c_abi {
namespace {

nade_status make_custom(const nade_surface_callbacks& callbacks, nade_surface** handle) {
  auto held = std::make_shared<HeldSurface>();
  auto surface = std::make_unique<CustomSurface>(callbacks);
  CustomSurface& made = *surface;
  held->surface = std::move(surface);
  *handle = HandlePool<nade_surface>::take(std::move(held));
  made.own();
  return NADE_OK;
}

nade_status make_group(const nade_group_member* members, std::size_t count, nade_surface** handle) {
  auto held = std::make_shared<HeldSurface>();
  std::vector<Object> objects;
  for (std::size_t i = 0; i < count; ++i) {
    const std::shared_ptr<HeldSurface>& member = *members[i].surface->contents;
    held->members.push_back(member);
    objects.emplace_back(*member->surface, placement_from(&members[i].placement), i);
  }
  auto group = std::make_unique<SurfaceGroup>(std::move(objects));
  held->group = group.get();
  held->surface = std::move(group);
  *handle = HandlePool<nade_surface>::take(std::move(held));
  return NADE_OK;
}

}  // namespace
}  // namespace nade::c_abi

using nade::c_abi::Arguments;
using nade::c_abi::guarded;

extern "C" {

nade_status nade_surface_create_custom(const nade_surface_callbacks* callbacks,
                                       nade_surface** surface) noexcept {
  return guarded(__func__, [&] {
    Arguments arguments;
    arguments.given(surface, "surface").read(callbacks, "callbacks");
    if (!arguments.ok()) return arguments.status();
    const nade_surface_callbacks whole = nade::c_abi::with_defaults(*callbacks, {});
    arguments.expects(whole.closest_point != nullptr, NADE_ERROR_ARGUMENT,
                      "callbacks: closest_point: expected a function, found NULL");
    if (!arguments.ok()) return arguments.status();
    return nade::c_abi::make_custom(whole, surface);
  });
}

nade_status nade_surface_create_group(const nade_group_member* members, size_t count,
                                      nade_surface** surface) noexcept {
  return guarded(__func__, [&] {
    Arguments arguments;
    arguments.given(surface, "surface")
        .given(members, "members")
        .within(static_cast<double>(count), 1.0, NADE_MAX_GROUP_MEMBERS, "count");
    for (std::size_t i = 0; arguments.ok() && i < count; ++i) {
      arguments.handle(members[i].surface, "members: surface").placement(&members[i].placement);
    }
    if (!arguments.ok()) return arguments.status();
    return nade::c_abi::make_group(members, count, surface);
  });
}

nade_status nade_surface_place_member(nade_surface* group, size_t index,
                                      const nade_placement* placement) noexcept {
  return guarded(__func__, [&] {
    Arguments arguments;
    arguments.handle(group, "group").placement(placement);
    if (!arguments.ok()) return arguments.status();
    nade::SurfaceGroup* const held = (*group->contents)->group;
    arguments
        .expects(held != nullptr, NADE_ERROR_HANDLE,
                 "group: expected one by nade_surface_create_group")
        .expects(held == nullptr || index < held->members().size(), NADE_ERROR_ARGUMENT,
                 "index: expected one below the number of members");
    if (!arguments.ok()) return arguments.status();
    held->place(index, nade::c_abi::placement_from(placement));
    return arguments.status();
  });
}

nade_status nade_surface_closest_point(const nade_surface* surface, const nade_placement* placement,
                                       const double query[3], double max_distance,
                                       nade_surface_point* point, int32_t* found) noexcept {
  return guarded(__func__, [&] {
    Arguments arguments;
    arguments.handle(surface, "surface")
        .placement(placement)
        .given(query, "query")
        .given(point, "point")
        .given(found, "found")
        .within(max_distance, 0.0, std::numeric_limits<double>::infinity(), "max_distance");
    if (arguments.ok()) arguments.finite(query, 3, "query");
    if (!arguments.ok()) return arguments.status();
    const nade::Object object(*(*surface->contents)->surface,
                              nade::c_abi::placement_from(placement));
    nade::SurfaceHint hint;
    const auto nearest = object.closest_point(nade::c_abi::vector_from(query), max_distance, hint);
    *found = nearest ? 1 : 0;
    if (!nearest) return arguments.status();
    nade::c_abi::put_vector(nearest->point, point->point);
    nade::c_abi::put_vector(nearest->normal, point->normal);
    point->signed_distance = nearest->signed_distance;
    return arguments.status();
  });
}

nade_status nade_surface_destroy(nade_surface* surface) noexcept {
  return nade::c_abi::destroy(__func__, surface);
}

}  // extern "C"
