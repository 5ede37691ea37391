#include "webxr_import.h"

// Based on: Meta Platforms. Immersive Web Emulation Runtime (IWER) 2.5.0, ActionRecorder. (the
// layout of the file)

#include <fmt/format.h>

#include <cmath>

#include "recording_limits.h"

namespace nade::io {
namespace {

constexpr double kNanosecondsPerMillisecond = 1e6;
constexpr std::size_t kPoseNumbers = 7;
constexpr std::size_t kFrameInputs = 1 + kPoseNumbers;  // after the time and the viewer's pose
constexpr std::size_t kInputParts = 1 + kPoseNumbers;   // after the index and the target ray

/// A pose from seven numbers of the array; none where one is not finite or the four of the
/// rotation are none. They are rounded to three decimals, so the rotation is made unit again.
std::optional<Pose> pose_at(const Json& array, std::size_t first) {
  std::array<double, kPoseNumbers> n{};
  for (std::size_t k = 0; k < kPoseNumbers; ++k) {
    const Json& value = array[first + k];
    if (!value.is_number()) return std::nullopt;
    n[k] = value.get<double>();
  }
  Quat rotation(n[6], n[3], n[4], n[5]);
  const double norm = rotation.norm();
  if (!(norm >= kShortestRotation && norm <= kLongestRotation)) return std::nullopt;
  rotation.coeffs() /= norm;
  return Pose{{n[0], n[1], n[2]}, rotation};
}

bool is_true(const Json& object, const char* key) { return object.value(key, Json()) == true; }

/// The WebXR joints in their own order: ours without the palm.
template <std::size_t N>
std::array<Joint, N> standard_sequence() {
  std::array<Joint, N> result{};
  for (std::size_t i = 0; i < N; ++i) result[i] = joint_at(i + 1);
  return result;
}

/// Puts the joints of the array, relative to the target ray, into `pose`; false where one cannot
/// be used.
template <std::size_t N>
bool read_joints(const Json& numbers, const std::array<Joint, N>& sequence, const Pose& target_ray,
                 HandPose& pose) {
  for (std::size_t i = 0; i < N; ++i) {
    const std::optional<Pose> joint = pose_at(numbers, i * kJointNumbers);
    const Json& radius = numbers[i * kJointNumbers + kPoseNumbers];
    if (!joint || !radius.is_number()) return false;
    pose[sequence[i]] = target_ray * *joint;
    pose.radius[index_of(sequence[i])] = std::max(radius.get<double>(), 0.0);
  }
  pose[Joint::palm] = palm_from_middle_metacarpal(pose);
  return true;
}

}  // namespace

WebxrImport::WebxrImport(ByteSource source) : frames_(std::move(source)) {
  header_.source = "webxr";
}

Result<WebxrImport> WebxrImport::open(ByteSource source) {
  WebxrImport import(std::move(source));
  const Status status = import.frames_.enter([&](const std::string& key, const Json& value) {
    return key == "schema" ? import.read_schema(value) : ok_status();
  });
  if (!status) return status.error();
  if (!import.has_schema_) {
    return Error{ErrorCode::bad_format,
                 fmt::format("{}: expected \"schema\" before \"frames\", as IWER's ActionRecorder "
                             "writes them, found \"frames\" first",
                             import.frames_.name())};
  }
  return import;
}

Status WebxrImport::read_schema(const Json& schema) {
  has_schema_ = true;
  if (!schema.is_array()) {
    return Error{ErrorCode::bad_format, fmt::format("{}: schema: expected an array, found {}",
                                                    frames_.name(), kind_of(schema))};
  }
  for (std::size_t i = 0; i < schema.size(); ++i) {
    const std::string where = fmt::format("{}: schema[{}]", frames_.name(), i);
    const Json& entry = schema[i];
    if (!entry.is_array() || entry.size() != 2 || !entry[0].is_number_integer() ||
        !entry[1].is_object()) {
      return Error{ErrorCode::bad_format,
                   fmt::format("{}: expected an index and an input source's fields", where)};
    }
    Result<InputSchema> input = input_schema(entry[1], where);
    if (!input) return input.error();
    inputs_[entry[0].get<std::int64_t>()] = *input;
  }
  return ok_status();
}

Result<WebxrImport::InputSchema> WebxrImport::input_schema(const Json& fields,
                                                           const std::string& where) const {
  InputSchema input;
  const Json side = fields.value("handedness", Json());
  if (side == "left") input.side = Handedness::left;
  if (side == "right") input.side = Handedness::right;
  input.has_grip = is_true(fields, "hasGrip");
  if (!is_true(fields, "hasHand")) return input;
  input.joints = standard_sequence<kWebxrJoints>();
  const auto sequence = fields.find("jointSequence");
  if (sequence == fields.end()) return input;
  if (!sequence->is_array() || sequence->size() != kWebxrJoints) {
    return Error{ErrorCode::bad_value,
                 fmt::format("{}: jointSequence: expected {} joint names", where, kWebxrJoints)};
  }
  std::array<bool, kJointCount> named{};
  for (std::size_t i = 0; i < kWebxrJoints; ++i) {
    const Json& name = (*sequence)[i];
    const std::optional<Joint> joint =
        name.is_string() ? joint_from_webxr_name(name.get<std::string>()) : std::nullopt;
    if (!joint || *joint == Joint::palm) {
      return Error{ErrorCode::bad_value,
                   fmt::format("{}: jointSequence[{}]: expected the name of a WebXR joint, found "
                               "{}",
                               where, i, name.dump())};
    }
    if (named[index_of(*joint)]) {
      return Error{ErrorCode::bad_value,
                   fmt::format("{}: jointSequence[{}]: expected each joint once, found {} again",
                               where, i, name.dump())};
    }
    named[index_of(*joint)] = true;
    (*input.joints)[i] = *joint;
  }
  return input;
}

Result<std::optional<RecordedFrame>> WebxrImport::next() {
  while (true) {
    const Result<std::optional<Json>> json = frames_.next(warnings_);
    if (!json) return json.error();
    if (!*json) return std::optional<RecordedFrame>();
    Result<RecordedFrame> frame = read_frame(**json);
    if (!frame) return frame.error();
    if (last_time_ns_ && frame->time_ns <= *last_time_ns_) {
      warnings_.add(Oddity::time_not_advancing,
                    fmt::format("{}: the time does not advance; the frame is left out", place()));
      continue;
    }
    last_time_ns_ = frame->time_ns;
    return std::optional<RecordedFrame>(std::move(frame).value());
  }
}

Result<RecordedFrame> WebxrImport::read_frame(const Json& frame) {
  if (!frame.is_array() || frame.size() < kFrameInputs) {
    return Error{ErrorCode::bad_value,
                 fmt::format("{}: expected a time, the viewer's pose of 7 numbers and the input "
                             "sources",
                             place())};
  }
  if (!frame[0].is_number() || !(std::abs(frame[0].get<double>()) * kNanosecondsPerMillisecond <
                                 static_cast<double>(kLatest_ns))) {
    return Error{ErrorCode::bad_value, fmt::format("{}: expected a time in milliseconds, found {}",
                                                   place(), frame[0].dump())};
  }
  RecordedFrame result;
  result.time_ns = std::llround(frame[0].get<double>() * kNanosecondsPerMillisecond);
  for (std::size_t i = kFrameInputs; i < frame.size(); ++i) {
    const Status status = read_input(frame[i], i, result);
    if (!status) return status.error();
  }
  return result;
}

Status WebxrImport::read_input(const Json& input, std::size_t element, RecordedFrame& result) {
  const auto error = [&](const std::string& sentence) {
    return Error{ErrorCode::bad_value, fmt::format("{}[{}]: {}", place(), element, sentence)};
  };
  if (!input.is_array() || input.size() < kInputParts || !input[0].is_number_integer()) {
    return error("expected an input source's index and its target ray of 7 numbers");
  }
  const auto schema = inputs_.find(input[0].get<std::int64_t>());
  if (schema == inputs_.end()) {
    return error(fmt::format("expected an index of the schema, found {}", input[0].dump()));
  }
  if (!schema->second.joints || !schema->second.side) return ok_status();
  const std::size_t part = kInputParts + (schema->second.has_grip ? 1 : 0);
  const std::size_t expected = kWebxrJoints * kJointNumbers;
  if (input.size() <= part || !input[part].is_array() || input[part].size() != expected) {
    return error(fmt::format("expected {} numbers of a hand, found {}", expected,
                             input.size() <= part ? "none" : std::to_string(input[part].size())));
  }
  const Handedness side = *schema->second.side;
  RecordedHand hand;
  hand.pose.side = side;
  const std::optional<Pose> target_ray = pose_at(input, 1);
  if (!target_ray || !read_joints(input[part], *schema->second.joints, *target_ray, hand.pose)) {
    warnings_.add(Oddity::unusable_hand,
                  fmt::format("{}: {}: a joint is not finite or not turned by a rotation; the hand "
                              "is left out of the frame",
                              place(), name_of(side)));
    return ok_status();
  }
  if (!intake_.admit(hand.pose, place(), warnings_)) return ok_status();
  std::optional<RecordedHand>& place_in_frame = result.hands[index_of(side)];
  if (place_in_frame) {
    warnings_.add(Oddity::hand_twice,
                  fmt::format("{}: two {} hands; the second is left out", place(), name_of(side)));
    return ok_status();
  }
  place_in_frame = std::move(hand);
  return ok_status();
}

}  // namespace nade::io
