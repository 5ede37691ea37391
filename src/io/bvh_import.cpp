#include "bvh_import.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "file_side.h"
#include "mesh_words.h"
#include "nade/hand_check.h"
#include "nade/hand_mesh.h"
#include "recording_limits.h"

namespace nade::io {
namespace {

constexpr double kShortestFrame_s = 1e-6;
constexpr double kLongestFrame_s = 3600.0;

/// The unit that a hand's length fits, metres among them.
std::optional<double> unit_of_length(double length) {
  const bool metres = unit_by_length(1e3 * length) == 1e-3;
  return metres ? 1.0 : unit_by_length(length);
}

}  // namespace

bool looks_like_bvh(std::string_view beginning) {
  constexpr std::string_view kFirst = "hierarchy";
  const std::size_t begin = beginning.find_first_not_of(" \t\r\n");
  return begin != std::string_view::npos && lower(beginning.substr(begin, kFirst.size())) == kFirst;
}

Result<BvhImport> BvhImport::open(ByteSource source) {
  BvhImport import(std::move(source));
  import.header_.source = "bvh";
  Result<BvhSkeleton> skeleton = read_bvh_skeleton(import.text_);
  if (!skeleton) return skeleton.error();
  import.skeleton_ = std::move(skeleton).value();
  import.numbers_.resize(import.skeleton_.channel_count);
  const Status found = import.find_hands();
  if (!found) return found.error();
  const Status motion = import.read_motion();
  if (!motion) return motion.error();
  import.guess_unit();
  import.tell_guesses();
  return import;
}

Status BvhImport::find_hands() {
  const std::optional<Handedness> only = side_of_file(name());
  BvhHands found = find_bvh_hands(skeleton_, only);
  hands_ = found.hands;
  std::string lacking;
  for (const Handedness side : {Handedness::left, Handedness::right}) {
    const std::string& lacks = found.lacking[index_of(side)];
    if (lacks.empty()) continue;
    lacking = fmt::format("{}: {} hand: {}", name(), name_of(side), lacks);
    if (hands_[0] || hands_[1]) {
      warnings_.add(Oddity::unusable_hand, lacking + "; the hand is left out");
    }
  }
  if (hands_[0] || hands_[1]) return ok_status();
  if (!lacking.empty()) {
    return Error{ErrorCode::bad_format,
                 lacking + "; expected joints of all five digits, as LeftHandIndex1"};
  }
  // Of a hand that does not say its side either would do, to see that there is one.
  const BvhHands sideless = only ? BvhHands() : find_bvh_hands(skeleton_, Handedness::right);
  if (sideless.hands[0] || sideless.hands[1]) {
    return Error{ErrorCode::bad_format,
                 fmt::format("{}: expected left or right in the names of the hand's joints or in "
                             "the file's, found neither",
                             name())};
  }
  return Error{ErrorCode::bad_format,
               fmt::format("{}: expected joints of fingers, as LeftHandIndex1, found {} joints, "
                           "none of them of a finger",
                           name(), skeleton_.joints.size())};
}

void BvhImport::guess_unit() {
  double length = 0.0;
  for (const auto& hand : hands_) {
    if (hand) length = std::max(length, hand->length);
  }
  const std::optional<double> unit_m = unit_of_length(length);
  unit_m_ = unit_m.value_or(kGenericHandLength / length);
  const std::string found =
      fmt::format("the hand is {:.4g} long from wrist to middle knuckle", length);
  warnings_.add_once(
      Oddity::unit_guessed,
      unit_m ? fmt::format("{}: the file does not name its unit; it is taken to be {}, as {}",
                           name(), name_of_length_unit(*unit_m), found)
             : fmt::format("{}: {}, which fits no unit; it is made {:.0f} mm long, as the generic "
                           "hand",
                           name(), found, 1e3 * kGenericHandLength));
}

void BvhImport::tell_guesses() {
  std::vector<std::string> without_metacarpal;
  std::vector<std::string> short_of_joints;
  for (const Handedness side : {Handedness::left, Handedness::right}) {
    const auto& hand = hands_[index_of(side)];
    if (!hand) continue;
    for (std::size_t d = 0; d < kDigitCount; ++d) {
      const std::string digit = fmt::format("{} {}", name_of(side), name_of(part_of(digit_at(d))));
      const bool is_finger = digit_at(d) != Digit::thumb;
      if (is_finger && !hand->digits[d].metacarpal) without_metacarpal.push_back(digit);
      if (!hand->digits[d].is_whole()) short_of_joints.push_back(digit);
    }
  }
  if (!without_metacarpal.empty()) {
    warnings_.add_once(Oddity::metacarpal_missing,
                       fmt::format("{}: no metacarpals ({}); they are put where the generic hand "
                                   "has them",
                                   name(), fmt::join(without_metacarpal, ", ")));
  }
  if (!short_of_joints.empty()) {
    warnings_.add_once(Oddity::joint_missing,
                       fmt::format("{}: joints are missing ({}); they are put in as far apart as "
                                   "in the generic hand, in a line",
                                   name(), fmt::join(short_of_joints, ", ")));
  }
}

Status BvhImport::read_motion() {
  const auto is_word = [](std::string_view word, std::string_view wanted) {
    if (word.ends_with(':')) word.remove_suffix(1);
    return lower(word) == wanted;
  };
  std::string_view word = text_.word();
  if (!is_word(word, "frames")) return text_.expected("Frames:", word);
  word = text_.word();
  if (!parse_word(word, frame_count_) || frame_count_ < 0) {
    return text_.expected("a number of frames", word);
  }
  word = text_.word();
  if (!is_word(word, "frame")) return text_.expected("Frame Time:", word);
  word = text_.word();
  if (!is_word(word, "time")) return text_.expected("Frame Time:", word);
  word = text_.word();
  if (!parse_word(word, frame_time_s_) ||
      !(frame_time_s_ >= kShortestFrame_s && frame_time_s_ <= kLongestFrame_s)) {
    return text_.expected(
        fmt::format("the seconds of a frame, {:g} to {:g}", kShortestFrame_s, kLongestFrame_s),
        word);
  }
  return ok_status();
}

Result<bool> BvhImport::read_numbers() {
  if (!text_.next_line()) {
    if (text_.source().failure()) return *text_.source().failure();
    return false;
  }
  std::size_t count = 0;
  for (std::string_view word = text_.word_of_line(); !word.empty(); word = text_.word_of_line()) {
    double number = 0.0;
    const bool cut = !text_.line_is_whole() && count < numbers_.size();
    if (!parse_word(word, number) && !cut) {
      return text_.expected(fmt::format("a number for channel {}", count + 1), word);
    }
    if (count < numbers_.size()) numbers_[count] = number;
    ++count;
  }
  if (count == numbers_.size()) return true;
  if (!text_.line_is_whole() && count < numbers_.size()) {
    warnings_.add(Oddity::cut_off,
                  fmt::format("{}: cut off here; the frame is left out", text_.place()));
    at_end_ = true;
    return false;
  }
  return text_.expected(
      fmt::format("{} numbers, one for each channel of the HIERARCHY", numbers_.size()),
      std::to_string(count));
}

void BvhImport::tell_end() {
  at_end_ = true;
  if (text_.source().cut_off()) {
    warnings_.add(Oddity::cut_off, fmt::format("{}: cut off after it", text_.place()));
  } else if (read_ != frame_count_) {
    warnings_.add(Oddity::cut_off,
                  fmt::format("{}: expected {} frames, as MOTION says, found {}; those are read",
                              name(), frame_count_, read_));
  }
}

Result<std::optional<RecordedFrame>> BvhImport::next() {
  if (at_end_) return std::optional<RecordedFrame>();
  const Result<bool> more = read_numbers();
  if (!more) return more.error();
  if (!*more) {
    if (!at_end_) tell_end();
    return std::optional<RecordedFrame>();
  }
  const double time_s = frame_time_s_ * static_cast<double>(read_);
  if (time_s > 1e-9 * static_cast<double>(kLatest_ns)) {
    return text_.expected("a frame less than 126 years from the first", "more");
  }
  if (read_ == 0) placed_ = placed_by_channels(skeleton_, numbers_);
  ++read_;
  RecordedFrame frame;
  frame.time_ns = std::llround(1e9 * time_s);
  const std::vector<Pose> poses = posed(skeleton_, numbers_, placed_);
  for (const Handedness side : {Handedness::left, Handedness::right}) {
    if (hands_[index_of(side)]) take_hand(side, poses, frame);
  }
  return std::optional<RecordedFrame>(std::move(frame));
}

void BvhImport::take_hand(Handedness side, const std::vector<Pose>& poses, RecordedFrame& frame) {
  const LeapHand points = points_of(*hands_[index_of(side)], side, skeleton_, poses, unit_m_);
  const bool finite =
      std::all_of(points.fingers.begin(), points.fingers.end(), [](const LeapFinger& finger) {
        return finger.mcp.allFinite() && finger.pip.allFinite() && finger.dip.allFinite() &&
               finger.tip.allFinite() && (!finger.metacarpal || finger.metacarpal->allFinite());
      });
  if (!finite || !points.wrist->allFinite()) {
    warnings_.add(Oddity::unusable_hand,
                  fmt::format("{}: {}: a number is not finite; the hand is left out of the frame",
                              text_.place(), name_of(side)));
    return;
  }
  RecordedHand hand;
  hand.pose = hand_from_wrist_and_fingers(points);
  if (!intake_.admit(hand.pose, text_.place(), warnings_)) return;
  frame.hands[index_of(side)] = std::move(hand);
}

}  // namespace nade::io
