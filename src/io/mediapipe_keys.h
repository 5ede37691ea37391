#pragma once

#include <algorithm>
#include <array>
#include <string_view>

namespace nade::io {

/// Under which keys MediaPipe's hand trackers, in JavaScript and Python, and the programs that
/// write their results down have the landmarks of all hands, or of one.
inline constexpr std::array<std::string_view, 5> kPictureKeys{
    "landmarks", "handLandmarks", "hand_landmarks", "multiHandLandmarks", "multi_hand_landmarks"};
inline constexpr std::array<std::string_view, 6> kWorldKeys{
    "worldLandmarks",       "world_landmarks",         "handWorldLandmarks",
    "hand_world_landmarks", "multiHandWorldLandmarks", "multi_hand_world_landmarks"};
/// Where the sides of all hands stand, and where a hand has its own.
inline constexpr std::array<std::string_view, 4> kSidesKeys{"handedness", "handednesses",
                                                            "multiHandedness", "multi_handedness"};
inline constexpr std::array<std::string_view, 3> kSideKeys{"handedness", "label", "side"};

[[nodiscard]] inline bool is_landmark_key(std::string_view key) {
  return std::find(kPictureKeys.begin(), kPictureKeys.end(), key) != kPictureKeys.end() ||
         std::find(kWorldKeys.begin(), kWorldKeys.end(), key) != kWorldKeys.end();
}

}  // namespace nade::io
