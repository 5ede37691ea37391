#include "look_meter.h"

#include <algorithm>
#include <cmath>

#include "skin_probe.h"

namespace nade {
namespace {

/// Skin farther from the surface than this is as good as anywhere.
constexpr double kFar_m = 0.3;
/// Skin nearer than this leaves a print.
constexpr double kPrint_m = 0.0015;
/// A print is looked for where so much palmar skin is pressed, or this share of the heel's.
constexpr double kLeastPressed_m2 = 0.001;
constexpr double kHeelShare = 0.5;
/// A hand is free that has been out of the object for so long.
constexpr std::int64_t kFree_ns = 500'000'000;

void raise(std::optional<double>& most, double value) {
  most = std::max(most.value_or(0.0), value);
}

}  // namespace

LookMeter::LookMeter(const HandMesh& mesh, double scale)
    : mesh_(&mesh),
      scale_(scale),
      skin_(measure_skin(mesh)),
      tracked_(mesh.vertices.size()),
      corrected_(mesh.vertices.size()) {
  for (std::size_t i = 0; i < skin_.region.size(); ++i) {
    if (skin_.region[i] == SkinRegion::heel) heel_m2_ += skin_.area_m2[i];
  }
}

void LookMeter::add(const LookFrame& frame, const Object& object) {
  take_place(frame, object);
  read(frame.corrected, object, Looked::all, corrected_);
  take_excess(frame.pressing);
  if (frame.pressing == Pressing::no) return;
  read(frame.tracked, object, Looked::palmar, tracked_);
  take_print();
}

void LookMeter::read(const HandPose& hand, const Object& object, Looked looked,
                     Field& field) const {
  pose_skin(*mesh_, hand, scale_, field.skin, {});
  for (std::size_t i = 0; i < field.skin.size(); ++i) {
    field.distance_m[i] = kFar_m;
    if (looked == Looked::palmar && skin_.region[i] == SkinRegion::back) continue;
    const auto nearest = object.closest_point(field.skin[i].cast<double>(), kFar_m, field.hints[i]);
    if (nearest) field.distance_m[i] = nearest->signed_distance;
  }
}

void LookMeter::take_print() {
  double pressed_m2 = 0.0;
  double print_m2 = 0.0;
  double height_m3 = 0.0;
  double pressed_heel_m2 = 0.0;
  double heel_print_m2 = 0.0;
  for (std::size_t i = 0; i < skin_.region.size(); ++i) {
    if (skin_.region[i] == SkinRegion::back || tracked_.distance_m[i] >= -kPressing_m) continue;
    const double area_m2 = skin_.area_m2[i];
    const bool touches = corrected_.distance_m[i] < kPrint_m;
    const bool heel = skin_.region[i] == SkinRegion::heel;
    pressed_m2 += area_m2;
    height_m3 += area_m2 * std::max(0.0, corrected_.distance_m[i]);
    if (touches) print_m2 += area_m2;
    if (heel) pressed_heel_m2 += area_m2;
    if (heel && touches) heel_print_m2 += area_m2;
  }
  if (pressed_m2 >= kLeastPressed_m2) {
    print_.add(print_m2 / pressed_m2);
    hover_m_.add(height_m3 / pressed_m2);
  }
  if (heel_m2_ > 0.0 && pressed_heel_m2 >= kHeelShare * heel_m2_) {
    heel_.add(heel_print_m2 / pressed_heel_m2);
  }
}

void LookMeter::take_excess(Pressing pressing) {
  double excess_m = 0.0;
  for (std::size_t i = 0; i < skin_.flesh_m.size(); ++i) {
    excess_m = std::max(excess_m, -corrected_.distance_m[i] - scale_ * skin_.flesh_m[i]);
  }
  raise(excess_max_m_, excess_m);
  if (pressing == Pressing::yes) excess_m_.add(excess_m);
}

void LookMeter::take_place(const LookFrame& frame, const Object& object) {
  const Pose& tracked = frame.tracked[Joint::palm];
  const Pose& drawn = frame.corrected[Joint::palm];
  if (frame.tracked_lowest_m <= kTouch_m) {
    free_since_ns_.reset();
  } else {
    if (!free_since_ns_) free_since_ns_ = frame.time_ns;
    if (frame.time_ns - *free_since_ns_ >= kFree_ns) {
      raise(free_max_m_, (drawn.position - tracked.position).norm());
    }
  }
  if (frame.pressing == Pressing::no) return;
  turn_deg_.add(drawn.rotation.angularDistance(tracked.rotation) / kDegree);
  const auto under = object.closest_point(drawn.position, kFar_m, palm_hint_);
  const Vec3 normal = under ? under->normal : Vec3::Zero();
  along_mm_.add(1e3 * along_surface(drawn.position - tracked.position, normal).norm());
}

void LookMeter::merge(const LookMeter& other) {
  print_.merge(other.print_);
  hover_m_.merge(other.hover_m_);
  heel_.merge(other.heel_);
  excess_m_.merge(other.excess_m_);
  if (other.excess_max_m_) raise(excess_max_m_, *other.excess_max_m_);
  if (other.free_max_m_) raise(free_max_m_, *other.free_max_m_);
  along_mm_.merge(other.along_mm_);
  turn_deg_.merge(other.turn_deg_);
  break_off();
}

Look LookMeter::finish() const {
  const auto millimetres = [](std::optional<double> length_m) {
    return length_m ? std::optional(1e3 * *length_m) : std::nullopt;
  };
  Look look;
  look.print_share = print_.value();
  look.hover_mm = millimetres(hover_m_.value());
  look.heel_share = heel_.value();
  look.excess_max_mm = millimetres(excess_max_m_);
  look.excess_mean_mm = millimetres(excess_m_.value());
  look.along_p95_mm = along_mm_.quantile(0.95);
  look.free_max_mm = millimetres(free_max_m_);
  look.turn_median_deg = turn_deg_.quantile(0.5);
  look.turn_p95_deg = turn_deg_.quantile(0.95);
  return look;
}

}  // namespace nade
