#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace dog {

using Vec3 = Eigen::Vector3d;

/// An axis-aligned box, metres.
using Box = Eigen::AlignedBox3d;

/// One cross-section of a tube.
struct Station {
  Vec3 center;
  double half_width;   ///< along the tube's side direction
  double half_height;  ///< across it
  double taper = 0.0;  ///< how much wider the section is at +height than at its middle, as a share
};

/// An elliptic section swept along a smooth curve through its stations, its ends rounded.
class Tube {
 public:
  /// `side` is the direction of the half widths, not along the curve. `cap` is how far the rounded
  /// ends reach beyond the first and last station. `power` is 2 for ellipses, more for squarer
  /// sections. At least two stations, no two in the same place.
  Tube(std::span<const Station> stations, const Vec3& side, double cap, double power = 2.0);

  /// About the distance to the surface, exact to first order there; negative inside.
  [[nodiscard]] double distance(const Vec3& point) const;
  /// Distance to the curve in the middle.
  [[nodiscard]] double curve_distance(const Vec3& point) const;
  [[nodiscard]] const Box& bounds() const { return bounds_; }

 private:
  /// Center, half width, half height, taper.
  using Channels = Eigen::Matrix<double, 6, 1>;
  struct Segment {
    double start;
    double length;
    Channels c0, c1, c2, c3;
  };
  struct Sample {
    Vec3 point;
    double parameter;
  };

  [[nodiscard]] double nearest_parameter(const Vec3& point) const;
  [[nodiscard]] const Segment& segment_at(double parameter) const;
  void fit(std::span<const Station> stations);

  std::vector<Segment> segments_;
  std::vector<Sample> samples_;
  Vec3 side_;
  double cap_;
  double power_;
  double end_ = 0.0;
  Box bounds_;
};

/// An ellipsoid, turned.
struct Ellipsoid {
  Vec3 center;
  Vec3 radii;
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();

  /// About the distance to the surface, exact to first order there; negative inside.
  [[nodiscard]] double distance(const Vec3& point) const;
  [[nodiscard]] Box bounds() const;
};

/// A rounded shape and how softly it joins those before it in its part.
struct Shape {
  std::variant<Tube, Ellipsoid> form;
  double blend;  ///< width of the joint, metres
};

/// A named piece of the body: later what moves on its own.
struct Part {
  std::string name;
  std::vector<Shape> shapes;
  double blend;  ///< width of the joint with the parts before it, metres
  double edge;   ///< how long the triangles' edges should be here, metres
  Box bounds = {};

  [[nodiscard]] double distance(const Vec3& point) const;
};

/// A shallow furrow along a curve.
struct Furrow {
  std::string name;
  Tube curve;
  double depth;
  double width;
  double edge;
};

/// Value and slope of the body's distance field.
struct FieldSample {
  double distance;
  Vec3 gradient;
};

/// The whole animal: a smooth union of parts. Its surface is where `distance` is zero.
class Body {
 public:
  void add(Part part);
  void add(Furrow furrow);

  /// Negative inside; about the distance near the surface.
  [[nodiscard]] double distance(const Vec3& point) const;
  [[nodiscard]] FieldSample sample(const Vec3& point) const;
  /// The nearest point of the surface, by Newton steps along the slope; `point` must be near it.
  [[nodiscard]] Vec3 project(const Vec3& point, int steps) const;
  /// How long an edge at this point of the surface should be.
  [[nodiscard]] double edge_length(const Vec3& point) const;

  /// The part of this name; the program ends where there is none.
  [[nodiscard]] const Part& part(const std::string& name) const;
  [[nodiscard]] const Furrow& furrow(const std::string& name) const;
  [[nodiscard]] Box bounds() const;

 private:
  std::vector<Part> parts_;
  std::vector<Furrow> furrows_;
};

/// The lower of two distances with a joint rounded over about `width`; exactly the lower where they
/// differ by more.
[[nodiscard]] double smooth_min(double a, double b, double width);

}  // namespace dog
