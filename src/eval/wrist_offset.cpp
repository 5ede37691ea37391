#include "nade/eval/wrist_offset.h"

#include <algorithm>

#include "nade/assert.h"

namespace nade {
namespace {

constexpr double kFarthest_m = 0.3;
constexpr double kBehind_m = 0.01;  // a point so much farther behind a wall than last frame
constexpr double kPast_m = 1e-6;    // beyond a hit, to look for the next
constexpr double kOut_m = 1e-5;     // as good as on the surface
constexpr double kSameSide = 0.5;   // cosine of how far the normal may turn in a frame
constexpr int kHitsMax = 8;         // walls between a point and the open
constexpr int kTurns = 2;           // of the normal, in a frame
constexpr int kMendings = 4;        // where another part of the object is in the way

}  // namespace

WristOffset::WristOffset(std::shared_ptr<const HandFlesh> flesh, double scale)
    : flesh_(std::move(flesh)), scale_(scale) {
  NADE_ASSERT(flesh_ != nullptr && scale > 0.0);
  for (const FleshPad& pad : flesh_->pads) {
    if (!pad.part) continue;
    for (std::size_t i = 0; i < pad.count; ++i) tested_.push_back(pad.first + i);
  }
  skin_.resize(tested_.size());
  hints_.resize(tested_.size());
}

/// The way out from where the skin is deepest; no value where none of it lies inside.
std::optional<WristOffset::Way> WristOffset::deepest(const Object& object) noexcept {
  std::optional<Way> found;
  for (std::size_t i = 0; i < skin_.size(); ++i) {
    const auto nearest = object.closest_point(skin_[i], kFarthest_m, hints_[i]);
    if (!nearest || nearest->signed_distance > -kOut_m) continue;
    if (!found || -nearest->signed_distance > found->length_m) {
      found = Way{-nearest->signed_distance, nearest->normal};
    }
  }
  return found;
}

/// How far along `normal` all skin is out, and the surface's normal where the last of it comes
/// out. A wall farther than `reach_m` before a point that lies outside is not in its way.
WristOffset::Way WristOffset::way_out(const Object& object, const Vec3& normal,
                                      double reach_m) const noexcept {
  Way longest{0.0, normal};
  for (const Vec3& point : skin_) {
    double gone_m = 0.0;
    for (int i = 0; i < kHitsMax; ++i) {
      const double left_m = (gone_m > 0.0 ? reach_m : kFarthest_m) - gone_m;
      if (left_m <= 0.0) break;
      const auto hit = object.first_hit({point + gone_m * normal, normal, left_m});
      if (!hit) break;
      if (!hit->from_inside && gone_m + hit->distance > reach_m) break;
      gone_m += hit->distance + kPast_m;
      if (hit->from_inside && gone_m > longest.length_m) longest = {gone_m, hit->normal};
    }
  }
  return longest;
}

HandPose WristOffset::update(const HandPose& tracked, const Object& object) noexcept {
  for (std::size_t i = 0; i < tested_.size(); ++i) {
    skin_[i] = position_of(flesh_->skin[tested_[i]], tracked, scale_);
  }
  if (!normal_) {
    const auto first = deepest(object);
    if (!first) return tracked;
    normal_ = first->normal;
    offset_m_ = 0.0;
  }
  Way way = way_out(object, *normal_, offset_m_ + kBehind_m);
  for (int i = 0; i < kTurns && way.normal.dot(*normal_) > kSameSide; ++i) {
    normal_ = way.normal;
    way = way_out(object, *normal_, offset_m_ + kBehind_m);
  }
  offset_m_ = way.length_m;
  if (offset_m_ <= 0.0) {
    normal_.reset();
    return tracked;
  }
  Vec3 shift = offset_m_ * *normal_;
  for (Vec3& point : skin_) point += shift;
  for (int i = 0; i < kMendings; ++i) {
    const auto inside = deepest(object);
    // Out on a wall's far side would be through it.
    if (!inside || inside->normal.dot(*normal_) < 0.0) break;
    const Vec3 more = inside->length_m * inside->normal;
    for (Vec3& point : skin_) point += more;
    shift += more;
  }
  return moved(tracked, {shift, Quat::Identity()});
}

}  // namespace nade
