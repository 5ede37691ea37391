#pragma once

#include <cmath>
#include <cstdio>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "nade/hand.h"
#include "support/sample_hand.h"

namespace nade::test {

/// How a program calls the joints of a hand.
struct BvhNames {
  std::string program;
  std::function<std::string(Handedness)> wrist;
  /// The joints of a digit, from its first one on.
  std::function<std::string(Handedness, Digit, std::size_t)> joint;
  bool has_metacarpals = false;
};

/// How a file is written.
struct BvhStyle {
  enum class Positions { root, placed, added };
  std::string order = "ZXY";
  Positions positions = Positions::root;
  double unit_m = 1e-2;
  bool body = true;                 ///< arms above the hands
  std::size_t joints_left_out = 0;  ///< of each digit, before its tip
  bool ends = true;                 ///< whether an End Site is where the tip is
};

struct BvhFrame {
  std::optional<HandPose> left;
  std::optional<HandPose> right;
};

/// A joint as it is written.
struct BvhWritten {
  std::string name;
  std::optional<std::size_t> parent;
  Vec3 offset = Vec3::Zero();
  std::optional<Handedness> side;  ///< of a hand's joint
  Joint joint = Joint::wrist;
  bool is_end = false;
};

inline const std::optional<HandPose>& hand_of(const BvhFrame& frame, Handedness side) {
  return side == Handedness::left ? frame.left : frame.right;
}

/// A hand with all turns 0, as the file's rest is.
inline Vec3 rest_offset(Handedness side, Joint from, Joint to) {
  const HandPose hand = sample_hand(side, {});
  return hand[to].position - hand[from].position;
}

inline std::vector<BvhWritten> bvh_joints(const BvhFrame& first, const BvhNames& names,
                                          const BvhStyle& style) {
  std::vector<BvhWritten> joints;
  if (style.body) joints.push_back({"Hips", std::nullopt, Vec3::Zero(), std::nullopt});
  for (const Handedness side : {Handedness::left, Handedness::right}) {
    if (!hand_of(first, side)) continue;
    std::optional<std::size_t> above;
    if (style.body) {
      above = joints.size();
      const double sign = side == Handedness::right ? 1.0 : -1.0;
      joints.push_back({side == Handedness::left ? "LeftForeArm" : "RightForeArm", 0U,
                        Vec3(sign * 0.2, 1.2, 0.0), std::nullopt});
    }
    const std::size_t wrist = joints.size();
    joints.push_back({names.wrist(side), above, Vec3(0.0, 0.0, -0.25), side, Joint::wrist});
    for (std::size_t d = 0; d < kDigitCount; ++d) {
      const DigitJoints digit = joints_of(digit_at(d));
      std::size_t parent = wrist;
      Joint before = Joint::wrist;
      std::size_t number = 0;
      const bool skips = d > 0 && !names.has_metacarpals;
      for (std::size_t k = skips ? 1 : 0; k < digit.count(); ++k) {
        const bool is_end = k + 1 == digit.count();
        if (!is_end && k + 1 + style.joints_left_out >= digit.count()) continue;
        const Joint joint = joint_at(index_of(digit.metacarpal) + k);
        Vec3 offset = rest_offset(side, before, joint);
        if (is_end && !style.ends) offset = Vec3::Zero();
        joints.push_back({is_end ? "" : names.joint(side, digit_at(d), number++), parent, offset,
                          side, joint, is_end});
        parent = joints.size() - 1;
        before = joint;
      }
    }
  }
  return joints;
}

/// Angles about the axes of `order`, in degrees, whose turns multiplied in this order give `turn`.
inline Vec3 angles_of(const Quat& turn, const std::string& order) {
  const auto axis = [&](std::size_t i) { return static_cast<Eigen::Index>(order[i] - 'X'); };
  return turn.toRotationMatrix().eulerAngles(axis(0), axis(1), axis(2)) / kDegree;
}

/// Where a joint is in a frame, and how it is turned against its rest.
inline Pose bvh_pose(const BvhWritten& joint, const BvhFrame& frame,
                     const std::vector<BvhWritten>& joints) {
  if (!joint.side) {
    Pose pose;
    for (const BvhWritten* at = &joint; at->parent; at = &joints[*at->parent]) {
      pose.position += at->offset;
    }
    return pose;
  }
  const HandPose rest = sample_hand(*joint.side, {});
  const Pose& now = (*hand_of(frame, *joint.side))[joint.joint];
  return {now.position, now.rotation * rest[joint.joint].rotation.conjugate()};
}

inline void append_number(std::string& text, double number) {
  char word[64];
  std::snprintf(word, sizeof word, "%.9g", number);
  text += word;
}

inline void append_joint(std::string& text, const std::vector<BvhWritten>& joints,
                         std::size_t index, const BvhStyle& style) {
  const BvhWritten& joint = joints[index];
  text +=
      joint.is_end ? "End Site\n{\n" : (joint.parent ? "JOINT " : "ROOT ") + joint.name + "\n{\n";
  text += "OFFSET";
  for (const double number : joint.offset) {
    text += ' ';
    append_number(text, number / style.unit_m);
  }
  text += '\n';
  // A hand that hangs on a body is where its arm is not: its wrist moves.
  const bool moves =
      !joint.parent || joint.joint == Joint::wrist || style.positions != BvhStyle::Positions::root;
  if (!joint.is_end) {
    text += moves ? "CHANNELS 6 Xposition Yposition Zposition" : "CHANNELS 3";
    for (const char axis : style.order) text += std::string(" ") + axis + "rotation";
    text += '\n';
  }
  for (std::size_t i = index + 1; i < joints.size(); ++i) {
    if (joints[i].parent == index) append_joint(text, joints, i, style);
  }
  text += "}\n";
}

/// Hands in a BVH file.
inline std::string bvh_text(const std::vector<BvhFrame>& frames, const BvhNames& names,
                            const BvhStyle& style) {
  const std::vector<BvhWritten> joints = bvh_joints(frames.front(), names, style);
  std::string text = "HIERARCHY\n";
  append_joint(text, joints, 0, style);
  text += "MOTION\nFrames: " + std::to_string(frames.size()) + "\nFrame Time: 0.008333333333\n";
  for (const BvhFrame& frame : frames) {
    std::string line;
    for (const BvhWritten& joint : joints) {
      if (joint.is_end) continue;
      const Pose pose = bvh_pose(joint, frame, joints);
      const Pose parent = joint.parent ? bvh_pose(joints[*joint.parent], frame, joints) : Pose();
      const Pose local = parent.inverse() * pose;
      const bool moves = !joint.parent || joint.joint == Joint::wrist ||
                         style.positions != BvhStyle::Positions::root;
      if (moves) {
        const bool added = style.positions == BvhStyle::Positions::added && joint.parent;
        const Vec3 position = added ? Vec3(local.position - joint.offset) : local.position;
        for (const double number : position) {
          append_number(line, number / style.unit_m);
          line += ' ';
        }
      }
      for (const double number : angles_of(local.rotation, style.order)) {
        append_number(line, number);
        line += ' ';
      }
    }
    text += line + '\n';
  }
  return text;
}

/// The first one is Mixamo's.
inline std::vector<BvhNames> bvh_names() {
  const auto long_side = [](Handedness side) {
    return std::string(side == Handedness::left ? "Left" : "Right");
  };
  const auto short_side = [](Handedness side) {
    return std::string(side == Handedness::left ? "l" : "r");
  };
  const auto plain = [](Digit digit) { return std::string(name_of(part_of(digit))); };
  const auto capital = [plain](Digit digit) {
    std::string name = digit == Digit::little ? "Pinky" : plain(digit);
    name[0] = static_cast<char>(std::toupper(name[0]));
    return name;
  };
  const auto number = [](std::size_t value) { return std::to_string(value); };
  return {
      {"Mixamo", [=](Handedness s) { return long_side(s) + "Hand"; },
       [=](Handedness s, Digit d, std::size_t i) {
         return long_side(s) + "Hand" + capital(d) + number(i + 1);
       }},
      {"Unreal", [=](Handedness s) { return "hand_" + short_side(s); },
       [=](Handedness s, Digit d, std::size_t i) {
         const std::string name = d == Digit::little ? "pinky" : plain(d);
         return name + "_0" + number(i + 1) + "_" + short_side(s);
       }},
      {"Poser", [=](Handedness s) { return short_side(s) + "Hand"; },
       [=](Handedness s, Digit d, std::size_t i) {
         return short_side(s) + (d == Digit::middle ? "Mid" : capital(d)) + number(i + 1);
       }},
      {"plain", [=](Handedness s) { return short_side(s) + "_wrist"; },
       [=](Handedness s, Digit d, std::size_t i) {
         return short_side(s) + "_" + plain(d) + number(i + 1);
       }},
      {"Blender",
       [=](Handedness s) { return "hand." + std::string(s == Handedness::left ? "L" : "R"); },
       [=](Handedness s, Digit d, std::size_t i) {
         return "f_" + plain(d) + ".0" + number(i + 1) + (s == Handedness::left ? ".L" : ".R");
       }},
      {"3ds Max",
       [=](Handedness s) {
         return "Bip01 " + std::string(s == Handedness::left ? "L" : "R") + " Hand";
       },
       [=](Handedness s, Digit d, std::size_t i) {
         return "Bip01 " + std::string(s == Handedness::left ? "L" : "R") + " Finger" +
                number(index_of(d)) + (i == 0 ? "" : number(i));
       }},
      {"Unity", [=](Handedness s) { return long_side(s) + "Hand"; },
       [=](Handedness s, Digit d, std::size_t i) {
         const std::vector<std::string> parts{"Proximal", "Intermediate", "Distal"};
         return long_side(s) + (d == Digit::little ? "Little" : capital(d)) + parts[i];
       }},
      {"Xsens", [=](Handedness s) { return long_side(s) + "Carpus"; },
       [=](Handedness s, Digit d, std::size_t i) {
         const std::vector<std::string> ordinals{"First", "Second", "Third", "Fourth", "Fifth"};
         const std::vector<std::string> thumb{"MC", "PP", "DP"};
         const std::vector<std::string> finger{"MC", "PP", "MP", "DP"};
         return long_side(s) + ordinals[index_of(d)] + (d == Digit::thumb ? thumb : finger)[i];
       },
       true},
      {"Axis Neuron", [=](Handedness s) { return long_side(s) + "Hand"; },
       [=](Handedness s, Digit d, std::size_t i) {
         if (d == Digit::thumb) return long_side(s) + "HandThumb" + number(i + 1);
         return i == 0 ? long_side(s) + "InHand" + capital(d)
                       : long_side(s) + "Hand" + capital(d) + number(i);
       },
       true},
      {"Rokoko", [=](Handedness s) { return long_side(s) + "Hand"; },
       [=](Handedness s, Digit d, std::size_t i) {
         const std::vector<std::string> thumb{"Metacarpal", "Proximal", "Distal"};
         const std::vector<std::string> finger{"Metacarpal", "Proximal", "Medial", "Distal"};
         return long_side(s) + "Finger" + number(index_of(d) + 1) +
                (d == Digit::thumb ? thumb : finger)[i];
       },
       true},
      {"Quest", [=](Handedness s) { return "b_" + short_side(s) + "_wrist"; },
       [=](Handedness s, Digit d, std::size_t i) {
         return "b_" + short_side(s) + "_" + (d == Digit::little ? "pinky" : plain(d)) +
                number(d == Digit::thumb ? i + 1 : i);
       },
       true},
  };
}

}  // namespace nade::test
