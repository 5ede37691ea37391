#include "touch_report.h"

#include <span>

namespace nade {

bool is_pressed(const PartTouch& part, const ProxyTuning& tuning) noexcept {
  return part.depth_m > 0.0 && part.gap_m < tuning.adhesion_reach_m;
}

void report_parts(const ContactSearch& search, const PosedHand& settled, const FoundContacts& found,
                  ProxyResult& result) noexcept {
  for (std::size_t i = 0; i < kPartCount; ++i) {
    const PartTouch& part = found.parts[i];
    if (!is_pressed(part, search.tuning)) continue;
    PartContact contact;
    contact.ray_origin = search.tracked.position(*part.point);
    contact.ray_direction = contact.skin_direction = contact.normal = part.plane.normal;
    const Vec3 skin = settled.flesh.position(*part.point);
    contact.surface_point =
        skin - part.plane.normal.dot(skin - part.plane.point) * part.plane.normal;
    contact.target = result.hand[joint_of(part_at(i))].position;
    contact.skin_depth_m = part.plane.normal.dot(contact.target - contact.surface_point);
    contact.depth_m = part.depth_m;
    result.contacts[i] = contact;
  }
}

void report_bones(const PosedHand& settled, const FoundContacts& found,
                  ProxyResult& result) noexcept {
  for (std::size_t i = 0; i < kBones.size(); ++i) {
    const BoneTouch& touch = found.bones[i];
    if (touch.point == nullptr) continue;
    const Vec3 skin = settled.flesh.position(*touch.point);
    const double gap_m = touch.plane.normal.dot(skin - touch.plane.point);
    if (gap_m > kTouches_m) continue;
    result.bones[result.bone_count++] = {kBones[i], skin - gap_m * touch.plane.normal,
                                         touch.plane.normal, touch.depth_m, touch.hint};
  }
}

ProxyResult in_world(const Pose& object, const HandPose& tracked, ProxyResult result) noexcept {
  result.hand = result.corrected ? moved(result.hand, object) : tracked;
  for (std::optional<PartContact>& contact : result.contacts) {
    if (!contact) continue;
    for (Vec3* point : {&contact->ray_origin, &contact->surface_point, &contact->target}) {
      *point = object.apply(*point);
    }
    for (Vec3* way : {&contact->ray_direction, &contact->normal, &contact->skin_direction}) {
      *way = object.rotation * *way;
    }
  }
  for (BoneContact& contact : std::span(result.bones).first(result.bone_count)) {
    contact.point = object.apply(contact.point);
    contact.normal = object.rotation * contact.normal;
  }
  return result;
}

}  // namespace nade
