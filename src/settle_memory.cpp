#include "nade/settle.h"
#include "settle_unrest.h"
#include "touch_finder.h"

namespace nade {

SettleMemory settle_memory(const HandFlesh& flesh) {
  SettleMemory memory;
  memory.pads.resize(flesh.pads.size());
  memory.rows.reserve(kMostContactRows);
  memory.joints.fill(Vec3::Zero());  // Eigen's vectors begin with whatever was there
  memory.velocity.fill(Vec3::Zero());
  memory.drift.fill(Vec3::Zero());
  memory.unrest = no_unrest();
  return memory;
}

void forget_hand(SettleMemory& memory) noexcept {
  memory.last.tracked.reset();
  memory.unrest = no_unrest();
}

}  // namespace nade
