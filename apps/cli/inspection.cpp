#include "inspection.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "nade/io/plain_text.h"

namespace nade::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kSecondsPerNanosecond = 1e-9;
constexpr double kMillimetresPerMetre = 1e3;
constexpr double kRadiiAlike_m = 1e-5;
constexpr std::array<const char*, 4> kStatusNames{"free", "corrected", "released", "untracked"};
constexpr std::array<const char*, 9> kFormatNames{
    "nade-recording",       "Leap Motion v2 frames", "WebXR action recording",
    "table of joints",      "results of MediaPipe",  "WebXR joints",
    "motion capture (BVH)", "hands of HOT3D",        "Unity hand recording"};

double seconds(std::int64_t from_ns, std::int64_t to_ns) {
  return kSecondsPerNanosecond * static_cast<double>(to_ns - from_ns);
}

double share(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

/// Digits enough for a person; the recording itself has the rest.
double rounded(double value, double per_unit) { return std::round(value * per_unit) / per_unit; }
double shown_mm(double metres) { return rounded(kMillimetresPerMetre * metres, 1e2); }

Json range_mm(const Range& range) {
  if (range.least > range.greatest) return nullptr;
  return Json{shown_mm(range.least), shown_mm(range.greatest)};
}

void add_radii(HandInspection& hand, const HandPose& pose) {
  Range known;
  std::size_t count = 0;
  for (const double radius : pose.radius) {
    if (!(radius > 0.0)) continue;
    known.add(radius);
    hand.radius_m.add(radius);
    ++count;
  }
  // The palm is not a joint in WebXR.
  if (count + 1 < kJointCount) return;
  ++hand.radii_known;
  if (known.greatest - known.least < kRadiiAlike_m) ++hand.radii_alike;
}

void add_motion(HandInspection& hand, const Vec3& palm, std::int64_t time_ns,
                std::optional<std::int64_t> frame_before_ns) {
  if (hand.last_seen_ns) {
    const double elapsed_s = seconds(*hand.last_seen_ns, time_ns);
    if (hand.last_seen_ns == frame_before_ns) {
      hand.palm_speed.add((palm - hand.last_palm).norm() / elapsed_s);
    } else {
      ++hand.gaps;
      hand.longest_gap_s = std::max(hand.longest_gap_s, elapsed_s);
    }
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    hand.palm_m[axis].add(palm[static_cast<Eigen::Index>(axis)]);
  }
  hand.last_seen_ns = time_ns;
  hand.last_palm = palm;
}

void add_hand(HandInspection& hand, const RecordedHand& recorded) {
  ++hand.frames;
  const double length_m = hand_length(recorded.pose);
  hand.hand_length_m.add(length_m);
  hand.hand_length_sum_m += length_m;
  hand.confidence.add(recorded.pose.confidence);
  add_radii(hand, recorded.pose);
  if (recorded.status) ++hand.statuses[static_cast<std::size_t>(*recorded.status)];
  for (std::size_t part = 0; part < kPartCount; ++part) {
    if (!recorded.contact[part]) continue;
    ++hand.contacts[part];
    hand.depth_m.add(recorded.contact[part]->depth_m);
  }
}

std::string radii_verdict(const HandInspection& hand) {
  if (hand.radii_known < hand.frames) return "unknown";
  if (hand.radii_alike * 2 > hand.frames) return "all alike, not believable";
  return "believable";
}

Json hand_json(const HandInspection& hand, std::size_t frames) {
  Json json;
  json["frames"] = hand.frames;
  json["share"] = rounded(share(hand.frames, frames), 1e4);
  json["gaps"] = hand.gaps;
  json["longest_gap_s"] = rounded(hand.longest_gap_s, 1e4);
  json["hand_length_mm"] = shown_mm(hand.hand_length_sum_m / static_cast<double>(hand.frames));
  json["hand_length_range_mm"] = range_mm(hand.hand_length_m);
  json["radii"] = radii_verdict(hand);
  json["radius_range_mm"] = range_mm(hand.radius_m);
  json["confidence_range"] = {hand.confidence.least, hand.confidence.greatest};
  for (const Range& axis : hand.palm_m) json["palm_range_mm"].push_back(range_mm(axis));
  json["palm_speed_median_mm_s"] = shown_mm(hand.palm_speed.quantile(0.5).value_or(0.0));
  json["palm_speed_p99_mm_s"] = shown_mm(hand.palm_speed.quantile(0.99).value_or(0.0));
  if (std::all_of(hand.statuses.begin(), hand.statuses.end(), [](auto n) { return n == 0; })) {
    return json;
  }
  for (std::size_t i = 0; i < hand.statuses.size(); ++i) {
    json["status_frames"][kStatusNames[i]] = hand.statuses[i];
  }
  for (std::size_t part = 0; part < kPartCount; ++part) {
    json["contact_frames"][std::string(name_of(part_at(part)))] = hand.contacts[part];
  }
  json["contact_depth_range_mm"] = range_mm(hand.depth_m);
  return json;
}

std::string shown_range(const Json& range) {
  if (!range.is_array()) return "none";
  return fmt::format("{:.1f} to {:.1f}", range[0].get<double>(), range[1].get<double>());
}

std::string shown_counts(const Json& counts) {
  std::vector<std::string> parts;
  for (const auto& [name, count] : counts.items()) {
    if (count != 0) parts.push_back(fmt::format("{} {}", name, count.get<std::size_t>()));
  }
  return parts.empty() ? "none" : fmt::format("{}", fmt::join(parts, ", "));
}

void append_hand(std::string& text, const std::string& side, const Json& hand) {
  fmt::format_to(std::back_inserter(text), "\n{} hand\n", side);
  append_row(text, "  frames",
             fmt::format("{} ({:.1f} %)", hand["frames"].get<std::size_t>(),
                         100.0 * hand["share"].get<double>()));
  append_row(text, "  gaps",
             fmt::format("{}, the longest {:.3f} s", hand["gaps"].get<std::size_t>(),
                         hand["longest_gap_s"].get<double>()));
  append_row(text, "  hand length",
             fmt::format("{:.1f} mm ({})", hand["hand_length_mm"].get<double>(),
                         shown_range(hand["hand_length_range_mm"])));
  append_row(text, "  joint radii",
             hand["radius_range_mm"].is_array()
                 ? fmt::format("{} ({} mm)", hand["radii"].get<std::string>(),
                               shown_range(hand["radius_range_mm"]))
                 : hand["radii"].get<std::string>());
  append_row(text, "  confidence",
             fmt::format("{:.2f} to {:.2f}", hand["confidence_range"][0].get<double>(),
                         hand["confidence_range"][1].get<double>()));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    append_row(text, fmt::format("  palm {}", "xyz"[axis]),
               shown_range(hand["palm_range_mm"][axis]) + " mm");
  }
  append_row(text, "  palm speed",
             fmt::format("median {:.1f} mm/s, p99 {:.1f} mm/s",
                         hand["palm_speed_median_mm_s"].get<double>(),
                         hand["palm_speed_p99_mm_s"].get<double>()));
  if (!hand.contains("status_frames")) return;
  append_row(text, "  status, frames", shown_counts(hand["status_frames"]));
  append_row(text, "  contact, frames", shown_counts(hand["contact_frames"]));
  append_row(text, "  contact depth", shown_range(hand["contact_depth_range_mm"]) + " mm");
}

}  // namespace

void append_row(std::string& text, std::string_view name, const std::string& value) {
  fmt::format_to(std::back_inserter(text), "{:<22}{}\n", plain_text(name), plain_text(value));
}

void Range::add(double value) {
  least = std::min(least, value);
  greatest = std::max(greatest, value);
}

void Inspection::add(const RecordedFrame& frame) {
  std::optional<std::int64_t> frame_before_ns;
  if (frames == 0) {
    first_ns = frame.time_ns;
  } else {
    frame_before_ns = last_ns;
    interval_s.add(seconds(last_ns, frame.time_ns));
  }
  for (std::size_t side = 0; side < hands.size(); ++side) {
    if (!frame.hands[side]) continue;
    add_hand(hands[side], *frame.hands[side]);
    add_motion(hands[side], frame.hands[side]->pose[Joint::palm].position, frame.time_ns,
               frame_before_ns);
  }
  last_ns = frame.time_ns;
  ++frames;
}

Json as_json(const Inspection& inspection, const RecordingReader& reader) {
  const RecordingHeader& header = reader.header();
  Json json;
  json["format"] = kFormatNames[static_cast<std::size_t>(reader.format())];
  json["source"] = header.source;
  json["created"] = header.created;
  json["hand_scale_known"] = header.hand_scale_known;
  if (!header.unknown_json.empty()) {
    json["header"] = Json::parse(header.unknown_json, nullptr, false);
  }
  json["frames"] = inspection.frames;
  const double duration_s = seconds(inspection.first_ns, inspection.last_ns);
  json["duration_s"] = rounded(duration_s, 1e6);
  if (duration_s > 0.0) {
    json["rate_hz"] = rounded(static_cast<double>(inspection.frames - 1) / duration_s, 1e2);
  } else {
    json["rate_hz"] = nullptr;
  }
  const double interval_s = inspection.interval_s.quantile(0.5).value_or(0.0);
  json["interval_median_ms"] = rounded(kMillimetresPerMetre * interval_s, 1e3);
  json["interval_p99_ms"] =
      rounded(kMillimetresPerMetre * inspection.interval_s.quantile(0.99).value_or(0.0), 1e3);
  json["interval_max_ms"] =
      rounded(kMillimetresPerMetre * inspection.interval_s.max().value_or(0.0), 1e3);
  json["hands"] = Json::object();
  for (const Handedness side : {Handedness::left, Handedness::right}) {
    const HandInspection& hand = inspection.hands[index_of(side)];
    if (hand.frames == 0) continue;
    json["hands"][std::string(name_of(side))] = hand_json(hand, inspection.frames);
  }
  json["warnings"] = reader.warnings();
  return json;
}

std::string as_text(const Json& report) {
  std::string text;
  append_row(text, "format", report["format"].get<std::string>());
  append_row(text, "source", report["source"].get<std::string>());
  append_row(text, "created", report["created"].get<std::string>());
  append_row(text, "hand scale known", report["hand_scale_known"].get<bool>() ? "yes" : "no");
  if (report.contains("header")) {
    for (const auto& [key, value] : report["header"].items()) append_row(text, key, value.dump());
  }
  append_row(text, "frames", std::to_string(report["frames"].get<std::size_t>()));
  append_row(text, "duration", fmt::format("{:.3f} s", report["duration_s"].get<double>()));
  if (report["rate_hz"].is_number()) {
    append_row(
        text, "rate",
        fmt::format("{:.1f} Hz (interval: median {:.2f} ms, p99 {:.2f} ms, "
                    "longest {:.2f} ms)",
                    report["rate_hz"].get<double>(), report["interval_median_ms"].get<double>(),
                    report["interval_p99_ms"].get<double>(),
                    report["interval_max_ms"].get<double>()));
  }
  for (const auto& [side, hand] : report["hands"].items()) append_hand(text, side, hand);
  if (report["hands"].empty()) text += "\nno hand in any frame\n";
  for (const auto& warning : report["warnings"]) {
    fmt::format_to(std::back_inserter(text), "\nwarning: {}\n",
                   plain_text(warning.get<std::string>()));
  }
  return text;
}

}  // namespace nade::cli
