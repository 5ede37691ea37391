#include "webxr_dump_import.h"

#include <fmt/format.h>

#include "frame_time.h"
#include "webxr_dump_hand.h"

namespace nade::io {
namespace {

/// Of performance.now and of the time that a page's frame callback gets.
constexpr double kPageTime_ns = 1e6;

}  // namespace

Result<WebxrDumpImport> WebxrDumpImport::open(ByteSource source) {
  Result<FrameStream> frames = FrameStream::open(
      std::move(source), [](const std::string&, const Json&) { return ok_status(); });
  if (!frames) return frames.error();
  return WebxrDumpImport(std::move(frames).value());
}

Result<std::optional<RecordedFrame>> WebxrDumpImport::next() {
  while (true) {
    const Result<std::optional<Json>> json = frames_.next(warnings_);
    if (!json) return json.error();
    if (!*json) return std::optional<RecordedFrame>();
    if (!(*json)->is_object()) {
      return Error{ErrorCode::bad_value,
                   fmt::format("{}: expected a frame, found {}", place(), kind_of(**json))};
    }
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

Result<RecordedFrame> WebxrDumpImport::read_frame(const Json& frame) {
  Result<std::optional<FrameTime>> time = time_of_frame(frame, place());
  if (!time) return time.error();
  if (!*time) {
    return Error{ErrorCode::bad_value,
                 fmt::format("{}: expected a \"time\" in milliseconds, found none", place())};
  }
  if ((*time)->unit_ns == 0.0) (*time)->unit_ns = kPageTime_ns;
  const Result<std::int64_t> time_ns = nanoseconds_of(**time, place());
  if (!time_ns) return time_ns.error();
  RecordedFrame result;
  result.time_ns = *time_ns;
  const auto hands = frame.find("hands");
  if (hands != frame.end() && hands->is_array()) {
    const Status status = read_listed_hands(*hands, result);
    if (!status) return status.error();
    return result;
  }
  const bool in_hands = hands != frame.end() && hands->is_object();
  const Json& by_side = in_hands ? *hands : frame;
  for (const Handedness side : {Handedness::left, Handedness::right}) {
    const std::string key(name_of(side));
    const auto hand = by_side.find(key);
    if (hand == by_side.end()) continue;
    const Status status = read_hand(*hand, side, (in_hands ? "hands." : "") + key, result);
    if (!status) return status.error();
  }
  return result;
}

Status WebxrDumpImport::read_listed_hands(const Json& hands, RecordedFrame& frame) {
  for (std::size_t i = 0; i < hands.size(); ++i) {
    if (hands[i].is_null()) continue;
    const std::string where = fmt::format("hands[{}]", i);
    const Json side = hands[i].is_object() ? hands[i].value("handedness", Json()) : Json();
    // A source that is neither is no hand.
    if (side == "none") continue;
    if (side != "left" && side != "right") {
      return Error{ErrorCode::bad_value,
                   fmt::format("{}: {}: handedness: expected \"left\" or \"right\", found {}",
                               place(), where, side.is_null() ? "none" : side.dump())};
    }
    const Status status =
        read_hand(hands[i], side == "left" ? Handedness::left : Handedness::right, where, frame);
    if (!status) return status;
  }
  return ok_status();
}

Status WebxrDumpImport::read_hand(const Json& hand, Handedness side, const std::string& where,
                                  RecordedFrame& frame) {
  if (hand.is_null()) return ok_status();
  std::string missing;
  const std::string hand_place = fmt::format("{}: {}", place(), where);
  Result<std::optional<HandPose>> pose = hand_of_page(hand, side, hand_place, missing);
  if (!pose) return pose.error();
  if (!*pose) {
    warnings_.add(Oddity::unusable_hand,
                  fmt::format("{}: {} is missing or has no finite position and rotation; the hand "
                              "is left out of the frame",
                              hand_place, missing));
    return ok_status();
  }
  RecordedHand recorded;
  recorded.pose = **pose;
  if (!intake_.admit(recorded.pose, place(), warnings_)) return ok_status();
  std::optional<RecordedHand>& place_in_frame = frame.hands[index_of(side)];
  if (place_in_frame) {
    warnings_.add(Oddity::hand_twice,
                  fmt::format("{}: two {} hands; the second is left out", place(), name_of(side)));
    return ok_status();
  }
  place_in_frame = std::move(recorded);
  return ok_status();
}

}  // namespace nade::io
