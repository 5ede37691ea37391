#include "mediapipe_hand.h"

#include <algorithm>
#include <cmath>

#include "leap_hand.h"

namespace nade::io {
namespace {

constexpr std::size_t kMiddleKnuckle = 9;
constexpr std::size_t kPointsOfDigit = 4;
/// A hand is some hundredths of a metre, or of a picture.
constexpr double kSmallestShape = 1e-6;

/// A point's neighbour on the way to the wrist.
constexpr std::size_t before(std::size_t landmark) {
  return landmark % kPointsOfDigit == 1 ? 0 : landmark - 1;
}

double bone_length(const Landmarks& shape, std::size_t landmark) {
  return (shape[landmark] - shape[before(landmark)]).norm();
}

double all_bones(const Landmarks& shape) {
  double sum = 0.0;
  for (std::size_t i = 1; i < kLandmarkCount; ++i) sum += bone_length(shape, i);
  return sum;
}

}  // namespace

double median_of(std::vector<double>& values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::optional<Landmarks> shape_of(const LandmarkHand& hand, double aspect) {
  Landmarks shape = hand.world ? *hand.world : *hand.picture;
  for (Vec3& point : shape) {
    if (!hand.world) point = {aspect * point.x(), point.y(), aspect * point.z()};
    point = {point.x(), -point.y(), -point.z()};
  }
  if (!(bone_length(shape, kMiddleKnuckle) > kSmallestShape)) return std::nullopt;
  return shape;
}

LandmarkBones bones_of(const std::vector<Landmarks>& shapes) {
  LandmarkBones bones{};
  for (std::size_t i = 1; i < kLandmarkCount; ++i) {
    // Shares of the whole hand: a picture's hand is larger the nearer it is.
    std::vector<double> shares;
    shares.reserve(shapes.size());
    for (const Landmarks& shape : shapes) {
      shares.push_back(bone_length(shape, i) / all_bones(shape));
    }
    bones[i] = median_of(shares);
  }
  const double scale = kGenericLength_m / bones[kMiddleKnuckle];
  for (double& bone : bones) bone *= scale;
  return bones;
}

Landmarks with_bones(const Landmarks& shape, const LandmarkBones& bones) {
  Landmarks result{};
  result[0] = Vec3::Zero();
  for (std::size_t i = 1; i < kLandmarkCount; ++i) {
    const double length = bone_length(shape, i);
    const Vec3 bone = shape[i] - shape[before(i)];
    result[i] = result[before(i)];
    if (length > 0.0) result[i] += bones[i] / length * bone;
  }
  return result;
}

Vec3 middle_of_palm(const Landmarks& points) {
  return (points[0] + points[5] + points[9] + points[13] + points[17]) / 5.0;
}

Landmarks in_heights(const Landmarks& picture, double aspect) {
  Landmarks result{};
  for (std::size_t i = 0; i < kLandmarkCount; ++i) {
    result[i] = {aspect * (picture[i].x() - 0.5), 0.5 - picture[i].y(), 0.0};
  }
  return result;
}

double spread_across(const Landmarks& points) {
  Vec3 middle = Vec3::Zero();
  for (const Vec3& point : points) middle += point / double{kLandmarkCount};
  double sum = 0.0;
  for (const Vec3& point : points) sum += (point - middle).head<2>().squaredNorm();
  return std::sqrt(sum / double{kLandmarkCount});
}

HandPose hand_from_landmarks(Handedness side, const Landmarks& points) {
  LeapHand hand;
  hand.side = side;
  hand.wrist = points[0];
  for (std::size_t digit = 0; digit < kDigitCount; ++digit) {
    const std::size_t first = 1 + kPointsOfDigit * digit;
    hand.fingers[digit] = {points[first], points[first + 1], points[first + 2], points[first + 3]};
  }
  return hand_from_wrist_and_fingers(hand);
}

}  // namespace nade::io
