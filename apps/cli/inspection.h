#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "nade/eval/quantile.h"
#include "nade/io/recording.h"

namespace nade::cli {

/// Smallest and greatest value seen.
struct Range {
  double least = std::numeric_limits<double>::infinity();
  double greatest = -std::numeric_limits<double>::infinity();

  void add(double value);
};

/// What one hand of a recording is like.
struct HandInspection {
  std::size_t frames = 0;
  std::size_t gaps = 0;  ///< times the hand was lost and found again
  double longest_gap_s = 0.0;
  Range hand_length_m;  ///< wrist to middle-finger knuckle
  double hand_length_sum_m = 0.0;
  Range radius_m;               ///< of those that are known
  std::size_t radii_alike = 0;  ///< frames in which all known radii are the same
  std::size_t radii_known = 0;  ///< frames in which all joints have one
  Range confidence;
  std::array<Range, 3> palm_m;                     ///< by axis
  QuantileSketch palm_speed;                       ///< metres per second
  std::array<std::size_t, 4> statuses{};           ///< by HandStatus
  std::array<std::size_t, kPartCount> contacts{};  ///< frames in which a part touches
  Range depth_m;

  std::optional<std::int64_t> last_seen_ns;
  Vec3 last_palm = Vec3::Zero();
};

/// What a recording is like, gathered a frame at a time in bounded memory.
struct Inspection {
  std::size_t frames = 0;
  std::int64_t first_ns = 0;
  std::int64_t last_ns = 0;
  QuantileSketch interval_s;
  std::array<HandInspection, 2> hands;  ///< by index_of(Handedness)

  void add(const RecordedFrame& frame);
};

/// A row of what `inspect` prints for a person.
void append_row(std::string& text, std::string_view name, const std::string& value);

/// What `inspect` prints: for a program, and for a person.
[[nodiscard]] nlohmann::ordered_json as_json(const Inspection& inspection,
                                             const RecordingReader& reader);
[[nodiscard]] std::string as_text(const nlohmann::ordered_json& report);

}  // namespace nade::cli
