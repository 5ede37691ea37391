#include "umetrack_hand.h"

// Based on: Han et al. UmeTrack: Unified multi-view end-to-end hand tracking for VR. 2022.
// Based on: Banerjee et al. HOT3D: Hand and Object Tracking in 3D from Egocentric Multi-View
// Videos. 2024. (the hand's files)

#include <fmt/format.h>

#include <cmath>

#include "byte_source.h"
#include "json_text.h"

namespace nade::io {
namespace {

constexpr std::size_t kHingesOfDigit = 4;
constexpr double kMillimetre = 1e-3;
/// A hand is some hundred millimetres.
constexpr double kFarthestPoint = 1e3;

/// Reads as many points as `points` has; there may be more.
template <std::size_t N>
Status read_points(const Json& model, const char* key, double unit, std::array<Vec3, N>& points) {
  const auto list = model.find(key);
  const auto wrong = [&](std::size_t index) {
    return Error{ErrorCode::bad_value,
                 fmt::format("hand_model: {}[{}]: expected three numbers within {:g}", key, index,
                             kFarthestPoint)};
  };
  if (list == model.end() || !list->is_array() || list->size() < N) {
    return Error{ErrorCode::bad_format, fmt::format("hand_model: {}: expected {} points", key, N)};
  }
  for (std::size_t i = 0; i < N; ++i) {
    const Json& point = (*list)[i];
    if (!point.is_array() || point.size() != 3) return wrong(i);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!point[axis].is_number()) return wrong(i);
      const auto number = point[axis].get<double>();
      if (!(std::abs(number) <= kFarthestPoint)) return wrong(i);
      points[i][static_cast<Eigen::Index>(axis)] = unit * number;
    }
  }
  return ok_status();
}

Result<UmetrackModel> model_from(const Json& profile) {
  const auto hand = profile.is_object() ? profile.find("hand_model") : profile.end();
  if (hand == profile.end() || !hand->is_object()) {
    return Error{ErrorCode::bad_format, "expected an object \"hand_model\", found none"};
  }
  UmetrackModel model;
  for (const Status& status :
       {read_points(*hand, "joint_rest_positions", kMillimetre, model.hinges),
        read_points(*hand, "joint_rotation_axes", 1.0, model.axes),
        read_points(*hand, "landmark_rest_positions", kMillimetre, model.tips)}) {
    if (!status) return status.error();
  }
  return model;
}

/// The base of the thumb's metacarpal. Where its two hinges lie apart, as in HOT3D, neither is in
/// it: it is put so far along the way from the first one to the knuckle that the metacarpal is as
/// long as a person's.
Vec3 base_of_thumb(const UmetrackModel& model) {
  constexpr double kShareOfWay = 0.3;
  constexpr double kApart_m = 1e-3;
  const Vec3& first = model.hinges[0];
  const bool apart = (model.hinges[1] - first).norm() > kApart_m;
  return apart ? Vec3(first + kShareOfWay * (model.hinges[2] - first)) : first;
}

/// The motion of what turns about a hinge.
Pose turned_about(const Vec3& point, const Vec3& axis, double angle_rad) {
  const double length = axis.norm();
  const Quat turn = length > 0.0 ? Quat(Eigen::AngleAxisd(length * angle_rad, axis / length))
                                 : Quat(Quat::Identity());
  return {point - turn * point, turn};
}

}  // namespace

Result<UmetrackModel> read_umetrack_model(const std::string& path) {
  Result<ByteSource> source = ByteSource::open(path);
  if (!source) return source.error();
  JsonWalker walker(*source);
  const std::optional<std::string_view> text = walker.value();
  if (source->failure()) return *source->failure();
  if (!text) {
    return Error{ErrorCode::bad_format,
                 fmt::format("{}: expected an object of at most {} MiB, found {}", path,
                             kLongestLine >> 20, walker.too_long() ? "more" : "it cut off")};
  }
  const Result<Json> profile = parse_json(*text);
  if (!profile) {
    return Error{profile.error().code, fmt::format("{}: {}", path, profile.error().message)};
  }
  Result<UmetrackModel> model = model_from(*profile);
  if (model) return model;
  return Error{model.error().code, fmt::format("{}: {}", path, model.error().message)};
}

LeapHand umetrack_hand(const UmetrackModel& model, Handedness side,
                       const std::array<double, kUmetrackAngles>& angles, const Pose& wrist) {
  LeapHand hand;
  hand.side = side;
  hand.wrist = wrist.position;
  const auto placed = [&](const Vec3& point) {
    const double sign = side == Handedness::left ? 1.0 : -1.0;
    return wrist.apply({sign * point.x(), point.y(), point.z()});
  };
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    const std::size_t first = kHingesOfDigit * d;
    // The first two hinges are those of the digit's base: what turns about both begins there.
    std::array<Pose, kHingesOfDigit + 1> motion{};
    for (std::size_t i = 0; i < kHingesOfDigit; ++i) {
      motion[i + 1] = motion[i] * turned_about(model.hinges[first + i], model.axes[first + i],
                                               angles[first + i]);
    }
    const bool is_thumb = digit_at(d) == Digit::thumb;
    LeapFinger& finger = hand.fingers[d];
    finger.mcp = placed(is_thumb ? base_of_thumb(model) : motion[1].apply(model.hinges[first + 1]));
    finger.pip = placed(motion[2].apply(model.hinges[first + 2]));
    finger.dip = placed(motion[3].apply(model.hinges[first + 3]));
    finger.tip = placed(motion[4].apply(model.tips[d]));
  }
  return hand;
}

}  // namespace nade::io
