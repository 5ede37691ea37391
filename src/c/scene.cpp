#include "nade/scene.h"

#include "arguments.h"
#include "convert.h"

namespace nade::c_abi {
namespace {

nade_status no_such_id(ObjectId id) {
  return fail(NADE_ERROR_ID, "id: expected one of the scene, found %llu",
              static_cast<unsigned long long>(id));
}

nade_status add_object(HeldScene& held, ObjectId id, const std::shared_ptr<HeldSurface>& surface,
                       const Placement& placement, const SettleOptions& feel) {
  if (held.scene.find(id) != nullptr) {
    return fail(NADE_ERROR_ID, "id: expected one that is not taken, found %llu",
                static_cast<unsigned long long>(id));
  }
  held.surfaces.insert_or_assign(id, surface);
  held.scene.add(id, *surface->surface, placement, feel);
  return NADE_OK;
}

}  // namespace
}  // namespace nade::c_abi

using nade::c_abi::Arguments;
using nade::c_abi::check_feel;
using nade::c_abi::guarded;
using nade::c_abi::no_such_id;

extern "C" {

nade_status nade_scene_create(nade_scene** scene) noexcept {
  return guarded(__func__, [&] {
    const Arguments arguments = Arguments().given(scene, "scene");
    if (!arguments.ok()) return arguments.status();
    *scene = nade::c_abi::HandlePool<nade_scene>::take(nade::c_abi::HeldScene{});
    return arguments.status();
  });
}

nade_status nade_scene_add(nade_scene* scene, uint64_t id, const nade_surface* surface,
                           const nade_placement* placement, const nade_feel* feel) noexcept {
  return guarded(__func__, [&] {
    const Arguments arguments =
        Arguments().handle(scene, "scene").handle(surface, "surface").placement(placement);
    if (!arguments.ok()) return arguments.status();
    const nade_status feel_status = check_feel(feel);
    if (feel_status != NADE_OK) return feel_status;
    return nade::c_abi::add_object(*scene->contents, id, *surface->contents,
                                   nade::c_abi::placement_from(placement),
                                   nade::c_abi::feel_from(feel));
  });
}

nade_status nade_scene_place(nade_scene* scene, uint64_t id,
                             const nade_placement* placement) noexcept {
  return guarded(__func__, [&] {
    const Arguments arguments = Arguments().handle(scene, "scene").placement(placement);
    if (!arguments.ok()) return arguments.status();
    nade::Scene& held = scene->contents->scene;
    return held.place(id, nade::c_abi::placement_from(placement)) ? NADE_OK : no_such_id(id);
  });
}

nade_status nade_scene_deformed(nade_scene* scene, uint64_t id) noexcept {
  return guarded(__func__, [&] {
    const Arguments arguments = Arguments().handle(scene, "scene");
    if (!arguments.ok()) return arguments.status();
    return scene->contents->scene.deformed(id) ? NADE_OK : no_such_id(id);
  });
}

nade_status nade_scene_set_feel(nade_scene* scene, uint64_t id, const nade_feel* feel) noexcept {
  return guarded(__func__, [&] {
    const Arguments arguments = Arguments().handle(scene, "scene");
    if (!arguments.ok()) return arguments.status();
    const nade_status feel_status = check_feel(feel);
    if (feel_status != NADE_OK) return feel_status;
    return scene->contents->scene.set_feel(id, nade::c_abi::feel_from(feel)) ? NADE_OK
                                                                             : no_such_id(id);
  });
}

nade_status nade_scene_remove(nade_scene* scene, uint64_t id) noexcept {
  return guarded(__func__, [&] {
    const Arguments arguments = Arguments().handle(scene, "scene");
    if (!arguments.ok()) return arguments.status();
    if (!scene->contents->scene.remove(id)) return no_such_id(id);
    scene->contents->surfaces.erase(id);
    return arguments.status();
  });
}

nade_status nade_scene_size(const nade_scene* scene, size_t* size) noexcept {
  return guarded(__func__, [&] {
    const Arguments arguments = Arguments().handle(scene, "scene").given(size, "size");
    if (arguments.ok()) *size = scene->contents->scene.size();
    return arguments.status();
  });
}

nade_status nade_scene_destroy(nade_scene* scene) noexcept {
  return nade::c_abi::destroy(__func__, scene);
}

}  // extern "C"
