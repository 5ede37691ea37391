#include "hot3d_import.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "recording_limits.h"
#include "whole_file.h"

namespace nade::io {
namespace {

constexpr const char* kProfileName = "umetrack_hand_user_profile.json";
constexpr const char* kMetadataName = "metadata.json";
/// Aria's cameras see the same moment some ten microseconds apart.
constexpr std::int64_t kSameMoment_ns = 1'000'000;
constexpr double kMostRadians = 10.0;

std::string beside(const std::string& path, const char* name) {
  return (std::filesystem::path(path).parent_path() / name).string();
}

/// The numbers of an array that must have at least so many.
template <std::size_t N>
std::optional<std::array<double, N>> numbers_of(const Json& object, const char* key, double most) {
  const auto list = object.is_object() ? object.find(key) : object.end();
  if (list == object.end() || !list->is_array() || list->size() < N) return std::nullopt;
  std::array<double, N> numbers{};
  for (std::size_t i = 0; i < N; ++i) {
    if (!(*list)[i].is_number()) return std::nullopt;
    numbers[i] = (*list)[i].get<double>();
    if (!(std::abs(numbers[i]) <= most)) return std::nullopt;
  }
  return numbers;
}

}  // namespace

Error Hot3dImport::wrong(const std::string& what) const {
  return {ErrorCode::bad_value, fmt::format("{}: expected {}", lines_.place(), what)};
}

Result<Hot3dImport> Hot3dImport::open(ByteSource source) {
  Hot3dImport import(std::move(source));
  import.header_.source = "hot3d";
  import.header_.hand_scale_known = true;
  return import;
}

Status Hot3dImport::read_model() {
  const std::string path = beside(name(), kProfileName);
  Result<UmetrackModel> model = read_umetrack_model(path);
  if (model) {
    model_ = std::move(model).value();
    return ok_status();
  }
  if (model.error().code != ErrorCode::not_found) return model.error();
  return Error{ErrorCode::not_found,
               fmt::format("{}: expected the hand that these angles bend beside it ({}), found no "
                           "such file",
                           name(), path)};
}

void Hot3dImport::learn_up() {
  const Result<std::string> text = read_whole(beside(name(), kMetadataName));
  const Result<Json> metadata = text ? parse_json(*text) : Result<Json>(text.error());
  const std::string headset =
      metadata && metadata->is_object() && metadata->value("headset", Json()).is_string()
          ? metadata->at("headset").get<std::string>()
          : "";
  if (headset == "Aria") {
    up_ = Eigen::AngleAxisd(-90.0 * kDegree, Vec3::UnitX());
  } else if (headset.empty()) {
    warnings_.add_once(Oddity::up_guessed,
                       fmt::format("{}: no {} beside it that names the headset; +Y is taken to be "
                                   "up, as of Quest 3 (of Aria it is +Z)",
                                   name(), kMetadataName));
  }
}

Result<std::optional<RecordedFrame>> Hot3dImport::next() {
  while (true) {
    const Result<std::optional<Json>> line = lines_.next(warnings_);
    if (!line) return line.error();
    if (!*line) return std::optional<RecordedFrame>();
    Result<RecordedFrame> frame = read_frame(**line);
    if (!frame) return frame.error();
    if (!last_time_ns_ || frame->time_ns - *last_time_ns_ >= kSameMoment_ns) {
      last_time_ns_ = frame->time_ns;
      return std::optional<RecordedFrame>(std::move(frame).value());
    }
    warnings_.add(Oddity::time_not_advancing,
                  fmt::format("{}: less than a millisecond after the frame before it; the frame is "
                              "left out",
                              lines_.place()));
  }
}

Result<RecordedFrame> Hot3dImport::read_frame(const Json& line) {
  const auto time = line.is_object() ? line.find("timestamp_ns") : line.end();
  if (time == line.end() || !time->is_number_integer()) return wrong("a whole \"timestamp_ns\"");
  RecordedFrame frame;
  frame.time_ns = time->get<std::int64_t>();
  if (std::abs(static_cast<double>(frame.time_ns)) > static_cast<double>(kLatest_ns)) {
    return wrong("a \"timestamp_ns\" within 126 years of 0");
  }
  const auto hands = line.find("hand_poses");
  if (hands == line.end() || !hands->is_object()) return wrong("an object \"hand_poses\"");
  for (const Handedness side : {Handedness::left, Handedness::right}) {
    const auto hand = hands->find(side == Handedness::left ? "0" : "1");
    if (hand == hands->end() || hand->is_null()) continue;
    const Status status = read_hand(*hand, side, frame);
    if (!status) return status.error();
  }
  return frame;
}

Status Hot3dImport::read_hand(const Json& hand, Handedness side, RecordedFrame& frame) {
  if (hand.is_object() && hand.contains("betas")) {
    return Error{ErrorCode::bad_format,
                 fmt::format("{}: expected UmeTrack's joint_angles, found a pose of MANO, whose "
                             "joints only that model gives, which may not be passed on; convert "
                             "umetrack_hand_pose_trajectory.jsonl, which lies beside it",
                             name())};
  }
  const auto angles = numbers_of<kUmetrackAngles>(hand, "joint_angles", kMostRadians);
  const Json wrist = hand.is_object() ? hand.value("wrist_xform", Json()) : Json();
  const auto position = numbers_of<3>(wrist, "t_xyz", kFarthest_m);
  const auto turn = numbers_of<4>(wrist, "q_wxyz", kLongestRotation);
  const Quat rotation =
      turn ? Quat((*turn)[0], (*turn)[1], (*turn)[2], (*turn)[3]) : Quat(0, 0, 0, 0);
  if (!angles || !position || !(rotation.norm() >= kShortestRotation)) {
    warnings_.add(Oddity::unusable_hand,
                  fmt::format("{}: {}: joint_angles or wrist_xform is missing or not as expected; "
                              "the hand is left out of the frame",
                              lines_.place(), name_of(side)));
    return ok_status();
  }
  if (!model_) {
    const Status status = read_model();
    if (!status) return status.error();
    learn_up();
  }
  const Pose place{{(*position)[0], (*position)[1], (*position)[2]}, rotation.normalized()};
  const LeapHand points = umetrack_hand(*model_, side, *angles, Pose{Vec3::Zero(), up_} * place);
  RecordedHand recorded;
  recorded.pose = hand_from_wrist_and_fingers(points);
  const auto confidence = hand.find("hand_confidence");
  if (confidence != hand.end() && confidence->is_number()) {
    recorded.pose.confidence = std::clamp(confidence->get<double>(), 0.0, 1.0);
  }
  if (!intake_.admit(recorded.pose, lines_.place(), warnings_)) return ok_status();
  frame.hands[index_of(side)] = std::move(recorded);
  return ok_status();
}

}  // namespace nade::io
