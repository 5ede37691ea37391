#include "nade/corrector.h"

#include "arguments.h"
#include "convert.h"

namespace nade::c_abi {
namespace {

nade_corrector_options default_options() {
  const CorrectorOptions defaults;
  nade_corrector_options options{};
  options.size = sizeof options;
  options.method = static_cast<nade_method>(defaults.method);
  options.release_s = defaults.release_s;
  options.hand_length_m = defaults.hand_length_m;
  return options;
}

void put_flesh(const nade_flesh* handle, Handedness side, CorrectorOptions& options) {
  if (handle == nullptr) return;
  const HeldFlesh& held = *handle->contents;
  options.flesh[index_of(side)] = held.flesh;
  options.skin = held.skin;
  options.skin_hand_length_m = held.flesh->hand_length_m;
}

/// NADE_OK, with the options in `options`, or what is wrong with those that were given.
nade_status read_options(const nade_corrector_options* given, CorrectorOptions& options) {
  if (given == nullptr) return NADE_OK;
  Arguments arguments;
  arguments.read(given, "options");
  if (!arguments.ok()) return arguments.status();
  const nade_corrector_options whole = with_defaults(*given, default_options());
  arguments.within(whole.method, NADE_METHOD_NONE, NADE_METHOD_NADE, "options: method");
  for (const nade_flesh* const flesh : {whole.left_flesh, whole.right_flesh}) {
    if (flesh != nullptr) arguments.handle(flesh, "options: flesh");
  }
  if (!arguments.ok()) return arguments.status();
  const nade_status feel_status = check_feel(whole.feel);
  if (feel_status != NADE_OK) return feel_status;
  options.method = static_cast<Method>(whole.method);
  options.release_s = whole.release_s;
  options.hand_length_m = whole.hand_length_m;
  options.settle = feel_from(whole.feel);
  put_flesh(whole.left_flesh, Handedness::left, options);
  put_flesh(whole.right_flesh, Handedness::right, options);
  const Status checked = check_options(options);
  if (checked.ok()) return NADE_OK;
  return fail(NADE_ERROR_ARGUMENT, "options: %s", checked.error().message.c_str());
}

nade_status make_corrector(const nade_corrector_options* given, nade_corrector** handle) {
  CorrectorOptions options;
  const nade_status status = read_options(given, options);
  if (status != NADE_OK) return status;
  *handle = HandlePool<nade_corrector>::take(HeldCorrector{nullptr, HandCorrector(options)});
  return NADE_OK;
}

}  // namespace
}  // namespace nade::c_abi

using nade::c_abi::Arguments;
using nade::c_abi::check_feel;
using nade::c_abi::guarded;

extern "C" {

nade_status nade_feel_init(nade_feel* feel) noexcept {
  return guarded(__func__, [&] {
    const Arguments arguments = Arguments().sized(feel, "feel");
    if (arguments.ok()) nade::c_abi::write(nade::c_abi::default_feel(), *feel);
    return arguments.status();
  });
}

nade_status nade_corrector_options_init(nade_corrector_options* options) noexcept {
  return guarded(__func__, [&] {
    const Arguments arguments = Arguments().sized(options, "options");
    if (arguments.ok()) nade::c_abi::write(nade::c_abi::default_options(), *options);
    return arguments.status();
  });
}

nade_status nade_corrector_options_check(const nade_corrector_options* options) noexcept {
  return guarded(__func__, [&] {
    nade::CorrectorOptions read;
    return nade::c_abi::read_options(options, read);
  });
}

nade_status nade_corrector_create(const nade_corrector_options* options,
                                  nade_corrector** corrector) noexcept {
  return guarded(__func__, [&] {
    const Arguments arguments = Arguments().given(corrector, "corrector");
    if (!arguments.ok()) return arguments.status();
    return nade::c_abi::make_corrector(options, corrector);
  });
}

nade_status nade_corrector_update(nade_corrector* corrector, nade_side side,
                                  const nade_joint* joints, const nade_surface* surface,
                                  const nade_placement* placement, uint64_t object, int64_t time_ns,
                                  nade_result* result) noexcept {
  return guarded(__func__, [&] {
    Arguments arguments;
    arguments.handle(corrector, "corrector")
        .side(side)
        .given(joints, "joints")
        .placement(placement)
        .sized(result, "result");
    if (surface != nullptr) arguments.handle(surface, "surface");
    if (!arguments.ok()) return arguments.status();
    nade::c_abi::HeldCorrector& held = *corrector->contents;
    if (surface == nullptr) {
      held.surface.reset();
    } else if (held.surface != *surface->contents) {
      held.surface = *surface->contents;
    }
    const nade::HandPose tracked = nade::c_abi::hand_from(side, joints);
    const nade::Object touched =
        surface == nullptr
            ? nade::nothing()
            : nade::Object(*held.surface->surface, nade::c_abi::placement_from(placement), object);
    const nade::CorrectedHand& hand = held.corrector.update(tracked, touched, time_ns);
    nade::c_abi::write(nade::c_abi::result_from(hand, tracked, joints), *result);
    return arguments.status();
  });
}

nade_status nade_corrector_update_scene(nade_corrector* corrector, nade_side side,
                                        const nade_joint* joints, const nade_scene* scene,
                                        int64_t time_ns, nade_result* result) noexcept {
  return guarded(__func__, [&] {
    Arguments arguments;
    arguments.handle(corrector, "corrector")
        .side(side)
        .given(joints, "joints")
        .handle(scene, "scene")
        .sized(result, "result");
    if (!arguments.ok()) return arguments.status();
    nade::c_abi::HeldCorrector& held = *corrector->contents;
    const nade::HandPose tracked = nade::c_abi::hand_from(side, joints);
    const nade::CorrectedHand& hand =
        held.corrector.update(tracked, scene->contents->scene, time_ns);
    nade::c_abi::write(nade::c_abi::result_from(hand, tracked, joints), *result);
    return arguments.status();
  });
}

nade_status nade_corrector_preview(const nade_corrector* corrector, nade_side side,
                                   const nade_joint* joints, nade_joint* drawn) noexcept {
  return guarded(__func__, [&] {
    Arguments arguments;
    arguments.handle(corrector, "corrector")
        .side(side)
        .given(joints, "joints")
        .given(drawn, "drawn");
    if (!arguments.ok()) return arguments.status();
    const nade::HandPose tracked = nade::c_abi::hand_from(side, joints);
    const nade::HandPose hand = corrector->contents->corrector.preview(tracked);
    nade::c_abi::put_hand(hand, tracked, joints, drawn);
    return arguments.status();
  });
}

nade_status nade_corrector_set_feel(nade_corrector* corrector, const nade_feel* feel) noexcept {
  return guarded(__func__, [&] {
    const Arguments arguments = Arguments().handle(corrector, "corrector");
    if (!arguments.ok()) return arguments.status();
    const nade_status feel_status = check_feel(feel);
    if (feel_status != NADE_OK) return feel_status;
    corrector->contents->corrector.set_settle(nade::c_abi::feel_from(feel));
    return arguments.status();
  });
}

nade_status nade_corrector_reset(nade_corrector* corrector) noexcept {
  return guarded(__func__, [&] {
    const Arguments arguments = Arguments().handle(corrector, "corrector");
    if (arguments.ok()) corrector->contents->corrector.reset();
    return arguments.status();
  });
}

nade_status nade_corrector_destroy(nade_corrector* corrector) noexcept {
  return nade::c_abi::destroy(__func__, corrector);
}

}  // extern "C"
