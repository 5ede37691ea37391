#include "make_dog_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

// Based on: Inigo Quilez. Smooth minimum (the cubic polynomial one) and the first-order ellipsoid
// bound. 2013.
// Based on: Carl de Boor. A Practical Guide to Splines. 1978 (cubic spline interpolation).

namespace dog {
namespace {

constexpr int kSamplesPerSegment = 6;
constexpr int kNewtonSteps = 4;

/// Second derivatives of the C2 cubic spline through `values`. Natural ends for the center, level
/// ones for the sizes, so that the rounded ends join on without a crease.
template <class Channels>
std::vector<Channels> second_derivatives(const std::vector<double>& knots,
                                         const std::vector<Channels>& values) {
  const std::size_t n = knots.size();
  const auto row = static_cast<Eigen::Index>(n);
  std::vector<Channels> result(n, Channels::Zero());
  for (Eigen::Index channel = 0; channel < 6; ++channel) {
    const bool level_ends = channel >= 3;
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(row, row);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(row);
    const auto slope = [&](std::size_t i) {
      return (values[i + 1][channel] - values[i][channel]) / (knots[i + 1] - knots[i]);
    };
    for (std::size_t i = 0; i < n; ++i) {
      const auto r = static_cast<Eigen::Index>(i);
      const bool first = i == 0;
      const bool last = i + 1 == n;
      if ((first || last) && !level_ends) {
        system(r, r) = 1.0;
        continue;
      }
      const double before = first ? 0.0 : knots[i] - knots[i - 1];
      const double after = last ? 0.0 : knots[i + 1] - knots[i];
      system(r, r) = 2.0 * (before + after);
      if (!first) system(r, r - 1) = before;
      if (!last) system(r, r + 1) = after;
      right[r] = 6.0 * ((last ? 0.0 : slope(i)) - (first ? 0.0 : slope(i - 1)));
    }
    const Eigen::VectorXd solved = system.partialPivLu().solve(right);
    for (std::size_t i = 0; i < n; ++i) result[i][channel] = solved[static_cast<Eigen::Index>(i)];
  }
  return result;
}

}  // namespace

double smooth_min(double a, double b, double width) {
  const double overlap = std::max(width - std::abs(a - b), 0.0) / width;
  return std::min(a, b) - overlap * overlap * overlap * width / 6.0;
}

Tube::Tube(std::span<const Station> stations, const Vec3& side, double cap, double power)
    : side_(side.normalized()), cap_(cap), power_(power) {
  fit(stations);
  double reach = cap;
  for (const Station& station : stations)
    reach = std::max(
        {reach, station.half_width * (1.0 + std::abs(station.taper)), station.half_height});
  for (const Sample& sample : samples_) bounds_.extend(sample.point);
  bounds_.min().array() -= 1.1 * reach;
  bounds_.max().array() += 1.1 * reach;
}

void Tube::fit(std::span<const Station> stations) {
  std::vector<double> knots;
  std::vector<Channels> values;
  for (const Station& station : stations) {
    Channels value;
    value << station.center, station.half_width, station.half_height, station.taper;
    knots.push_back(knots.empty() ? 0.0 : knots.back() + (value - values.back()).head<3>().norm());
    values.push_back(value);
  }
  const std::vector<Channels> bend = second_derivatives(knots, values);
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
    const double h = knots[i + 1] - knots[i];
    const Channels c1 = (values[i + 1] - values[i]) / h - h / 6.0 * (2.0 * bend[i] + bend[i + 1]);
    segments_.push_back(
        {knots[i], h, values[i], c1, bend[i] / 2.0, (bend[i + 1] - bend[i]) / (6.0 * h)});
  }
  end_ = knots.back();
  const auto count = static_cast<int>(segments_.size()) * kSamplesPerSegment;
  for (int i = 0; i <= count; ++i) {
    const double parameter = end_ * i / count;
    const Segment& s = segment_at(parameter);
    const double t = parameter - s.start;
    const Channels at = s.c0 + t * (s.c1 + t * (s.c2 + t * s.c3));
    samples_.push_back({at.head<3>(), parameter});
  }
}

const Tube::Segment& Tube::segment_at(double parameter) const {
  std::size_t i = 0;
  while (i + 1 < segments_.size() && parameter > segments_[i + 1].start) ++i;
  return segments_[i];
}

double Tube::nearest_parameter(const Vec3& point) const {
  std::size_t best = 0;
  double best_squared = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    const double squared = (samples_[i].point - point).squaredNorm();
    if (squared < best_squared) {
      best_squared = squared;
      best = i;
    }
  }
  const double low = samples_[best == 0 ? 0 : best - 1].parameter;
  const double high = samples_[std::min(best + 1, samples_.size() - 1)].parameter;
  double parameter = samples_[best].parameter;
  for (int step = 0; step < kNewtonSteps; ++step) {
    const Segment& s = segment_at(parameter);
    const double t = parameter - s.start;
    const Vec3 center = (s.c0 + t * (s.c1 + t * (s.c2 + t * s.c3))).head<3>();
    const Vec3 first = (s.c1 + t * (2.0 * s.c2 + t * 3.0 * s.c3)).head<3>();
    const Vec3 second = (2.0 * s.c2 + t * 6.0 * s.c3).head<3>();
    const Vec3 offset = point - center;
    const double slope = offset.dot(first);
    const double bend = offset.dot(second) - first.squaredNorm();
    if (bend > -1e-3) break;  // beyond the curve's centre of curvature: keep the sample
    const double before = parameter;
    parameter = std::clamp(parameter - slope / bend, low, high);
    if (std::abs(parameter - before) < 1e-12) break;
  }
  return parameter;
}

double Tube::curve_distance(const Vec3& point) const {
  const double parameter = nearest_parameter(point);
  const Segment& s = segment_at(parameter);
  const double t = parameter - s.start;
  return ((s.c0 + t * (s.c1 + t * (s.c2 + t * s.c3))).head<3>() - point).norm();
}

double Tube::distance(const Vec3& point) const {
  const double parameter = nearest_parameter(point);
  const Segment& s = segment_at(parameter);
  const double t = parameter - s.start;
  const Channels at = s.c0 + t * (s.c1 + t * (s.c2 + t * s.c3));
  const Vec3 along = (s.c1 + t * (2.0 * s.c2 + t * 3.0 * s.c3)).head<3>().normalized();
  const Vec3 across = (side_ - side_.dot(along) * along).normalized();
  const Vec3 up = across.cross(along);
  const Vec3 offset = point - at.head<3>();
  const double v = offset.dot(up);
  const double lean = std::clamp(v / at[4], -1.5, 1.5);
  // An odd polynomial that levels off at the top and bottom, so that the widening stays smooth.
  const double width = at[3] * (1.0 + at[5] * lean * (1.0 - lean * lean / 6.75));
  const Vec3 local(offset.dot(across), v, offset.dot(along));
  const Vec3 scaled = local.cwiseAbs().cwiseQuotient(Vec3(width, at[4], cap_));
  const Vec3 sizes(width, at[4], cap_);
  if (power_ == 2.0) {
    const double q = scaled.norm();
    const double slope = scaled.cwiseQuotient(sizes).norm();
    return slope > 0.0 ? q * (q - 1.0) / slope : -std::min(width, at[4]);
  }
  const Vec3 powers = scaled.array().pow(power_ - 1.0);
  const double sum = powers.dot(scaled);
  if (sum <= 0.0) return -std::min(width, at[4]);
  const double q = std::pow(sum, 1.0 / power_);
  return (q - 1.0) * sum / (q * powers.cwiseQuotient(sizes).norm());
}

double Ellipsoid::distance(const Vec3& point) const {
  const Vec3 scaled = (rotation.conjugate() * (point - center)).cwiseQuotient(radii);
  const double q = scaled.norm();
  const double slope = scaled.cwiseQuotient(radii).norm();
  return slope > 0.0 ? q * (q - 1.0) / slope : -radii.minCoeff();
}

Box Ellipsoid::bounds() const {
  const Vec3 reach =
      (rotation.toRotationMatrix().array().square().matrix() * radii.array().square().matrix())
          .cwiseSqrt();
  return {center - reach, center + reach};
}

double Part::distance(const Vec3& point) const {
  double result = 0.0;
  bool first = true;
  for (const Shape& shape : shapes) {
    const double d = std::visit([&](const auto& form) { return form.distance(point); }, shape.form);
    result = first ? d : smooth_min(result, d, shape.blend);
    first = false;
  }
  return result;
}

void Body::add(Part part) {
  for (const Shape& shape : part.shapes)
    part.bounds.extend(
        std::visit([](const auto& form) -> Box { return form.bounds(); }, shape.form));
  parts_.push_back(std::move(part));
}

void Body::add(Furrow furrow) { furrows_.push_back(std::move(furrow)); }

double Body::distance(const Vec3& point) const {
  double result = 1.0;
  for (const Part& part : parts_) {
    // Twice the blend: the distances are only exact to first order.
    const double far = part.bounds.exteriorDistance(point);
    if (far > std::max(result, 0.0) + 2.0 * part.blend + 0.01) continue;
    result = smooth_min(result, part.distance(point), part.blend);
  }
  for (const Furrow& furrow : furrows_) {
    if (furrow.curve.bounds().exteriorDistance(point) > 5.0 * furrow.width) continue;
    const double share = furrow.curve.curve_distance(point) / furrow.width;
    result += furrow.depth * std::exp(-share * share);
  }
  return result;
}

FieldSample Body::sample(const Vec3& point) const {
  constexpr double kStep = 1e-6;
  const double here = distance(point);
  const Vec3 gradient(distance(point + kStep * Vec3::UnitX()) - here,
                      distance(point + kStep * Vec3::UnitY()) - here,
                      distance(point + kStep * Vec3::UnitZ()) - here);
  return {here, gradient / kStep};
}

Vec3 Body::project(const Vec3& point, int steps) const {
  constexpr double kLongestStep = 0.002;
  Vec3 result = point;
  for (int i = 0; i < steps; ++i) {
    const FieldSample field = sample(result);
    const double squared = std::max(field.gradient.squaredNorm(), 1e-3);
    Vec3 step = -field.distance / squared * field.gradient;
    if (step.norm() > kLongestStep) step *= kLongestStep / step.norm();
    result += step;
  }
  return result;
}

double Body::edge_length(const Vec3& point) const {
  constexpr double kGrowth = 0.3;  // metres of edge for each metre away from a finer part
  double result = std::numeric_limits<double>::max();
  const auto take = [&](double edge, double away) {
    result = std::min(result, edge + kGrowth * std::max(away, 0.0));
  };
  for (const Part& part : parts_) {
    if (part.edge + kGrowth * part.bounds.exteriorDistance(point) >= result) continue;
    take(part.edge, part.distance(point));
  }
  for (const Furrow& furrow : furrows_) {
    if (furrow.edge + kGrowth * furrow.curve.bounds().exteriorDistance(point) >= result) continue;
    take(furrow.edge, furrow.curve.curve_distance(point) - furrow.width);
  }
  return result;
}

const Part& Body::part(const std::string& name) const {
  for (const Part& part : parts_)
    if (part.name == name) return part;
  throw std::logic_error("the dog has no part named " + name);
}

const Furrow& Body::furrow(const std::string& name) const {
  for (const Furrow& furrow : furrows_)
    if (furrow.name == name) return furrow;
  throw std::logic_error("the dog has no furrow named " + name);
}

Box Body::bounds() const {
  Box result;
  for (const Part& part : parts_) result.extend(part.bounds);
  return result;
}

}  // namespace dog
