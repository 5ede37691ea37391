#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "recording_limits.h"
#include "recording_lines.h"
#include "recording_names.h"

namespace nade::io {
namespace {

using Buffer = fmt::memory_buffer;

void append(Buffer& out, std::string_view text) {
  out.append(text.data(), text.data() + text.size());
}

/// The shortest text that reads back as the same number.
void append(Buffer& out, double number) {
  // "-0" would come back as the whole number 0, without its sign.
  if (number == 0.0 && std::signbit(number)) return append(out, "-0.0");
  fmt::format_to(fmt::appender(out), "{}", number);
}

void append(Buffer& out, const Vec3& vector) {
  append(out, "[");
  append(out, vector.x());
  append(out, ",");
  append(out, vector.y());
  append(out, ",");
  append(out, vector.z());
  append(out, "]");
}

Json parsed_unknown(const std::string& text) {
  if (text.empty()) return Json::object();
  Json object = Json::parse(text, nullptr, false);
  return object.is_object() ? object : Json::object();
}

std::string dumped(const Json& value) {
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void append_unknown(Buffer& out, const Json& object,
                    std::initializer_list<std::string_view> known) {
  for (const auto& [key, value] : object.items()) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    append(out, ",");
    append(out, dumped(key));
    append(out, ":");
    append(out, dumped(value));
  }
}

/// Position, then rotation, with commas between.
void append_numbers(Buffer& out, const Pose& pose) {
  const Vec3& at = pose.position;
  const Quat& turn = pose.rotation;
  std::string_view separator;
  for (const double number : {at.x(), at.y(), at.z(), turn.x(), turn.y(), turn.z(), turn.w()}) {
    append(out, separator);
    append(out, number);
    separator = ",";
  }
}

void append_joints(Buffer& out, const HandPose& pose) {
  append(out, "\"joints\":[");
  for (std::size_t i = 0; i < kJointCount; ++i) {
    append(out, i == 0 ? "[" : ",[");
    append_numbers(out, pose.joints[i]);
    append(out, ",");
    append(out, pose.radius[i]);
    append(out, "]");
  }
  append(out, "]");
}

void append_contact(Buffer& out, const RecordedContact& contact, const Json& unknown) {
  append(out, "{\"point\":");
  append(out, contact.point);
  append(out, ",\"normal\":");
  append(out, contact.normal);
  append(out, ",\"depth\":");
  append(out, contact.depth_m);
  append_unknown(out, unknown, {"point", "normal", "depth"});
  append(out, "}");
}

/// The known parts with their unknown keys, then the unknown parts.
void append_contacts(Buffer& out, const RecordedHand& hand, Json unknown) {
  bool any = !unknown.empty();
  for (const auto& contact : hand.contact) any = any || contact.has_value();
  // A corrected hand says so where nothing touches.
  if (!any && !hand.status) return;
  append(out, ",\"contact\":{");
  std::string_view separator;
  for (std::size_t p = 0; p < kPartCount; ++p) {
    if (!hand.contact[p]) continue;
    const std::string name(name_of(part_at(p)));
    append(out, separator);
    fmt::format_to(fmt::appender(out), "\"{}\":", name);
    Json extra = unknown.value(name, Json::object());
    append_contact(out, *hand.contact[p], extra.is_object() ? extra : Json::object());
    unknown.erase(name);
    separator = ",";
  }
  for (const auto& [key, value] : unknown.items()) {
    append(out, separator);
    append(out, dumped(key));
    append(out, ":");
    append(out, dumped(value));
    separator = ",";
  }
  append(out, "}");
}

void append_hand(Buffer& out, const RecordedHand& hand) {
  const Json unknown = parsed_unknown(hand.unknown_json);
  append(out, "{");
  append_joints(out, hand.pose);
  append(out, ",\"confidence\":");
  append(out, hand.pose.confidence);
  append_contacts(out, hand, unknown.value("contact", Json::object()));
  if (hand.status) {
    fmt::format_to(fmt::appender(out), ",\"status\":\"{}\"",
                   kStatusNames[static_cast<std::size_t>(*hand.status)]);
  }
  append_unknown(out, unknown, {"joints", "confidence", "contact", "status"});
  append(out, "}");
}

bool is_finite(const Pose& pose) {
  return pose.position.allFinite() && pose.rotation.coeffs().allFinite();
}

bool is_finite(const RecordedContact& contact) {
  return contact.point.allFinite() && contact.normal.allFinite() && std::isfinite(contact.depth_m);
}

/// Refuses what a reader of the hand would.
Status check_hand(const RecordedHand& hand) {
  const auto wrong = [](std::string_view expected) {
    return Error{ErrorCode::bad_value, fmt::format("expected {}", expected)};
  };
  constexpr std::string_view kFinite = "finite numbers to write";
  for (const auto& contact : hand.contact) {
    if (contact && !is_finite(*contact)) return wrong(kFinite);
  }
  for (std::size_t i = 0; i < kJointCount; ++i) {
    const Pose& joint = hand.pose.joints[i];
    const double radius = hand.pose.radius[i];
    if (!is_finite(joint) || !std::isfinite(radius)) return wrong(kFinite);
    const double farthest = std::max({joint.position.cwiseAbs().maxCoeff(),
                                      joint.rotation.coeffs().cwiseAbs().maxCoeff(), radius});
    if (farthest > kFarthest_m) {
      return wrong(fmt::format("numbers up to {} to write, found {}", kFarthest_m, farthest));
    }
    if (radius < 0.0) return wrong(fmt::format("a radius of 0 or more to write, found {}", radius));
  }
  const double confidence = hand.pose.confidence;
  if (!std::isfinite(confidence)) return wrong(kFinite);
  if (confidence >= 0.0 && confidence <= 1.0) return ok_status();
  return wrong(fmt::format("a confidence from 0 to 1 to write, found {}", confidence));
}

}  // namespace

void append_header(const RecordingHeader& header, Buffer& out) {
  fmt::format_to(fmt::appender(out), "{{\"format\":\"{}\",\"version\":{},\"source\":{}",
                 kFormatName, kFormatVersion, dumped(header.source));
  if (!header.created.empty()) {
    fmt::format_to(fmt::appender(out), ",\"created\":{}", dumped(header.created));
  }
  fmt::format_to(fmt::appender(out), ",\"hand_scale_known\":{}", header.hand_scale_known);
  append_unknown(out, parsed_unknown(header.unknown_json),
                 {"format", "version", "source", "created", "hand_scale_known"});
  append(out, "}\n");
}

Status check_frame(const RecordedFrame& frame) {
  const auto wrong = [&](const std::string& sentence) {
    return Error{ErrorCode::bad_value, fmt::format("frame at {} ns: {}", frame.time_ns, sentence)};
  };
  if (frame.time_ns < -kLatest_ns || frame.time_ns > kLatest_ns) {
    return wrong(fmt::format("expected a time up to {} ns from 0 to write", kLatest_ns));
  }
  for (const Handedness side : {Handedness::left, Handedness::right}) {
    const std::optional<RecordedHand>& hand = frame.hands[index_of(side)];
    const Status status = hand ? check_hand(*hand) : ok_status();
    if (!status) return wrong(fmt::format("{}: {}", name_of(side), status.error().message));
  }
  if (!frame.head || is_finite(*frame.head)) return ok_status();
  return wrong("head: expected finite numbers to write");
}

void append_frame(const RecordedFrame& frame, Buffer& out) {
  fmt::format_to(fmt::appender(out), "{{\"t\":{}", frame.time_ns);
  for (const Handedness side : {Handedness::left, Handedness::right}) {
    const std::optional<RecordedHand>& hand = frame.hands[index_of(side)];
    if (!hand) continue;
    fmt::format_to(fmt::appender(out), ",\"{}\":", name_of(side));
    append_hand(out, *hand);
  }
  if (frame.head) {
    append(out, ",\"head\":[");
    append_numbers(out, *frame.head);
    append(out, "]");
  }
  append_unknown(out, parsed_unknown(frame.unknown_json), {"t", "left", "right", "head"});
  append(out, "}\n");
}

}  // namespace nade::io
