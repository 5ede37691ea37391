#include <limits>

#include "nade/assert.h"
#include "nade/settle.h"
#include "settle_slide.h"
#include "settle_unrest.h"
#include "touch_finder.h"

namespace nade {

SettleMemory settle_memory(const HandFlesh& flesh) {
  NADE_ASSERT(flesh.skin.size() <= kMostSkinPoints);
  SettleMemory memory;
  memory.pads.resize(flesh.pads.size());
  memory.rows.reserve(kMostContactRows);
  forget_frame(memory);  // Eigen's vectors begin with whatever was there
  memory.unrest = no_unrest();
  return memory;
}

void forget_planes(SettleMemory& memory) noexcept {
  for (PadMemory& pad : memory.pads) {
    pad.plane.reset();
    pad.beside = {};
    pad.clearance_m = pad.free_m = 0.0;
    pad.out_until_m = PadMemory{}.out_until_m;
  }
}

void forget_surface(SettleMemory& memory) noexcept {
  memory.last_inside = 0;
  memory.geometric.setZero();
  memory.joints.fill(Vec3::Zero());
  memory.travel_m = memory.way_m = memory.clear_s = memory.stuck_s = 0.0;
  memory.under_palm = memory.under_hand = memory.under_nearest = {};
  memory.undeformed_s = std::numeric_limits<double>::infinity();
  memory.watches.fill({});
  memory.pads.assign(memory.pads.size(), {});
  break_motion(memory.unrest);
}

void forget_frame(SettleMemory& memory) noexcept {
  memory.last = {};
  memory.contact = {};
  for (JointVectors* vectors : {&memory.velocity, &memory.pace, &memory.drift}) {
    vectors->fill(Vec3::Zero());
  }
  memory.rest = memory.strike_mps = memory.return_share = 0.0;
  forget_surface(memory);
}

void forget_hand(SettleMemory& memory) noexcept {
  memory.last.tracked.reset();
  memory.unrest = no_unrest();
}

}  // namespace nade
