#include "synth_rail.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "nade/eval/posing.h"

namespace nade {
namespace {

constexpr int kSteps = 256;        // knots from x = 0 to x = 1
constexpr double kBlur_m = 0.004;  // what is finer than this is not followed by a hand
constexpr int kBlurKnotsMax = 40;  // of one side of the blur
constexpr int kMargin = kBlurKnotsMax + 3;
constexpr double kStray_m = 0.1;  // how far a step may lie off the surface
constexpr double kWalkStep_m = 0.004;
constexpr double kExtentMax_m = 0.12;
constexpr double kExtentMin_m = 0.015;
constexpr double kExtentStep_m = 0.005;
constexpr double kTurnMax_rad = 55.0 * kDegree;
constexpr double kTurnPerStepMax_rad = 15.0 * kDegree;

double angle_between(const Vec3& a, const Vec3& b) {
  return std::acos(std::clamp(a.dot(b), -1.0, 1.0));
}

/// Cubic B-spline weights of the four knots about a point `t` of the way between the middle two.
std::array<double, 4> spline_weights(double t) {
  const double s = 1.0 - t;
  return {s * s * s / 6.0, (3.0 * t * t * t - 6.0 * t * t + 4.0) / 6.0,
          (3.0 * s * s * s - 6.0 * s * s + 4.0) / 6.0, t * t * t / 6.0};
}

/// A weighted mean of points that are near each other.
class PointMean {
 public:
  void add(const Rail::Point& point, double weight) {
    const double sign = turn_.dot(point.rotation.coeffs()) < 0.0 ? -1.0 : 1.0;
    skin_ += weight * point.skin;
    turn_ += sign * weight * point.rotation.coeffs();
    total_ += weight;
  }
  [[nodiscard]] Rail::Point mean() const {
    return {skin_ / total_, Quat(Eigen::Vector4d(turn_.normalized()))};
  }

 private:
  Vec3 skin_ = Vec3::Zero();
  Eigen::Vector4d turn_ = Eigen::Vector4d::Zero();
  double total_ = 0.0;
};

std::vector<Rail::Point> blurred(const std::vector<Rail::Point>& points) {
  double length = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    length += (points[i].skin - points[i - 1].skin).norm();
  }
  const double spacing = length / static_cast<double>(points.size() - 1);
  if (spacing < 1e-9) return points;
  // A coarse rail is narrow in knots, a fine one is not blurred wider than its margin allows.
  const double sigma = std::min(kBlur_m / spacing, kBlurKnotsMax / 3.0);
  std::vector<Rail::Point> result(points.size());
  const auto count = static_cast<int>(points.size());
  for (int i = 0; i < count; ++i) {
    PointMean mean;
    for (int j = std::max(0, i - kBlurKnotsMax); j <= std::min(count - 1, i + kBlurKnotsMax); ++j) {
      const double away = (j - i) / sigma;
      mean.add(points[static_cast<std::size_t>(j)], std::exp(-0.5 * away * away));
    }
    result[static_cast<std::size_t>(i)] = mean.mean();
  }
  return result;
}

}  // namespace

double StrokePatch::reach(const PatternPoint& way) const {
  const Vec3 start = place_.rotation * Vec3::UnitY();
  Vec3 before = broad_normal(place_.position);
  double reached = 0.0;
  while (reached < kExtentMax_m) {
    const double next = reached + kExtentStep_m;
    const Vec3 normal = broad_normal(walk({next * way.aside, next * way.forward}));
    if (angle_between(normal, start) > kTurnMax_rad) break;
    if (angle_between(normal, before) > kTurnPerStepMax_rad) break;
    before = normal;
    reached = next;
  }
  return std::max(reached, kExtentMin_m);
}

PlaceExtent StrokePatch::extent() const {
  return {std::min(reach({0.0, 1.0}), reach({0.0, -1.0})),
          std::min(reach({1.0, 0.0}), reach({-1.0, 0.0}))};
}

Vec3 StrokePatch::walk(const PatternPoint& point) const {
  const double distance = std::hypot(point.aside, point.forward);
  Vec3 here = place_.position;
  if (distance < 1e-9) return here;
  Vec3 way = place_.rotation * Vec3(point.aside, 0.0, -point.forward) / distance;
  const int steps = static_cast<int>(std::ceil(distance / kWalkStep_m));
  SurfaceHint hint;
  for (int i = 0; i < steps; ++i) {
    const auto nearest = object_.closest_point(here + distance / steps * way, kStray_m, hint);
    if (!nearest) return here;
    here = nearest->point;
    const Vec3 tangent = along_surface(way, nearest->normal);
    if (tangent.norm() < 1e-6) return here;
    way = tangent.normalized();
  }
  return here;
}

Vec3 StrokePatch::broad_normal(const Vec3& point) const {
  return nade::broad_normal(object_, point, place_.rotation * Vec3::UnitY());
}

Quat StrokePatch::heading(const Vec3& normal) const {
  return Quat::FromTwoVectors(place_.rotation * Vec3::UnitY(), normal) * place_.rotation;
}

Vec3 StrokePatch::sunk(const Vec3& point, const Vec3& normal, double depth_m) const {
  Vec3 skin = point - depth_m * normal;
  SurfaceHint hint;
  for (int i = 0; i < 3; ++i) {
    const auto nearest = object_.closest_point(skin, kStray_m + depth_m, hint);
    if (!nearest || nearest->normal.dot(normal) < 0.5) break;
    const double missing = nearest->signed_distance + depth_m;
    if (std::abs(missing) > 0.25 * depth_m) break;
    skin -= missing * nearest->normal;
  }
  return skin;
}

Rail::Rail(const StrokePatch& patch, const Pattern& pattern, double depth_m) {
  std::vector<Point> points;
  points.reserve(kSteps + 1 + 2 * kMargin);
  for (int i = -kMargin; i <= kSteps + kMargin; ++i) {
    const Vec3 surface = patch.walk(pattern(static_cast<double>(i) / kSteps));
    const Vec3 normal = patch.broad_normal(surface);
    points.push_back({patch.sunk(surface, normal, depth_m), patch.heading(normal)});
  }
  knots_ = blurred(points);
}

Rail::Point Rail::at(double x) const {
  const double scaled = std::clamp(x, 0.0, 1.0) * kSteps;
  const double whole = std::min(std::floor(scaled), kSteps - 1.0);
  const auto first = static_cast<std::size_t>(whole) + kMargin - 1;
  const auto weights = spline_weights(scaled - whole);
  PointMean mean;
  for (std::size_t i = 0; i < weights.size(); ++i) mean.add(knots_[first + i], weights[i]);
  return mean.mean();
}

double Rail::length(const Vec3& offset_hand) const {
  double sum = 0.0;
  Vec3 before = Vec3::Zero();
  for (int i = 0; i <= kSteps; ++i) {
    const Point point = at(static_cast<double>(i) / kSteps);
    const Vec3 here = point.skin + point.rotation * offset_hand;
    if (i > 0) sum += (here - before).norm();
    before = here;
  }
  return sum;
}

}  // namespace nade
