// Based on: Ericson. Real-Time Collision Detection. 2005. Section 5.1.9 (segments' distance).
#include "digit_meter.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nade {
namespace {

/// A tracked thumb that is open wider says nothing of the correction.
constexpr double kOpen_rad = 55.0 * kDegree;

struct Segment {
  Vec3 from;
  Vec3 to;
};

Segment bone_after(const HandPose& hand, std::size_t joint) {
  return {hand.joints[joint].position, hand.joints[joint + 1].position};
}

/// Where on a segment a point is nearest, 0 to 1.
double nearest_on(const Segment& segment, const Vec3& point) {
  const Vec3 way = segment.to - segment.from;
  const double square = way.squaredNorm();
  return square > 0.0 ? std::clamp(way.dot(point - segment.from) / square, 0.0, 1.0) : 0.0;
}

Vec3 at(const Segment& segment, double share) {
  return segment.from + share * (segment.to - segment.from);
}

double distance(const Segment& a, const Segment& b) {
  const Vec3 u = a.to - a.from;
  const Vec3 v = b.to - b.from;
  const Vec3 w = a.from - b.from;
  const double even = u.squaredNorm() * v.squaredNorm() - u.dot(v) * u.dot(v);
  // Of parallel ones any place serves.
  double on_a = even > 0.0 ? (u.dot(v) * v.dot(w) - v.squaredNorm() * u.dot(w)) / even : 0.0;
  on_a = std::clamp(on_a, 0.0, 1.0);
  const double on_b = nearest_on(b, at(a, on_a));
  on_a = nearest_on(a, at(b, on_b));
  return (at(a, on_a) - at(b, on_b)).norm();
}

double nearest_skin_m(const HandMesh& mesh, const Vec3& middle) {
  double nearest_square = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3f& vertex : mesh.vertices) {
    nearest_square = std::min(nearest_square, (vertex.cast<double>() - middle).squaredNorm());
  }
  return mesh.vertices.empty() ? 0.0 : std::sqrt(nearest_square);
}

}  // namespace

double thumb_opening(const HandPose& hand) noexcept {
  const Vec3 back = hand.back();
  const auto bone = [&](Joint from, Joint to) -> Vec3 {
    return along_surface(hand[to].position - hand[from].position, back);
  };
  const Vec3 thumb = bone(Joint::thumb_metacarpal, Joint::thumb_proximal);
  const Vec3 index = bone(Joint::index_metacarpal, Joint::index_proximal);
  return std::atan2(thumb.cross(index).norm(), thumb.dot(index));
}

DigitMeter::DigitMeter(const HandMesh& mesh, double scale) {
  std::size_t count = 0;
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    const DigitJoints joints = joints_of(digit_at(d));
    for (std::size_t j = index_of(joints.metacarpal) + 1; j < index_of(joints.tip); ++j) {
      const Vec3 middle = at(bone_after(mesh.bind, j), 0.5);
      phalanges_[count++] = {digit_at(d), j, scale * nearest_skin_m(mesh, middle)};
    }
  }
}

void DigitMeter::add(const HandPose& tracked, const HandPose& corrected) {
  if (thumb_opening(tracked) < kOpen_rad) {
    thumb_open_max_ = std::max(thumb_open_max_.value_or(0.0), thumb_opening(corrected));
  }
  overlap_mm_.add(1e3 * std::max(0.0, overlap_m(corrected) - overlap_m(tracked)));
}

double DigitMeter::overlap_m(const HandPose& hand) const {
  double deepest_m = 0.0;
  for (std::size_t i = 0; i < kPhalanges; ++i) {
    for (std::size_t j = i + 1; j < kPhalanges; ++j) {
      const Phalanx& a = phalanges_[i];
      const Phalanx& b = phalanges_[j];
      if (a.digit == b.digit) continue;
      const double apart_m = distance(bone_after(hand, a.joint), bone_after(hand, b.joint));
      deepest_m = std::max(deepest_m, a.radius_m + b.radius_m - apart_m);
    }
  }
  return deepest_m;
}

void DigitMeter::merge(const DigitMeter& other) {
  if (other.thumb_open_max_) {
    thumb_open_max_ = std::max(thumb_open_max_.value_or(0.0), *other.thumb_open_max_);
  }
  overlap_mm_.merge(other.overlap_mm_);
}

DigitsApart DigitMeter::finish() const {
  DigitsApart apart;
  if (thumb_open_max_) apart.thumb_open_max_deg = *thumb_open_max_ / kDegree;
  apart.overlap_p99_mm = overlap_mm_.quantile(0.99);
  return apart;
}

}  // namespace nade
