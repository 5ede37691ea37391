#include "pose_meter.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hand/phalanx.h"

namespace nade {
namespace {

/// Skin this far outside for so long is free.
constexpr double kOutside_m = 0.002;
constexpr std::int64_t kFree_ns = 500'000'000;
constexpr double kThumbOpen_deg = 55.0;

void raise(std::optional<double>& most, double value) {
  most = std::max(most.value_or(value), value);
}

void raise(std::optional<double>& most, const std::optional<double>& value) {
  if (value) raise(most, *value);
}

/// Between the metacarpals of thumb and index, in the palm's plane; none where one stands upright
/// on it.
std::optional<double> thumb_open_deg(const HandPose& hand) {
  const Vec3 thumb = along_surface(
      hand[Joint::thumb_proximal].position - hand[Joint::thumb_metacarpal].position, hand.back());
  const Vec3 index = along_surface(
      hand[Joint::index_proximal].position - hand[Joint::index_metacarpal].position, hand.back());
  if (thumb.norm() < 1e-6 || index.norm() < 1e-6) return std::nullopt;
  return std::atan2(thumb.cross(index).norm(), thumb.dot(index)) / kDegree;
}

}  // namespace

PoseMeter::PoseMeter(const HandMesh& mesh, double hand_scale) {
  std::vector<Vec3> skin;
  for (const Eigen::Vector3f& vertex : mesh.vertices) skin.push_back(vertex.cast<double>());
  radius_m_ = phalanx_radii(mesh.bind, skin);
  for (double& radius_m : radius_m_) radius_m *= hand_scale;
}

double PoseMeter::overlap_m(const HandPose& hand) const {
  double deepest_m = 0.0;
  for (const auto& [one, other] : kPhalanxPairs) {
    const double apart_m = nearest_of(hand, one, other).way.norm();
    deepest_m = std::max(deepest_m, radius_m_[one] + radius_m_[other] - apart_m);
  }
  return deepest_m;
}

void PoseMeter::add(const PoseFrame& frame, const Object& object) {
  if (frame.pressing) take_pressed(frame, object);
  take_free(frame);
  take_thumb(frame);
  overlap_mm_.add(1e3 * std::max(0.0, overlap_m(*frame.corrected) - overlap_m(*frame.tracked)));
}

void PoseMeter::take_pressed(const PoseFrame& frame, const Object& object) {
  const Pose& tracked = (*frame.tracked)[Joint::palm];
  const Pose& drawn = (*frame.corrected)[Joint::palm];
  turn_deg_.add(tracked.rotation.angularDistance(drawn.rotation) / kDegree);
  const auto surface =
      object.closest_point(drawn.position, std::numeric_limits<double>::infinity(), hint_);
  if (!surface) return;
  along_mm_.add(1e3 * along_surface(drawn.position - tracked.position, surface->normal).norm());
}

void PoseMeter::take_free(const PoseFrame& frame) {
  if (frame.lowest_tracked_m <= kOutside_m) {
    free_since_ns_.reset();
    return;
  }
  if (!free_since_ns_) free_since_ns_ = frame.time_ns;
  if (frame.time_ns - *free_since_ns_ < kFree_ns) return;
  const Vec3& tracked = (*frame.tracked)[Joint::palm].position;
  raise(free_max_mm_, 1e3 * ((*frame.corrected)[Joint::palm].position - tracked).norm());
}

void PoseMeter::take_thumb(const PoseFrame& frame) {
  const std::optional<double> tracked_deg = thumb_open_deg(*frame.tracked);
  if (!tracked_deg || *tracked_deg >= kThumbOpen_deg) return;
  raise(thumb_open_max_deg_, thumb_open_deg(*frame.corrected));
}

void PoseMeter::merge(const PoseMeter& other) {
  along_mm_.merge(other.along_mm_);
  turn_deg_.merge(other.turn_deg_);
  overlap_mm_.merge(other.overlap_mm_);
  raise(free_max_mm_, other.free_max_mm_);
  raise(thumb_open_max_deg_, other.thumb_open_max_deg_);
  break_off();
}

PoseDifference PoseMeter::finish() const {
  PoseDifference result;
  result.along_p95_mm = along_mm_.quantile(0.95);
  result.free_max_mm = free_max_mm_;
  result.turn_median_deg = turn_deg_.quantile(0.5);
  result.turn_p95_deg = turn_deg_.quantile(0.95);
  result.thumb_open_max_deg = thumb_open_max_deg_;
  result.overlap_p99_mm = overlap_mm_.quantile(0.99);
  return result;
}

}  // namespace nade
