#include "nade/eval/synth.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>

#include "nade/eval/posing.h"
#include "nade/io/assets.h"
#include "synth_rail.h"

// Based on: Flash and Hogan. The Coordination of Arm Movements. 1985. (minimum jerk)

namespace nade {
namespace {

constexpr double kHover_m = 0.05;
constexpr double kApproachMax_s = 1.0;
constexpr double kApproachShare = 0.15;  // of a recording too short for that
constexpr double kLineHalf_m = 0.10;
constexpr double kCircleRadius_m = 0.05;
constexpr double kZigzagHalf_m = 0.08;
constexpr double kZigzagAside_m = 0.03;
constexpr double kZigzagWavesMin = 3.0;  // there and back together; with fewer it is an oval
constexpr double kZigzagWavesMax = 5.0;
constexpr int kSizings = 8;           // to come within 0.1 % of the speed
constexpr double kSoftStart_s = 0.4;  // of a circle or zigzag
constexpr double kCurlPeriod_s = 2.0;
constexpr double kCurlSpeedShare = 1.0 / 3.0;

constexpr std::array<std::pair<Stroke, std::string_view>, 5> kStrokeNames{{
    {Stroke::line, "line"},
    {Stroke::circle, "circle"},
    {Stroke::zigzag, "zigzag"},
    {Stroke::curl, "curl"},
    {Stroke::press, "press"},
}};

/// From 0 to 1, starting and ending at rest.
double minimum_jerk(double x) {
  const double t = std::clamp(x, 0.0, 1.0);
  return t * t * t * (10.0 + t * (-15.0 + 6.0 * t));
}

/// From 0 to 1 at an even pace but for smooth ends of the width `ramp`, up to 0.5.
double soft_ended(double x, double ramp) {
  const double t = std::clamp(x, 0.0, 1.0);
  const auto ramped = [&](double from_end) {
    const double s = std::min(from_end / ramp, 1.0);
    const double inside = ramp * s * s * s * (1.0 - 0.5 * s);
    return (inside + std::max(0.0, from_end - ramp)) / (1.0 - ramp);
  };
  return t <= 0.5 ? ramped(t) : 1.0 - ramped(1.0 - t);
}

/// From 0 up to 1 and back, `cycles` times while x goes from 0 to 1.
double wave(double x, double cycles) {
  return 0.5 * (1.0 - std::cos(2.0 * std::numbers::pi * cycles * std::clamp(x, 0.0, 1.0)));
}

Error refuse(std::string_view option, double value, std::string_view expected) {
  return {ErrorCode::out_of_range, fmt::format("{} {}: expected {}", option, value, expected)};
}

Status check(const SynthOptions& options) {
  const auto outside = [](double value, double low, double high) {
    return !(value >= low && value <= high);
  };
  if (!(options.speed_m_per_s > 0.0 && options.speed_m_per_s <= 2.0)) {
    return refuse("--speed", options.speed_m_per_s, "metres per second above 0, up to 2");
  }
  if (outside(options.depth_m, 0.0, 0.1)) {
    return refuse("--depth", options.depth_m, "0 to 0.1 metres");
  }
  if (outside(options.tilt_rad, -80.0 * kDegree, 80.0 * kDegree)) {
    return refuse("--tilt", options.tilt_rad / kDegree, "-80 to 80 degrees");
  }
  if (outside(options.duration_s, 0.5, 86'400.0)) {
    return refuse("--duration", options.duration_s, "0.5 to 86400 seconds");
  }
  if (outside(options.rate_hz, 5.0, 1'000.0)) {
    return refuse("--rate", options.rate_hz, "5 to 1000 frames per second");
  }
  if (outside(options.hand_scale, 0.3, 3.0)) {
    return refuse("--hand-scale", options.hand_scale, "0.3 to 3");
  }
  return ok_status();
}

/// A stroke's largest pattern on a patch, for a way of `distance` metres; `size` shrinks it.
Pattern pattern_of(Stroke stroke, const PlaceExtent& extent, Handedness side, double distance,
                   double size) {
  // A left hand draws the mirror image.
  const double aside = side == Handedness::right ? size : -size;
  switch (stroke) {
    case Stroke::line:
    case Stroke::curl: {
      const double half = size * std::min(kLineHalf_m, extent.forward);
      return [half](double x) { return PatternPoint{0.0, half * (2.0 * x - 1.0)}; };
    }
    case Stroke::circle: {
      const double radius = std::min({kCircleRadius_m, 0.8 * extent.forward, 0.8 * extent.aside});
      return [=](double x) {
        return PatternPoint{aside * radius * std::cos(2.0 * std::numbers::pi * x),
                            size * radius * std::sin(2.0 * std::numbers::pi * x)};
      };
    }
    case Stroke::zigzag: {
      const double half = size * std::min(kZigzagHalf_m, 0.9 * extent.forward);
      const double width = std::min(kZigzagAside_m, 0.6 * extent.aside);
      const double waves =
          std::clamp(std::floor(distance / (4.0 * width)), kZigzagWavesMin, kZigzagWavesMax);
      return [=](double x) {
        return PatternPoint{aside * width * std::sin(2.0 * std::numbers::pi * waves * x),
                            -half * std::cos(2.0 * std::numbers::pi * x)};
      };
    }
    case Stroke::press:
      break;
  }
  return [](double) { return PatternPoint{}; };
}

/// Where the stroke goes, and how often over the pattern.
struct Course {
  Rail rail;
  double passes = 1.0;
};

/// As many whole passes as come nearest to the largest pattern, of the size at which they take
/// the stroke's time at the speed asked for.
Course plan_course(const StrokePatch& patch, const SynthOptions& options, double stroke_s,
                   const Vec3& palm_from_skin) {
  const double share = options.stroke == Stroke::curl ? kCurlSpeedShare : 1.0;
  const double distance = share * options.speed_m_per_s * stroke_s;
  const PlaceExtent extent = patch.extent();
  const auto lay = [&](double size) {
    return Rail(patch, pattern_of(options.stroke, extent, options.side, distance, size),
                options.depth_m);
  };
  Course course{lay(1.0)};
  if (options.stroke == Stroke::press) {
    // Down and up is twice the depth.
    course.passes = std::max(1.0, std::round(distance / std::max(2.0 * options.depth_m, 1e-3)));
    return course;
  }
  double length = course.rail.length(palm_from_skin);
  course.passes = std::max(1.0, std::ceil(distance / length - 0.01));
  double size = 1.0;
  for (int i = 0; i < kSizings; ++i) {
    const double ratio = distance / course.passes / length;
    if (std::abs(ratio - 1.0) < 1e-3) break;
    size *= ratio;
    course.rail = lay(size);
    length = course.rail.length(palm_from_skin);
  }
  return course;
}

std::string header_json(const ObjectPlacing& placing, const SynthOptions& options,
                        const std::string& place) {
  nlohmann::ordered_json synth;
  synth["stroke"] = name_of(options.stroke);
  synth["place"] = place;
  synth["speed"] = options.speed_m_per_s;
  synth["depth"] = options.depth_m;
  synth["tilt"] = options.tilt_rad / kDegree;
  synth["hand"] = name_of(options.side);
  synth["duration"] = options.duration_s;
  synth["rate"] = options.rate_hz;
  synth["noise"] = name_of(options.noise);
  synth["seed"] = options.seed;
  synth["hand_scale"] = options.hand_scale;
  return with_placing(nlohmann::ordered_json{{"synth", synth}}.dump(), placing);
}

}  // namespace

std::string_view name_of(Stroke stroke) {
  for (const auto& [known, name] : kStrokeNames) {
    if (known == stroke) return name;
  }
  return kStrokeNames.front().second;
}

std::optional<Stroke> stroke_from_name(std::string_view name) {
  for (const auto& [stroke, known] : kStrokeNames) {
    if (known == name) return stroke;
  }
  return std::nullopt;
}

Result<HandPose> load_relaxed_hand(Handedness side) {
  const Result<std::string> path = find_asset("hands/relaxed.jsonl");
  if (!path) return path.error();
  Result<RecordingReader> reader = RecordingReader::open(*path);
  if (!reader) return reader.error();
  Result<std::optional<RecordedFrame>> frame = reader->next();
  if (!frame) return frame.error();
  if (!frame->has_value() || !(**frame).hands[index_of(side)]) {
    return Error{ErrorCode::bad_format,
                 fmt::format("{}: expected a {} hand in its first frame", *path, name_of(side))};
  }
  return (**frame).hands[index_of(side)]->pose;
}

struct StrokeSynth::Impl {
  SynthOptions options;
  RecordingHeader header;
  PosableHand hand;
  Course course;
  TrackerNoise noise;
  double approach_s = 0.0;
  double curls = 0.0;
  std::int64_t frame = 0;
  std::int64_t frame_count = 0;

  [[nodiscard]] double stroke_s() const { return options.duration_s - 2.0 * approach_s; }

  /// How far the stroke has come, 0 to 1, `time_s` into the recording.
  [[nodiscard]] double progress(double time_s) const { return (time_s - approach_s) / stroke_s(); }

  /// Where on the rail.
  [[nodiscard]] double rail_x(double done) const {
    const double passes = course.passes;
    const double clamped = std::clamp(done, 0.0, 1.0);
    if (options.stroke == Stroke::line || options.stroke == Stroke::curl) {
      const double pass = std::min(std::floor(clamped * passes), passes - 1.0);
      const double x = minimum_jerk(clamped * passes - pass);
      return std::fmod(pass, 2.0) == 0.0 ? x : 1.0 - x;
    }
    const double ramp = std::min(0.25, kSoftStart_s / stroke_s());
    const double x = passes * soft_ended(clamped, ramp);
    return x - std::floor(x);
  }

  /// How far above its full depth the skin is.
  [[nodiscard]] double lift(double time_s, double done) const {
    const bool presses = options.stroke == Stroke::press;
    const double low = presses ? options.depth_m : 0.0;
    const double high = kHover_m + options.depth_m;
    if (done < 0.0) return high + (low - high) * minimum_jerk(time_s / approach_s);
    if (done > 1.0) {
      return low + (high - low) * minimum_jerk((time_s - approach_s - stroke_s()) / approach_s);
    }
    return presses ? options.depth_m * (1.0 - wave(done, course.passes)) : 0.0;
  }

  /// The hand's shape: the fingers curled by `curl` (0 to 1), and what a tracker adds.
  [[nodiscard]] HandPose posed(double curl, const TrackerError& error) const {
    if (options.noise == NoiseModel::none && options.stroke != Stroke::curl) return hand.relaxed();
    return hand.posed({.curl = curl}, error.angles);
  }

  [[nodiscard]] HandPose hand_at(double time_s) {
    const double done = progress(time_s);
    const Rail::Point point = course.rail.at(rail_x(done));
    const Vec3 normal = point.rotation * Vec3::UnitY();
    Pose palm =
        hand.palm_at(point.skin + lift(time_s, done) * normal,
                     point.rotation * Quat(Eigen::AngleAxisd(options.tilt_rad, Vec3::UnitX())));
    TrackerError error = noise.next(time_s);
    if (options.side == Handedness::left) {
      // The mirror image of the right hand's error.
      Pose& shift = error.palm;
      shift.position.x() = -shift.position.x();
      shift.rotation.y() = -shift.rotation.y();
      shift.rotation.z() = -shift.rotation.z();
    }
    palm = palm * error.palm;
    palm.rotation.normalize();
    const double curl = options.stroke == Stroke::curl ? wave(done, curls) : 0.0;
    return moved(posed(curl, error), palm);
  }
};

StrokeSynth::StrokeSynth(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
StrokeSynth::StrokeSynth(StrokeSynth&&) noexcept = default;
StrokeSynth& StrokeSynth::operator=(StrokeSynth&&) noexcept = default;
StrokeSynth::~StrokeSynth() = default;

Result<StrokeSynth> StrokeSynth::create(const LoadedObject& object, const Placement& placement,
                                        const HandPose& relaxed, const SynthOptions& options) {
  if (const Status checked = check(options); !checked.ok()) return checked.error();
  const Result<MeshPlace> place = object.place(options.place);
  if (!place) return place.error();
  if (!is_usable(relaxed) || !(hand_length(relaxed) > 0.0)) {
    return Error{ErrorCode::bad_value, "the relaxed hand is not a usable hand"};
  }
  const Object placed = object.placed(placement);
  const Vec3 wanted = placement.to_world(place->pose.position);
  SurfaceHint hint;
  const auto start = placed.closest_point(wanted, 0.05, hint);
  if (!start) {
    return Error{ErrorCode::bad_value,
                 fmt::format("object {}: place '{}': expected it within 5 cm of the surface",
                             object.spec, place->name)};
  }
  const StrokePatch patch(placed, {start->point, placement.pose.rotation * place->pose.rotation});
  const PosableHand hand(relaxed, options.side, options.hand_scale);
  const double approach_s = std::min(kApproachMax_s, kApproachShare * options.duration_s);
  const double stroke_s = options.duration_s - 2.0 * approach_s;
  const Vec3 palm_from_skin =
      Eigen::AngleAxisd(options.tilt_rad, Vec3::UnitX()) * Vec3(0.0, hand.palm_skin_depth_m(), 0.0);
  RecordingHeader header;
  header.source = "synth";
  header.hand_scale_known = true;
  header.unknown_json = header_json({object.spec, placement}, options, place->name);
  auto impl =
      std::make_unique<Impl>(Impl{.options = options,
                                  .header = std::move(header),
                                  .hand = hand,
                                  .course = plan_course(patch, options, stroke_s, palm_from_skin),
                                  .noise = TrackerNoise(options.noise, options.seed)});
  impl->approach_s = approach_s;
  impl->curls = std::max(1.0, std::round(stroke_s / kCurlPeriod_s));
  impl->frame_count = std::llround(options.duration_s * options.rate_hz);
  return StrokeSynth(std::move(impl));
}

const RecordingHeader& StrokeSynth::header() const { return impl_->header; }

double StrokeSynth::stroke_begin_s() const { return impl_->approach_s; }

double StrokeSynth::stroke_end_s() const { return impl_->approach_s + impl_->stroke_s(); }

std::optional<RecordedFrame> StrokeSynth::next() {
  if (impl_->frame >= impl_->frame_count) return std::nullopt;
  const double time_s = static_cast<double>(impl_->frame++) / impl_->options.rate_hz;
  RecordedFrame frame;
  frame.time_ns = std::llround(time_s * 1e9);
  frame.hands[index_of(impl_->options.side)].emplace().pose = impl_->hand_at(time_s);
  return frame;
}

}  // namespace nade
