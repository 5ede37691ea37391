#include "recording_lines.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "recording_limits.h"
#include "recording_names.h"

namespace nade::io {
namespace {

constexpr std::size_t kWebxrJoints = kJointCount - 1;  // all but the palm
constexpr double kUnitTolerance = 1e-3;                // of the squared norm, as fault_of has it

/// A value of the object, taken out of it, so that what is left are the unknown keys.
std::optional<Json> take(Json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end()) return std::nullopt;
  Json value = std::move(*found);
  object.erase(found);
  return value;
}

std::optional<std::int64_t> whole_number(const Json& value) {
  constexpr double kLargestExact = 9007199254740992.0;  // 2^53
  if (value.is_number_unsigned()) {
    const auto number = value.get<std::uint64_t>();
    if (number > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max())) {
      return std::nullopt;
    }
    return static_cast<std::int64_t>(number);
  }
  if (value.is_number_integer()) return value.get<std::int64_t>();
  if (!value.is_number_float()) return std::nullopt;
  const double number = value.get<double>();
  if (std::abs(number) > kLargestExact || number != std::floor(number)) return std::nullopt;
  return static_cast<std::int64_t>(number);
}

/// The numbers of one joint. The error is a sentence without its place.
struct JointNumbers {
  std::array<double, kJointNumbers> at{};
  bool finite = true;
};
Result<JointNumbers> joint_numbers(const Json& joint) {
  if (!joint.is_array()) {
    return Error{ErrorCode::bad_value, fmt::format("expected 8 numbers, found {}", kind_of(joint))};
  }
  if (joint.size() != kJointNumbers) {
    return Error{ErrorCode::bad_value, fmt::format("expected 8 numbers, found {}", joint.size())};
  }
  JointNumbers numbers;
  for (std::size_t k = 0; k < kJointNumbers; ++k) {
    const Json& value = joint[k];
    if (value.is_number()) {
      numbers.at[k] = value.get<double>();
    } else if (value.is_null()) {
      numbers.finite = false;
    } else {
      return Error{ErrorCode::bad_value,
                   fmt::format("expected 8 numbers, found {} among them", kind_of(value))};
    }
    if (std::abs(numbers.at[k]) > kFarthest_m) {
      return Error{ErrorCode::bad_value,
                   fmt::format("expected numbers up to {}, found {}", kFarthest_m, numbers.at[k])};
    }
  }
  if (numbers.finite && numbers.at[7] < 0.0) {
    return Error{ErrorCode::bad_value,
                 fmt::format("expected a radius of 0 or more, found {}", numbers.at[7])};
  }
  return numbers;
}

std::optional<Vec3> vector_of(const std::optional<Json>& value) {
  if (!value || !value->is_array() || value->size() != 3) return std::nullopt;
  Vec3 result;
  for (std::size_t k = 0; k < 3; ++k) {
    if (!(*value)[k].is_number()) return std::nullopt;
    result[static_cast<Eigen::Index>(k)] = (*value)[k].get<double>();
  }
  return result;
}

Result<RecordedContact> contact_of(Json& object) {
  const std::optional<Vec3> point = vector_of(take(object, "point"));
  const std::optional<Vec3> normal = vector_of(take(object, "normal"));
  const std::optional<Json> depth = take(object, "depth");
  if (!point || !normal || !depth || !depth->is_number()) {
    return Error{ErrorCode::bad_value, "expected a point and a normal of 3 numbers and a depth"};
  }
  return RecordedContact{*point, *normal, depth->get<double>()};
}

/// Takes the known parts out of `contacts`; what is left are unknown keys.
Result<std::array<std::optional<RecordedContact>, kPartCount>> contacts_of(Json& contacts) {
  std::array<std::optional<RecordedContact>, kPartCount> result{};
  for (std::size_t p = 0; p < kPartCount; ++p) {
    const std::string name(name_of(part_at(p)));
    const auto found = contacts.find(name);
    if (found == contacts.end()) continue;
    if (!found->is_object()) {
      return Error{ErrorCode::bad_value,
                   fmt::format("{}: expected an object, found {}", name, kind_of(*found))};
    }
    const Result<RecordedContact> contact = contact_of(*found);
    if (!contact) {
      return Error{ErrorCode::bad_value, fmt::format("{}: {}", name, contact.error().message)};
    }
    result[p] = *contact;
    if (found->empty()) contacts.erase(found);
  }
  return result;
}

std::optional<HandStatus> status_from(const Json& value) {
  if (!value.is_string()) return std::nullopt;
  const auto found =
      std::find(kStatusNames.begin(), kStatusNames.end(), value.get_ref<const std::string&>());
  if (found == kStatusNames.end()) return std::nullopt;
  return static_cast<HandStatus>(found - kStatusNames.begin());
}

std::optional<Pose> head_of(const Json& value) {
  if (!value.is_array() || value.size() != 7) return std::nullopt;
  std::array<double, 7> n{};
  for (std::size_t i = 0; i < n.size(); ++i) {
    if (!value[i].is_number()) return std::nullopt;
    n[i] = value[i].get<double>();
  }
  Pose head{{n[0], n[1], n[2]}, Quat(n[6], n[3], n[4], n[5])};
  const double length = head.rotation.norm();
  if (!head.position.allFinite() || !(length >= kShortestRotation && length <= kLongestRotation)) {
    return std::nullopt;
  }
  if (std::abs(length * length - 1.0) > kUnitTolerance) head.rotation.coeffs() /= length;
  return head;
}

}  // namespace

std::string RecordingLines::place() const {
  return fmt::format("{}: line {}", source_.name(), line_);
}

Error RecordingLines::bad_value(const std::string& sentence) const {
  return {ErrorCode::bad_value, fmt::format("{}: {}", place(), sentence)};
}

Result<RecordingLines> RecordingLines::open(ByteSource source) {
  RecordingLines lines(std::move(source));
  const Status status = lines.read_header();
  if (!status) return status.error();
  return lines;
}

Result<std::optional<Json>> RecordingLines::next_json() {
  while (const std::optional<Line> line = source_.read_line()) {
    ++line_;
    if (line->text.find_first_not_of(" \t\r") == std::string_view::npos) continue;
    Result<Json> json = parse_json(line->text);
    if (json) return std::optional<Json>(std::move(json).value());
    if (!line->terminated) {
      warnings_.add(Oddity::cut_off,
                    fmt::format("{}: cut off here; the line is left out", place()));
      return std::optional<Json>();
    }
    return Error{json.error().code, fmt::format("{}: {}", place(), json.error().message)};
  }
  if (source_.failure()) return *source_.failure();
  if (source_.cut_off()) {
    warnings_.add(Oddity::cut_off, fmt::format("{}: cut off after this line", place()));
  }
  return std::optional<Json>();
}

Status RecordingLines::read_header() {
  Result<std::optional<Json>> line = next_json();
  if (!line) return line.error();
  if (!*line || !(*line)->is_object()) {
    return Error{ErrorCode::bad_format,
                 fmt::format("{}: line {}: expected a recording's header, found none",
                             source_.name(), std::max(line_, std::size_t{1}))};
  }
  Json object = std::move(**line);
  const Json format = take(object, "format").value_or(Json());
  if (!format.is_string() || format.get_ref<const std::string&>() != kFormatName) {
    return Error{ErrorCode::bad_format, fmt::format("{}: expected the format \"{}\", found {}",
                                                    place(), kFormatName, format.dump())};
  }
  const Json version = take(object, "version").value_or(Json());
  if (version != kFormatVersion) {
    return Error{ErrorCode::bad_format,
                 fmt::format("{}: expected version {} of {}, found {}", place(), kFormatVersion,
                             kFormatName, version.is_null() ? "none" : version.dump())};
  }
  for (const char* key : {"source", "created"}) {
    const std::optional<Json> text = take(object, key);
    if (!text) continue;
    if (!text->is_string()) {
      return bad_value(fmt::format("{}: expected a string, found {}", key, kind_of(*text)));
    }
    (key == std::string_view("source") ? header_.source : header_.created) =
        text->get<std::string>();
  }
  if (const std::optional<Json> known = take(object, "hand_scale_known")) {
    if (!known->is_boolean()) {
      return bad_value(
          fmt::format("hand_scale_known: expected true or false, found {}", kind_of(*known)));
    }
    header_.hand_scale_known = known->get<bool>();
  }
  header_.unknown_json = unknown_text(object);
  return ok_status();
}

Result<std::optional<RecordedFrame>> RecordingLines::next() {
  Result<std::optional<Json>> line = next_json();
  if (!line) return line.error();
  if (!*line) return std::optional<RecordedFrame>();
  if (!(*line)->is_object()) {
    return bad_value(fmt::format("expected a frame, found {}", kind_of(**line)));
  }
  Result<RecordedFrame> frame = read_frame(std::move(**line));
  if (!frame) return frame.error();
  return std::optional<RecordedFrame>(std::move(frame).value());
}

Result<RecordedFrame> RecordingLines::read_frame(Json object) {
  RecordedFrame frame;
  const std::optional<Json> time = take(object, "t");
  const std::optional<std::int64_t> time_ns = time ? whole_number(*time) : std::nullopt;
  if (!time_ns) {
    return bad_value(fmt::format("t: expected a time in whole nanoseconds, found {}",
                                 time ? time->dump() : "none"));
  }
  if (*time_ns < -kLatest_ns || *time_ns > kLatest_ns) {
    return bad_value(
        fmt::format("t: expected a time up to {} ns from 0, found {}", kLatest_ns, *time_ns));
  }
  if (last_time_ns_ && *time_ns <= *last_time_ns_) {
    return bad_value(
        fmt::format("t: expected a time after {}, found {}", *last_time_ns_, *time_ns));
  }
  frame.time_ns = *time_ns;
  for (const Handedness side : {Handedness::left, Handedness::right}) {
    const std::string key(name_of(side));
    std::optional<Json> given = take(object, key.c_str());
    if (!given || given->is_null()) continue;
    if (!given->is_object()) {
      return bad_value(fmt::format("{}: expected a hand, found {}", key, kind_of(*given)));
    }
    Result<std::optional<RecordedHand>> hand = read_hand(std::move(*given), side);
    if (!hand) return hand.error();
    frame.hands[index_of(side)] = std::move(*hand);
  }
  if (const std::optional<Json> head = take(object, "head"); head && !head->is_null()) {
    frame.head = head_of(*head);
    if (!frame.head) {
      return bad_value(fmt::format(
          "head: expected 7 numbers, a position and a rotation of unit length, found {}",
          head->is_array() && head->size() != 7 ? std::to_string(head->size()) : head->dump()));
    }
  }
  frame.unknown_json = unknown_text(object);
  last_time_ns_ = time_ns;
  return frame;
}

Error RecordingLines::wrong_count(Handedness side, const std::string& found) const {
  return bad_value(
      fmt::format("{}: joints: expected {} joints, found {}", name_of(side), kJointCount, found));
}

/// A joint with a number that is not finite is not finite as a whole.
Status RecordingLines::read_joints(const Json& joints, HandPose& pose) {
  const std::size_t first = kJointCount - joints.size();
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const Result<JointNumbers> numbers = joint_numbers(joints[i]);
    if (!numbers) {
      return bad_value(
          fmt::format("{}: joint {}: {}", name_of(pose.side), i, numbers.error().message));
    }
    const auto& n = numbers->at;
    Pose& joint = pose.joints[first + i];
    joint.position = {n[0], n[1], n[2]};
    joint.rotation = Quat(n[6], n[3], n[4], n[5]);
    pose.radius[first + i] = n[7];
    if (!numbers->finite) joint.position.setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  if (first == 0) return ok_status();
  pose[Joint::palm] = palm_from_middle_metacarpal(pose);
  // Another joint than the palm may be the one that is missing.
  if (check_hand(pose).has(HandDoubt::length)) return wrong_count(pose.side, "25");
  warnings_.add(Oddity::palm_missing,
                fmt::format("{}: {}: {} joints, taken for those of WebXR: the palm is put in the "
                            "middle of the middle metacarpal",
                            place(), name_of(pose.side), joints.size()));
  return ok_status();
}

Result<std::optional<RecordedHand>> RecordingLines::read_hand(Json object, Handedness side) {
  const std::string_view hand_name = name_of(side);
  RecordedHand hand;
  hand.pose.side = side;
  const Json joints = take(object, "joints").value_or(Json());
  if (!joints.is_array()) {
    return wrong_count(hand.pose.side, joints.is_null() ? "none" : kind_of(joints));
  }
  if (joints.size() != kJointCount && joints.size() != kWebxrJoints) {
    return wrong_count(hand.pose.side, std::to_string(joints.size()));
  }
  const Status read = read_joints(joints, hand.pose);
  if (!read) return read.error();
  if (const std::optional<Json> confidence = take(object, "confidence")) {
    const double value = confidence->is_number() ? confidence->get<double>() : -1.0;
    if (!(value >= 0.0 && value <= 1.0)) {
      return bad_value(fmt::format("{}: confidence: expected a number from 0 to 1, found {}",
                                   hand_name, confidence->dump()));
    }
    hand.pose.confidence = value;
  }
  if (const std::optional<Json> status = take(object, "status")) {
    hand.status = status_from(*status);
    if (!hand.status) {
      return bad_value(fmt::format("{}: status: expected {}, found {}", hand_name,
                                   fmt::join(kStatusNames, " or "), status->dump()));
    }
  }
  if (const auto contact = object.find("contact"); contact != object.end()) {
    if (!contact->is_object()) {
      return bad_value(
          fmt::format("{}: contact: expected an object, found {}", hand_name, kind_of(*contact)));
    }
    auto contacts = contacts_of(*contact);
    if (!contacts) {
      return bad_value(fmt::format("{}: contact: {}", hand_name, contacts.error().message));
    }
    hand.contact = *contacts;
    if (contact->empty()) object.erase(contact);
  }
  if (!intake_.admit(hand.pose, place(), warnings_)) return std::optional<RecordedHand>();
  hand.unknown_json = unknown_text(object);
  return std::optional<RecordedHand>(std::move(hand));
}

}  // namespace nade::io
