#pragma once

#include <array>
#include <optional>
#include <vector>

#include "mediapipe_result.h"
#include "nade/hand.h"

namespace nade::io {

/// Wrist to middle knuckle of the generic hand.
inline constexpr double kGenericLength_m = 0.092;

/// How long the bone is that ends in each landmark, metres; 0 of the wrist.
using LandmarkBones = std::array<double, kLandmarkCount>;

/// A hand's points in our axes, of whatever size and place; none where they lie in one. Its world
/// points, or where it has none those of a picture of this `aspect`.
[[nodiscard]] std::optional<Landmarks> shape_of(const LandmarkHand& hand, double aspect);

/// The bones of a hand that is as long as the generic one, wrist to middle knuckle, in the
/// proportions that these shapes have at the median. Not finite where there is no shape.
[[nodiscard]] LandmarkBones bones_of(const std::vector<Landmarks>& shapes);

/// The shape with these bones, its wrist at the origin.
[[nodiscard]] Landmarks with_bones(const Landmarks& shape, const LandmarkBones& bones);

/// The middle of the palm of points.
[[nodiscard]] Vec3 middle_of_palm(const Landmarks& points);

/// Points of a picture in heights of it, from its middle, up and to the right.
[[nodiscard]] Landmarks in_heights(const Landmarks& picture, double aspect);

/// How far points are spread across the line of sight.
[[nodiscard]] double spread_across(const Landmarks& points);

/// The upper one of an even number; 0 of none.
[[nodiscard]] double median_of(std::vector<double>& values);

/// The 26 joints: the 21 as they are, the rest and all rotations inferred (docs/formats.md).
[[nodiscard]] HandPose hand_from_landmarks(Handedness side, const Landmarks& points);

}  // namespace nade::io
