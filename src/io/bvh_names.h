#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "nade/hand.h"

namespace nade::io {

/// What a joint's name says of a hand. All of it may be missing.
struct BvhName {
  std::optional<Handedness> side;
  std::optional<Digit> digit;
  /// Where the digits are counted, from 0 or from 1, instead of named ("LeftFinger2Distal").
  std::optional<std::size_t> digit_number;
  std::optional<std::size_t> number;  ///< the last one in the name: of the bone
  bool is_metacarpal = false;
  bool is_wrist = false;
  bool is_palm = false;
};

/// Reads a name as Mixamo, Rokoko, Axis Neuron ("LeftHandIndex1", "LeftInHandIndex"), Xsens
/// ("LeftSecondPP"), Unreal ("index_01_l"), Blender ("f_index.01.L"), 3ds Max ("Bip01 L Finger11"),
/// Poser ("lIndex1"), Unity ("LeftIndexProximal"), Quest ("b_l_index1") and the like spell it.
[[nodiscard]] BvhName bvh_name_from(std::string_view name);

}  // namespace nade::io
