#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <numbers>

namespace nade {

/// One degree, in radians.
inline constexpr double kDegree = std::numbers::pi / 180.0;

/// A point or direction; metres where it is a position. Right-handed, +Y up, -Z forward.
using Vec3 = Eigen::Vector3d;

/// A unit rotation. Unaligned, so that the layout of public types does not depend on the
/// instruction set a program is compiled for.
using Quat = Eigen::Quaternion<double, Eigen::DontAlign>;

/// The part of a vector that lies along a surface with this unit normal.
[[nodiscard]] inline Vec3 along_surface(const Vec3& vector, const Vec3& normal) {
  return vector - normal.dot(vector) * normal;
}

/// A vector, or as much of it as is no longer than `most`.
[[nodiscard]] inline Vec3 shortened(const Vec3& vector, double most) {
  const double length = vector.norm();
  return length > most ? Vec3(most / length * vector) : vector;
}

/// A rigid motion: `position` and `rotation` take local coordinates to the parent's.
struct Pose {
  Vec3 position = Vec3::Zero();
  Quat rotation = Quat::Identity();

  bool operator==(const Pose&) const = default;

  /// A local point in the parent's frame.
  [[nodiscard]] Vec3 apply(const Vec3& point_local) const {
    return rotation * point_local + position;
  }

  /// The motion that undoes this one.
  [[nodiscard]] Pose inverse() const {
    const Quat back = rotation.conjugate();
    return {back * -position, back};
  }

  /// First `inner`, then this.
  [[nodiscard]] Pose operator*(const Pose& inner) const {
    return {apply(inner.position), rotation * inner.rotation};
  }
};

/// A rigid motion with uniform scale (> 0): local coordinates are scaled, then moved.
struct Placement {
  Pose pose;
  double scale = 1.0;

  bool operator==(const Placement&) const = default;

  [[nodiscard]] Vec3 to_world(const Vec3& point_local) const {
    return pose.apply(scale * point_local);
  }
  [[nodiscard]] Vec3 to_local(const Vec3& point_world) const {
    return pose.rotation.conjugate() * (point_world - pose.position) / scale;
  }
};

}  // namespace nade
