#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "nade/eval/noise.h"
#include "nade/hand.h"
#include "nade/io/object_file.h"
#include "nade/io/recording.h"
#include "nade/status.h"

namespace nade {

/// How a synthetic hand moves over the object. "Forward" is a place's -Z, "aside" its X.
enum class Stroke : std::uint8_t {
  line,    ///< forward and back, each pass with a smooth start and end (minimum jerk)
  circle,  ///< round and round, counter-clockwise for a right hand, mirrored for a left one
  zigzag,  ///< from side to side while going forward and back
  curl,    ///< a line at a third of the speed while the fingers curl and open, once in two seconds
  press,   ///< down to the depth and up to the skin, again and again
};

/// "line", "circle", …
[[nodiscard]] std::string_view name_of(Stroke stroke);
[[nodiscard]] std::optional<Stroke> stroke_from_name(std::string_view name);

struct SynthOptions {
  Stroke stroke = Stroke::line;
  std::string place;           ///< a place of the object; empty: "back", or the only one there is
  double speed_m_per_s = 0.1;  ///< the palm's mean speed while it strokes; above 0, up to 2
  /// Of the palm's skin below the surface; 0 to 0.1. Where the object is thinner, the skin comes
  /// out behind it.
  double depth_m = 0.02;
  double tilt_rad = 0.0;  ///< about the place's X: above 0 raises the fingertips; up to 80 deg
  Handedness side = Handedness::right;
  double duration_s = 6.0;  ///< 0.5 to 86,400
  double rate_hz = 90.0;    ///< frames a second; 5 to 1,000
  NoiseModel noise = NoiseModel::none;
  std::uint64_t seed = 1;
  double hand_scale = 1.0;  ///< times the size of the hand given; 0.3 to 3
};

/// A relaxed hand as a headset tracked it. The error says where its file was looked for.
[[nodiscard]] Result<HandPose> load_relaxed_hand(Handedness side);

/// Makes a recording of a hand that strokes an object, a frame at a time: the hand comes down from
/// 5 cm above, strokes, and leaves. While it strokes, the skin under its palm lies at the set depth
/// below the surface (smoothed over a palm's breadth) and its back along the normal. The same
/// options give the same recording.
class StrokeSynth {
 public:
  /// `relaxed` is the hand's shape, of either side. `object` is not needed afterwards. The error
  /// names the option and what it may be.
  [[nodiscard]] static Result<StrokeSynth> create(const LoadedObject& object,
                                                  const Placement& placement,
                                                  const HandPose& relaxed,
                                                  const SynthOptions& options);
  StrokeSynth(StrokeSynth&&) noexcept;
  StrokeSynth& operator=(StrokeSynth&&) noexcept;
  ~StrokeSynth();

  /// Bears the options, the object and its placing.
  [[nodiscard]] const RecordingHeader& header() const;

  /// Between coming down and leaving, seconds from the start: the palm is at its depth (a press
  /// stroke: in its cycles).
  [[nodiscard]] double stroke_begin_s() const;
  [[nodiscard]] double stroke_end_s() const;

  /// The next frame; no value at the end.
  [[nodiscard]] std::optional<RecordedFrame> next();

 private:
  struct Impl;
  explicit StrokeSynth(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace nade
