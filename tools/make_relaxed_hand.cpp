// Turns the relaxed hand of npm's iwer (a JavaScript object literal, a left hand captured from a
// headset) into a recording of one frame with both hands: make_relaxed_hand relaxed.js OUT.

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <string>

#include "nade/hand.h"
#include "nade/io/recording.h"
#include "nade/status.h"

namespace {

using nade::Error;
using nade::ErrorCode;
using nade::Result;
using nlohmann::json;

Error bad(const std::string& path, const std::string& what) {
  return {ErrorCode::bad_format, fmt::format("{}: {}", path, what)};
}

/// An object literal differs from JSON in its bare keys, its quotes and its last commas.
json parse_literal(const std::string& script) {
  const std::size_t first = script.find('{', script.find("export const"));
  const std::size_t last = script.rfind('}');
  if (first == std::string::npos || last == std::string::npos || last < first) return {};
  std::string text = script.substr(first, last - first + 1);
  text = std::regex_replace(text, std::regex("'"), "\"");
  text = std::regex_replace(text, std::regex(R"(([{,]\s*)([A-Za-z_]\w*)\s*:)"), "$1\"$2\":");
  text = std::regex_replace(text, std::regex(R"(,(\s*[}\]]))"), "$1");
  return json::parse(text, nullptr, false);
}

/// A column-major 4 x 4 matrix as WebXR and OpenGL write it.
std::optional<nade::Pose> pose_of(const json& matrix) {
  if (!matrix.is_array() || matrix.size() != 16) return std::nullopt;
  Eigen::Matrix4d m;
  for (Eigen::Index i = 0; i < 16; ++i) {
    const json& element = matrix[static_cast<std::size_t>(i)];
    if (!element.is_number()) return std::nullopt;
    m.data()[i] = element.get<double>();
  }
  const Eigen::Matrix3d turn = m.topLeftCorner<3, 3>();
  return nade::Pose{m.topRightCorner<3, 1>(), nade::Quat(turn).normalized()};
}

Result<nade::HandPose> read_left_hand(const std::string& path) {
  std::ifstream file(path);
  if (!file) return Error{ErrorCode::not_found, fmt::format("{}: no such file", path)};
  std::ostringstream text;
  text << file.rdbuf();
  const json literal = parse_literal(text.str());
  if (!literal.is_object() || !literal.contains("jointTransforms")) {
    return bad(path, "expected an object literal with jointTransforms");
  }
  nade::HandPose hand;
  hand.side = nade::Handedness::left;
  std::size_t found = 0;
  for (const auto& [name, transform] : literal["jointTransforms"].items()) {
    const auto joint = nade::joint_from_webxr_name(name);
    const auto pose = pose_of(transform.value("offsetMatrix", json()));
    if (!joint || !pose) return bad(path, fmt::format("{}: expected a joint's matrix", name));
    hand[*joint] = *pose;
    hand.radius[nade::index_of(*joint)] = transform.value("radius", 0.0);
    ++found;
  }
  constexpr std::size_t kWebxrJoints = 25;
  if (found != kWebxrJoints) {
    return bad(path, fmt::format("expected {} joints, found {}", kWebxrJoints, found));
  }
  hand[nade::Joint::palm] = nade::palm_from_middle_metacarpal(hand);
  hand.radius[nade::index_of(nade::Joint::palm)] =
      hand.radius[nade::index_of(nade::Joint::middle_metacarpal)];
  return hand;
}

nade::Status write_hands(const nade::HandPose& left, const std::string& path) {
  nade::RecordingHeader header;
  header.source = "iwer";
  header.hand_scale_known = true;
  auto writer = nade::RecordingWriter::create(path, header);
  if (!writer) return writer.error();
  nade::RecordedFrame frame;
  frame.hands[index_of(nade::Handedness::left)].emplace().pose = left;
  frame.hands[index_of(nade::Handedness::right)].emplace().pose = nade::mirrored(left);
  const nade::Status written = writer->write(frame);
  return written.ok() ? writer->finish() : written;
}

}  // namespace

// A step of the build may end in an exception. NOLINTNEXTLINE(bugprone-exception-escape)
int main(int argc, char** argv) {
  if (argc != 3) {
    std::fputs("usage: make_relaxed_hand relaxed.js OUT.jsonl\n", stderr);
    return 2;
  }
  const auto left = read_left_hand(argv[1]);
  const nade::Status status = left ? write_hands(*left, argv[2]) : nade::Status(left.error());
  if (status.ok()) return 0;
  std::fprintf(stderr, "make_relaxed_hand: %s\n", status.error().message.c_str());
  return 1;
}
