#include "state.h"

#include "contact_finder.h"

namespace nade {

ProxyState::ProxyState(const HandFlesh& flesh) {
  pads.resize(flesh.pads.size());
  terms.reserve(kMostTerms);
  room.reserve(kMostTerms);
  forget_frame(*this);  // Eigen's vectors begin with whatever was there
}

void forget_planes(ProxyState& state) noexcept {
  for (PadMemory& pad : state.pads) {
    pad.plane.reset();
    pad.beside = {};
    pad.clearance_m = pad.free_m = 0.0;
    pad.out_until_m = PadMemory{}.out_until_m;
  }
}

void forget_surface(ProxyState& state) noexcept {
  state.last_inside = 0;
  state.joints.fill(Vec3::Zero());
  state.travel_m = state.way_m = state.clear_s = state.stuck_s = 0.0;
  state.undeformed_s = std::numeric_limits<double>::infinity();
  state.watches.fill({});
  state.pads.assign(state.pads.size(), {});
}

void forget_frame(ProxyState& state) noexcept {
  state.last.reset();
  state.touch = {};
  state.returning = {};
  state.tracked_velocity.fill(Vec3::Zero());
  state.offset_velocity.fill(Vec3::Zero());
  forget_surface(state);
}

}  // namespace nade
