#pragma once

#include <array>

#include "nade/hand_mesh.h"

namespace nade::test {

/// Of the skin about each joint, metres: an octahedron, so that its palmar corner is this far
/// below the joint.
inline constexpr double kToySkin_m = 0.008;
inline constexpr double kToyPalmSkin_m = 0.010;

/// A flat right hand with all joints at height `y`: fingers forward (-Z), back up, thumb left.
inline HandPose at_height(double y) {
  constexpr std::array<double, kDigitCount> kSide{-0.03, -0.02, 0.0, 0.02, 0.04};
  HandPose hand;
  hand[Joint::wrist].position = {0.0, y, 0.0};
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    const DigitJoints digit = joints_of(digit_at(d));
    for (std::size_t step = 0; step < digit.count(); ++step) {
      hand.joints[index_of(digit.metacarpal) + step].position = {
          kSide[d], y, -0.03 - 0.03 * static_cast<double>(step)};
    }
  }
  hand[Joint::palm] = palm_from_middle_metacarpal(hand);
  return hand;
}

/// A hand mesh that can be measured by hand: an octahedron around each joint.
inline HandMesh toy_mesh(Handedness side) {
  HandMesh mesh;
  mesh.side = side;
  mesh.bind = side == Handedness::right ? at_height(0.0) : mirrored(at_height(0.0));
  for (std::size_t joint = 0; joint < kJointCount; ++joint) {
    const bool is_palm = joint_at(joint) == Joint::palm;
    const auto radius = static_cast<float>(is_palm ? kToyPalmSkin_m : kToySkin_m);
    const std::size_t bone = is_palm ? index_of(Joint::middle_metacarpal) : joint;
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const Eigen::Vector3f& axis :
         {Eigen::Vector3f(1, 0, 0), Eigen::Vector3f(-1, 0, 0), Eigen::Vector3f(0, 1, 0),
          Eigen::Vector3f(0, -1, 0), Eigen::Vector3f(0, 0, 1), Eigen::Vector3f(0, 0, -1)}) {
      mesh.vertices.emplace_back(mesh.bind.joints[joint].position.cast<float>() + radius * axis);
      mesh.normals.push_back(axis);
      mesh.texcoords.emplace_back(0.0F, 0.0F);
      mesh.bones.push_back({static_cast<std::uint8_t>(bone), 1, 1, 1});
      mesh.weights.push_back({1.0F, 0.0F, 0.0F, 0.0F});
    }
    for (const std::array<std::uint32_t, 3>& corners : {std::array<std::uint32_t, 3>{0, 2, 4},
                                                        {4, 2, 1},
                                                        {1, 2, 5},
                                                        {5, 2, 0},
                                                        {4, 3, 0},
                                                        {1, 3, 4},
                                                        {5, 3, 1},
                                                        {0, 3, 5}}) {
      mesh.triangles.push_back({first + corners[0], first + corners[1], first + corners[2]});
    }
  }
  return mesh;
}

}  // namespace nade::test
