#include "mediapipe_import.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace nade::io {
namespace {

/// Some seconds: the median over them hardly depends on how the hand is held.
constexpr std::size_t kFramesAhead = 256;
constexpr double kFrameWithoutTime_ns = 1e9 / 30.0;
/// Of a hand in heights of its picture; a hand seen along its length is some hundredths wide.
constexpr double kSmallestSpread = 1e-4;
constexpr double kAspectWithoutSize = 4.0 / 3.0;
/// From the camera to the palm: an arm's length for one on a desk.
constexpr double kGuessedDepth_m = 0.5;

}  // namespace

MediapipeImport::MediapipeImport(FrameStream frames, std::optional<double> aspect)
    : frames_(std::move(frames)), file_aspect_(aspect) {
  header_.source = "mediapipe";
}

Result<MediapipeImport> MediapipeImport::open(ByteSource source) {
  Json around = Json::object();
  Result<FrameStream> frames =
      FrameStream::open(std::move(source), [&](const std::string& key, const Json& value) {
        if (value.is_number()) around[key] = value;
        return ok_status();
      });
  if (!frames) return frames.error();
  return MediapipeImport(std::move(frames).value(), aspect_of_picture(around));
}

Result<std::optional<RecordedFrame>> MediapipeImport::next() {
  while (true) {
    read_ahead();
    if (ahead_.empty()) {
      if (error_) return *error_;
      return std::optional<RecordedFrame>();
    }
    if (unit_ns_ == 0.0) learn_unit();
    Ahead ahead = std::move(ahead_.front());
    ahead_.pop_front();
    if (ahead.time.unit_ns == 0.0) ahead.time.unit_ns = unit_ns_;
    const Result<std::int64_t> time_ns = nanoseconds_of(ahead.time, ahead.place);
    if (!time_ns) return time_ns.error();
    if (last_time_ns_ && *time_ns <= *last_time_ns_) {
      warnings_.add(
          Oddity::time_not_advancing,
          fmt::format("{}: the time does not advance; the frame is left out", ahead.place));
      continue;
    }
    last_time_ns_ = *time_ns;
    RecordedFrame frame;
    frame.time_ns = *time_ns;
    for (const Handedness side : {Handedness::left, Handedness::right}) {
      if (ahead.hands[index_of(side)]) take_hand(side, ahead, frame);
    }
    return std::optional<RecordedFrame>(std::move(frame));
  }
}

void MediapipeImport::read_ahead() {
  while (!at_end_ && ahead_.size() < kFramesAhead) {
    Result<std::optional<Ahead>> frame = read_frame();
    if (!frame) error_ = frame.error();
    at_end_ = !frame || !*frame;
    if (!at_end_) ahead_.push_back(std::move(**frame));
  }
}

Result<std::optional<MediapipeImport::Ahead>> MediapipeImport::read_frame() {
  const Result<std::optional<Json>> json = frames_.next(warnings_);
  if (!json) return json.error();
  if (!*json) return std::optional<Ahead>();
  const std::string place = frames_.place();
  if (!(*json)->is_object()) {
    return Error{ErrorCode::bad_value, fmt::format("{}: expected a result of MediaPipe, found {}",
                                                   place, kind_of(**json))};
  }
  const Result<FrameTime> time = time_of(**json);
  if (!time) return time.error();
  Result<LandmarkHands> hands = hands_of_result(**json, place, warnings_);
  if (!hands) return hands.error();
  ++read_;
  return std::optional<Ahead>({place, *time, aspect_of(**json, *hands), *hands});
}

Result<FrameTime> MediapipeImport::time_of(const Json& frame) {
  const std::string place = frames_.place();
  const Result<std::optional<FrameTime>> time = time_of_frame(frame, place);
  if (!time) return time.error();
  if (read_ == 0 && !*time) {
    timed_ = false;
    warnings_.add(
        Oddity::time_missing,
        fmt::format("{}: no time, as \"timestampMs\"; 30 frames a second are assumed", place));
  }
  if (!timed_) return FrameTime{kFrameWithoutTime_ns * static_cast<double>(read_), 1.0};
  if (*time) return **time;
  return Error{ErrorCode::bad_value,
               fmt::format("{}: expected a time, as the frames before have, found none", place)};
}

double MediapipeImport::aspect_of(const Json& frame, const LandmarkHands& hands) {
  if (const std::optional<double> aspect = aspect_of_picture(frame)) return *aspect;
  if (file_aspect_) return *file_aspect_;
  if (std::any_of(hands.begin(), hands.end(),
                  [](const auto& hand) { return hand && hand->picture; })) {
    warnings_.add(Oddity::picture_size_missing,
                  fmt::format("{}: no width and height of the picture; it is taken to be 4 to 3",
                              frames_.place()));
  }
  return kAspectWithoutSize;
}

void MediapipeImport::learn_unit() {
  std::vector<double> times;
  for (const Ahead& ahead : ahead_) times.push_back(ahead.time.value);
  unit_ns_ = unit_by_steps(times);
}

void MediapipeImport::learn_hand(Handedness side, const Ahead& first) {
  std::vector<Landmarks> shapes;
  const auto add = [&](const Ahead& ahead) {
    const auto& hand = ahead.hands[index_of(side)];
    const auto shape = hand ? shape_of(*hand, ahead.aspect) : std::nullopt;
    if (shape) shapes.push_back(*shape);
  };
  add(first);
  for (const Ahead& ahead : ahead_) add(ahead);
  bones_[index_of(side)] = bones_of(shapes);
}

void MediapipeImport::learn_picture(Handedness side, const Ahead& first) {
  std::vector<double> heights_m;
  const auto add = [&](const Ahead& ahead) {
    const auto& hand = ahead.hands[index_of(side)];
    if (!hand || !hand->picture) return;
    const auto shape = shape_of(*hand, ahead.aspect);
    const double seen = spread_across(in_heights(*hand->picture, ahead.aspect));
    if (!shape || !(seen > kSmallestSpread)) return;
    heights_m.push_back(spread_across(with_bones(*shape, *bones_[index_of(side)])) / seen);
  };
  add(first);
  for (const Ahead& ahead : ahead_) add(ahead);
  if (!heights_m.empty()) height_m_ = median_of(heights_m);
}

void MediapipeImport::take_hand(Handedness side, const Ahead& ahead, RecordedFrame& frame) {
  const LandmarkHand& hand = *ahead.hands[index_of(side)];
  const std::optional<Landmarks> shape = shape_of(hand, ahead.aspect);
  if (!shape) {
    warnings_.add(Oddity::unusable_hand,
                  fmt::format("{}: {}: wrist and middle knuckle lie in one point; the hand is left "
                              "out of the frame",
                              ahead.place, name_of(side)));
    return;
  }
  if (!bones_[index_of(side)]) learn_hand(side, ahead);
  if (!height_m_ && hand.picture) learn_picture(side, ahead);
  RecordedHand recorded;
  recorded.pose = hand_from_landmarks(side, placed(side, *shape, ahead));
  recorded.pose.confidence = hand.score;
  if (!intake_.admit(recorded.pose, ahead.place, warnings_)) return;
  frame.hands[index_of(side)] = std::move(recorded);
}

Landmarks MediapipeImport::placed(Handedness side, const Landmarks& shape, const Ahead& ahead) {
  const LandmarkHand& hand = *ahead.hands[index_of(side)];
  warnings_.add_once(
      Oddity::depth_missing,
      fmt::format("{}: MediaPipe does not measure how far a hand is from the camera, "
                  "nor how large: it is put {} m away and made as long as the "
                  "generic hand, {:.0f} mm from wrist to middle knuckle",
                  name(), kGuessedDepth_m, 1e3 * kGenericLength_m));
  if (!hand.world) {
    warnings_.add(Oddity::shape_missing,
                  fmt::format("{}: {}: no world landmarks; the hand's shape is taken from the "
                              "picture's, whose depth is coarse",
                              ahead.place, name_of(side)));
  }
  Landmarks points = with_bones(shape, *bones_[index_of(side)]);
  Vec3 palm(0.0, 0.0, -kGuessedDepth_m);
  if (hand.picture && height_m_) {
    palm += *height_m_ * middle_of_palm(in_heights(*hand.picture, ahead.aspect));
  } else {
    warnings_.add(Oddity::picture_missing,
                  fmt::format("{}: {}: no landmarks in the picture; the hand is put in its middle",
                              ahead.place, name_of(side)));
  }
  const Vec3 shift = palm - middle_of_palm(points);
  for (Vec3& point : points) point += shift;
  return points;
}

}  // namespace nade::io
