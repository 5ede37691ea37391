#include "unity_import.h"

// Based on: Unity Technologies. XR Hands, com.unity.xr.hands 1.7. (the layout of its recordings)

#include <fmt/format.h>

#include <bit>
#include <cmath>

#include "recording_limits.h"

namespace nade::io {
namespace {

constexpr std::uint32_t kUnityVersion = 1;
/// Later ones are known by their first bytes, too, so that they can be named.
constexpr unsigned char kLatestUnityVersion = 31;
constexpr std::size_t kUnityNumber = 4;       // bytes
constexpr std::size_t kMostNameBytes = 4096;  // of the recording's name
constexpr std::size_t kMostLengthBytes = 5;

/// Unity has the wrist first; all others are in our order.
Joint unity_joint(std::size_t index) {
  if (index == 0) return Joint::wrist;
  return index == 1 ? Joint::palm : joint_at(index);
}

}  // namespace

bool looks_like_unity_hands(std::string_view beginning) {
  if (beginning.size() < kUnityNumber) return false;
  const auto first = static_cast<unsigned char>(beginning[0]);
  // No text begins so.
  const bool is_text = first == '\t' || first == '\n' || first == '\r';
  return first >= 1 && first <= kLatestUnityVersion && !is_text &&
         beginning.substr(1, 3) == std::string_view("\0\0\0", 3);
}

bool looks_like_unity_asset(std::string_view beginning) {
  constexpr std::size_t kTagWithin = 256;
  return beginning.starts_with("%YAML") &&
         beginning.substr(0, kTagWithin).find("unity3d.com") != std::string_view::npos;
}

Result<UnityImport> UnityImport::open(ByteSource source) {
  UnityImport import(std::move(source));
  import.header_.source = "unity-xr-hands";
  const Status status = import.read_header();
  if (!status) return status.error();
  return import;
}

std::string UnityImport::place() const { return fmt::format("{}: frame {}", name(), read_); }

std::optional<std::uint32_t> UnityImport::read_int() {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < kUnityNumber; ++i) {
    const std::optional<char> byte = source_.get();
    if (!byte) return std::nullopt;
    number |= static_cast<std::uint32_t>(static_cast<unsigned char>(*byte)) << (8 * i);
  }
  return number;
}

std::optional<double> UnityImport::read_float() {
  const std::optional<std::uint32_t> bits = read_int();
  if (!bits) return std::nullopt;
  return static_cast<double>(std::bit_cast<float>(*bits));
}

Status UnityImport::read_header() {
  const auto expected = [&](const std::string& what) {
    if (source_.failure()) return *source_.failure();
    return Error{ErrorCode::bad_format, fmt::format("{}: expected {}", name(), what)};
  };
  const std::optional<std::uint32_t> version = read_int();
  if (version != kUnityVersion) {
    return expected(
        fmt::format("version {} of a Unity hand recording, found version {}; write its joints as a "
                    "table instead (docs/formats.md)",
                    kUnityVersion, version.value_or(0)));
  }
  std::size_t name_bytes = 0;
  for (std::size_t i = 0;; ++i) {
    const std::optional<char> byte = source_.get();
    if (!byte || i == kMostLengthBytes) return expected("the recording's name");
    name_bytes |= static_cast<std::size_t>(*byte & 0x7F) << (7 * i);
    if ((*byte & 0x80) == 0) break;
  }
  if (name_bytes > kMostNameBytes) {
    return expected(
        fmt::format("a name of at most {} bytes, found {}", kMostNameBytes, name_bytes));
  }
  for (; name_bytes > 0; --name_bytes) {
    if (!source_.get()) return expected("the recording's name, found the file cut off");
  }
  const std::optional<double> duration_s = read_float();
  const std::optional<std::uint32_t> count = read_int();
  if (!duration_s || !count) return expected("a number of frames, found the file cut off");
  frame_count_ = *count;
  return ok_status();
}

Result<std::optional<RecordedFrame>> UnityImport::next() {
  while (!at_end_) {
    if (read_ == frame_count_) {
      at_end_ = true;
      const bool more = source_.get().has_value();
      if (source_.failure()) return *source_.failure();
      if (!more) break;
      return Error{ErrorCode::bad_format, fmt::format("{}: expected the file's end after {} frames",
                                                      name(), frame_count_)};
    }
    Result<std::optional<RecordedFrame>> frame = read_frame();
    if (!frame || !*frame) return frame;
    if (!last_time_ns_ || (*frame)->time_ns > *last_time_ns_) {
      last_time_ns_ = (*frame)->time_ns;
      return frame;
    }
    warnings_.add(Oddity::time_not_advancing,
                  fmt::format("{}: the time does not advance; the frame is left out", place()));
  }
  return std::optional<RecordedFrame>();
}

Result<std::optional<RecordedFrame>> UnityImport::cut_off() {
  at_end_ = true;
  if (source_.failure()) return *source_.failure();
  warnings_.add(Oddity::cut_off,
                fmt::format("{}: cut off here; the frame is left out, and the {} behind it",
                            place(), frame_count_ - read_));
  return std::optional<RecordedFrame>();
}

Result<std::optional<RecordedFrame>> UnityImport::read_frame() {
  ++read_;
  const std::optional<double> time_s = read_float();
  if (!time_s) return cut_off();
  if (!(std::abs(*time_s) <= 1e-9 * static_cast<double>(kLatest_ns))) {
    return Error{ErrorCode::bad_value,
                 fmt::format("{}: expected a time in seconds, found {:g}", place(), *time_s)};
  }
  RecordedFrame frame;
  frame.time_ns = std::llround(1e9 * *time_s);
  // Which hands are tracked, left and right; then of which all joints are there.
  std::array<bool, 4> flags{};
  for (bool& flag : flags) {
    const std::optional<char> byte = source_.get();
    if (!byte) return cut_off();
    if (*byte != 0 && *byte != 1) {
      return Error{ErrorCode::bad_format,
                   fmt::format("{}: expected 0 or 1 for whether a hand is there, found {}", place(),
                               static_cast<int>(static_cast<unsigned char>(*byte)))};
    }
    flag = *byte == 1;
  }
  for (const Handedness side : {Handedness::left, Handedness::right}) {
    if (!flags[2 + index_of(side)]) continue;
    std::optional<HandPose> pose = read_hand(side);
    if (!pose) return cut_off();
    if (!intake_.admit(*pose, place(), warnings_)) continue;
    frame.hands[index_of(side)].emplace().pose = *pose;
  }
  return std::optional<RecordedFrame>(std::move(frame));
}

std::optional<HandPose> UnityImport::read_hand(Handedness side) {
  HandPose hand;
  hand.side = side;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    const std::optional<Pose> pose = read_pose();
    if (!pose) return std::nullopt;
    hand[unity_joint(i)] = *pose;
  }
  return hand;
}

std::optional<Pose> UnityImport::read_pose() {
  std::array<double, 7> numbers{};
  for (double& number : numbers) {
    const std::optional<double> read = read_float();
    if (!read) return std::nullopt;
    number = *read;
  }
  // Unity's +Z is forward, ours backward.
  return Pose{{numbers[0], numbers[1], -numbers[2]},
              Quat(numbers[6], -numbers[3], -numbers[4], numbers[5])};
}

}  // namespace nade::io
