#include <algorithm>
#include <array>

#include "generic_flesh_table.h"
#include "nade/flesh.h"
#include "phalanx.h"

namespace nade {
namespace {

HandPose bind_pose() {
  HandPose bind;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    const std::array<double, 7>& row = detail::kBind[i];
    bind.joints[i].position = Vec3(row[0], row[1], row[2]);
    bind.joints[i].rotation = Quat(row[6], row[3], row[4], row[5]).normalized();
  }
  return bind;
}

/// The left hand is the right one seen in the mirror x = 0.
FleshPoint attached(const detail::FleshRow& row, const HandPose& bind) {
  Vec3 position = 1e-5 * Vec3(row[0], row[1], row[2]);
  if (bind.side == Handedness::left) position.x() = -position.x();
  double sum = 0.0;
  for (std::size_t k = 0; k < 4; ++k) sum += row[4 + 2 * k];
  FleshPoint point;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto joint = static_cast<std::size_t>(row[3 + 2 * k]);
    point.attach(k, joint, row[4 + 2 * k] / sum, bind.joints[joint].inverse().apply(position));
  }
  return point;
}

HandFlesh make_generic_flesh(Handedness side) {
  HandPose bind = bind_pose();
  if (side == Handedness::left) bind = mirrored(bind);
  HandFlesh flesh;
  flesh.side = side;
  flesh.hand_length_m = hand_length(bind);
  for (const detail::FleshRow& row : detail::kSkin) flesh.skin.push_back(attached(row, bind));
  for (const std::int16_t depth : detail::kSkinDepths) flesh.depth_m.push_back(1e-5 * depth);
  std::uint32_t first = 0;
  for (const detail::PadRow& row : detail::kPads) {
    FleshPad& pad = flesh.pads.emplace_back();
    pad.middle = attached(row.middle, bind);
    pad.first = first;
    pad.count = static_cast<std::uint32_t>(row.count);
    if (row.part >= 0) pad.part = part_at(static_cast<std::size_t>(row.part));
    if (row.area_mm2 > 0) {
      pad.palmar = PalmarPatch{attached(row.palmar, bind), 1e-6 * row.area_mm2,
                               static_cast<SkinRegion>(row.region)};
    }
    const Vec3 middle = position_of(pad.middle, bind, 1.0);
    for (std::uint32_t k = first; k < first + pad.count; ++k) {
      pad.radius_m =
          std::max(pad.radius_m, (position_of(flesh.skin[k], bind, 1.0) - middle).norm());
    }
    first += pad.count;
  }
  std::vector<Vec3> places;
  for (const FleshPoint& point : flesh.skin) places.push_back(position_of(point, bind, 1.0));
  flesh.phalanx_radius_m = phalanx_radii(bind, places);
  return flesh;
}

}  // namespace

const HandFlesh& generic_flesh(Handedness side) {
  static const std::array<HandFlesh, 2> kFlesh{make_generic_flesh(Handedness::left),
                                               make_generic_flesh(Handedness::right)};
  return kFlesh[index_of(side)];
}

HandPose generic_rest_pose(Handedness side) {
  const HandPose bind = bind_pose();
  const HandPose right = moved(bind, bind[Joint::palm].inverse());
  return side == Handedness::right ? right : mirrored(right);
}

}  // namespace nade
