#include "leap_import.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "recording_limits.h"

namespace nade::io {
namespace {

constexpr double kMetresPerMillimetre = 1e-3;
constexpr double kNanosecondsPerMicrosecond = 1e3;

std::optional<double> finite_number(const Json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_number()) return std::nullopt;
  return found->get<double>();
}

std::optional<Vec3> vector_of(const Json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_array() || found->size() != 3) return std::nullopt;
  Vec3 result;
  for (std::size_t k = 0; k < 3; ++k) {
    if (!(*found)[k].is_number()) return std::nullopt;
    result[static_cast<Eigen::Index>(k)] = (*found)[k].get<double>();
  }
  return result;
}

std::optional<Vec3> position_of(const Json& object, const char* key) {
  const std::optional<Vec3> millimetres = vector_of(object, key);
  if (!millimetres) return std::nullopt;
  return Vec3(kMetresPerMillimetre * *millimetres);
}

std::optional<LeapFinger> finger_of(const Json& pointable) {
  const auto mcp = position_of(pointable, "mcpPosition");
  const auto pip = position_of(pointable, "pipPosition");
  const auto dip = position_of(pointable, "dipPosition");
  const auto tip = position_of(pointable, "tipPosition");
  if (!mcp || !pip || !dip || !tip) return std::nullopt;
  return LeapFinger{*mcp, *pip, *dip, *tip};
}

/// Which finger a pointable is. Packed frames have no word of it but in the ids: ten times the
/// hand's, and the finger's number.
std::optional<double> type_of(const Json& pointable) {
  const std::optional<double> type = finite_number(pointable, "type");
  const std::optional<double> id = finite_number(pointable, "id");
  const std::optional<double> hand = finite_number(pointable, "handId");
  if (type || !id || !hand) return type;
  return *id - 10.0 * *hand;
}

/// The fingers of the hand with this id; none where one of the five is missing.
std::optional<std::array<LeapFinger, kDigitCount>> fingers_of(const Json& frame, const Json& id) {
  std::array<std::optional<LeapFinger>, kDigitCount> found{};
  const auto pointables = frame.find("pointables");
  if (pointables == frame.end() || !pointables->is_array()) return std::nullopt;
  for (const Json& pointable : *pointables) {
    if (!pointable.is_object() || pointable.value("handId", Json()) != id) continue;
    const std::optional<double> type = type_of(pointable);
    if (!type || !(*type >= 0.0) || !(*type < double{kDigitCount})) continue;
    found[static_cast<std::size_t>(*type)] = finger_of(pointable);
  }
  std::array<LeapFinger, kDigitCount> fingers;
  for (std::size_t i = 0; i < kDigitCount; ++i) {
    if (!found[i]) return std::nullopt;
    fingers[i] = *found[i];
  }
  return fingers;
}

/// An object of a packed frame, a list of such, or what is no array as it is: `keys` are names, or
/// objects of one name with the keys of its value; keys in an array of their own are those of every
/// element.
Json unpacked(const Json& keys, Json& values) {
  if (!values.is_array() || !keys.is_array()) return std::move(values);
  if (!keys.empty() && keys.front().is_array()) {
    Json list = Json::array();
    for (Json& value : values) list.push_back(unpacked(keys.front(), value));
    return list;
  }
  Json object = Json::object();
  for (std::size_t i = 0; i < std::min(keys.size(), values.size()); ++i) {
    const Json& key = keys[i];
    if (key.is_string()) object[key.get<std::string>()] = std::move(values[i]);
    if (!key.is_object() || key.empty()) continue;
    object[key.begin().key()] = unpacked(key.begin().value(), values[i]);
  }
  return object;
}

std::optional<Handedness> side_of(const Json& hand) {
  const Json type = hand.value("type", Json());
  if (type == "left") return Handedness::left;
  if (type == "right") return Handedness::right;
  return std::nullopt;
}

}  // namespace

LeapImport::LeapImport(ByteSource source) : frames_(std::move(source)) {
  header_.source = "leap";
  header_.hand_scale_known = true;
}

Result<LeapImport> LeapImport::open(ByteSource source) {
  LeapImport import(std::move(source));
  const Status status =
      import.frames_.enter([](const std::string&, const Json&) { return ok_status(); });
  if (!status) return status.error();
  return import;
}

std::string LeapImport::place() const { return frames_.place(); }

void LeapImport::leave_out(Oddity oddity, const std::string& what) {
  warnings_.add(oddity, fmt::format("{}: {}", place(), what));
}

Result<std::optional<Json>> LeapImport::next_frame() {
  Result<std::optional<Json>> json = frames_.next(warnings_);
  if (!json || !*json || !(*json)->is_array()) return json;
  if (!keys_) {
    keys_ = std::move(**json);
    return next_frame();
  }
  return std::optional<Json>(unpacked(*keys_, **json));
}

Result<std::optional<RecordedFrame>> LeapImport::next() {
  while (true) {
    const Result<std::optional<Json>> json = next_frame();
    if (!json) return json.error();
    if (!*json) return std::optional<RecordedFrame>();
    if (!(*json)->is_object()) {
      return Error{ErrorCode::bad_value,
                   fmt::format("{}: expected a frame, found {}", place(), kind_of(**json))};
    }
    Result<RecordedFrame> frame = read_frame(**json);
    if (!frame) return frame.error();
    if (last_time_ns_ && frame->time_ns <= *last_time_ns_) {
      leave_out(Oddity::time_not_advancing, "the time does not advance; the frame is left out");
      continue;
    }
    last_time_ns_ = frame->time_ns;
    return std::optional<RecordedFrame>(std::move(frame).value());
  }
}

Result<RecordedFrame> LeapImport::read_frame(const Json& frame) {
  RecordedFrame result;
  const auto hands = frame.find("hands");
  if (hands == frame.end()) {
    return Error{
        ErrorCode::bad_format,
        fmt::format("{}: expected the \"hands\" of a raw LeapJS frame, found none", place())};
  }
  const std::optional<double> time_us = finite_number(frame, "timestamp");
  if (!time_us ||
      !(std::abs(*time_us) * kNanosecondsPerMicrosecond < static_cast<double>(kLatest_ns))) {
    return Error{ErrorCode::bad_value,
                 fmt::format("{}: timestamp: expected a time in microseconds, found {}", place(),
                             frame.contains("timestamp") ? frame["timestamp"].dump() : "none")};
  }
  result.time_ns = std::llround(*time_us * kNanosecondsPerMicrosecond);
  if (!hands->is_array()) {
    return Error{ErrorCode::bad_value,
                 fmt::format("{}: hands: expected an array, found {}", place(), kind_of(*hands))};
  }
  for (std::size_t i = 0; i < hands->size(); ++i) {
    const Status status = read_hand(frame, i, result);
    if (!status) return status.error();
  }
  return result;
}

Status LeapImport::read_hand(const Json& frame, std::size_t hand_index, RecordedFrame& result) {
  const Json& hand = frame["hands"][hand_index];
  const std::optional<Handedness> side =
      hand.is_object() ? side_of(hand) : std::optional<Handedness>();
  if (!side) {
    return Error{ErrorCode::bad_value,
                 fmt::format("{}: hands[{}]: type: expected \"left\" or \"right\", as a Leap "
                             "Motion v2 writes it",
                             place(), hand_index)};
  }
  const auto palm = position_of(hand, "palmPosition");
  const auto normal = vector_of(hand, "palmNormal");
  const auto direction = vector_of(hand, "direction");
  const auto fingers = fingers_of(frame, hand.value("id", Json()));
  if (!fingers) {
    leave_out(Oddity::finger_missing,
              fmt::format("{}: one of the five fingers is missing or not finite; the hand is left "
                          "out of the frame",
                          name_of(*side)));
    return ok_status();
  }
  RecordedHand recorded;
  if (!palm || !normal || !direction) {
    leave_out(Oddity::unusable_hand,
              fmt::format("{}: the palm is not finite; the hand is left out of the frame",
                          name_of(*side)));
    return ok_status();
  }
  const double confidence = finite_number(hand, "confidence").value_or(1.0);
  recorded.pose = hand_from_leap(
      {*side, *palm, *normal, *direction, std::clamp(confidence, 0.0, 1.0), *fingers});
  if (!intake_.admit(recorded.pose, place(), warnings_)) return ok_status();
  std::optional<RecordedHand>& place_in_frame = result.hands[index_of(*side)];
  if (place_in_frame) {
    leave_out(Oddity::hand_twice,
              fmt::format("two {} hands; the one of less confidence is left out", name_of(*side)));
    if (place_in_frame->pose.confidence >= recorded.pose.confidence) return ok_status();
  }
  place_in_frame = std::move(recorded);
  return ok_status();
}

}  // namespace nade::io
