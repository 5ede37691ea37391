// Time of one corrected hand-frame: HandCorrector::update over a stroke with the palm pressed 20
// and 30 mm into each object.
//     corrector_bench
// Answers are checked first; the exit status is 1 where one is wrong.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "nade/corrector.h"
#include "nade/eval/synth.h"
#include "nade/io/object_file.h"
#include "stopwatch.h"

namespace {

using namespace nade;

constexpr std::array kDepths_m{0.02, 0.03};
constexpr double kDuration_s = 30.0;

struct Row {
  const char* name;
  CorrectorOptions options;
  /// How far off the surface the palm's skin may be drawn.
  double palm_tolerance_m;
};

CorrectorOptions by(Method method) {
  CorrectorOptions options;
  options.method = method;
  return options;
}

/// The paper puts the palm's centre on the surface; a whole hand rests on what sticks out of it.
std::vector<Row> rows() {
  return {{"paper", by(Method::paper), 1e-4}, {"nade", by(Method::nade), 5e-3}};
}

struct TimedHand {
  HandPose pose;
  std::int64_t time_ns;
};
using StrokeFrames = std::vector<TimedHand>;

struct Counts {
  std::size_t frames = 0;
  std::size_t wrong = 0;
  double farthest_m = 0.0;  ///< the palm's skin from the surface
};

/// Only frames in which the palm is at its depth.
Result<StrokeFrames> make_stroke(const LoadedObject& object, double depth_m) {
  const Result<HandPose> relaxed = load_relaxed_hand(Handedness::right);
  if (!relaxed) return relaxed.error();
  SynthOptions options;
  options.depth_m = depth_m;
  options.duration_s = kDuration_s;
  Result<StrokeSynth> synth = StrokeSynth::create(object, {}, *relaxed, options);
  if (!synth) return synth.error();
  StrokeFrames frames;
  while (const auto frame = synth->next()) {
    const double time_s = 1e-9 * static_cast<double>(frame->time_ns);
    const auto& hand = frame->hands[index_of(Handedness::right)];
    if (!hand || time_s < synth->stroke_begin_s() || time_s > synth->stroke_end_s()) continue;
    frames.push_back({hand->pose, frame->time_ns});
  }
  return frames;
}

/// A frame is right where it is `corrected` and the palm's skin lies on the surface.
Counts check(const Row& row, const Object& object, const StrokeFrames& frames) {
  Counts counts;
  HandCorrector corrector(row.options);
  for (const TimedHand& frame : frames) {
    const CorrectedHand& hand = corrector.update(frame.pose, object, frame.time_ns);
    ++counts.frames;
    const auto& palm = hand.contacts[index_of(Part::palm)];
    if (hand.status != HandStatus::corrected || !palm) {
      ++counts.wrong;
      continue;
    }
    const Vec3 skin = hand.pose[Joint::palm].position - palm->skin_depth_m * hand.pose.back();
    SurfaceHint hint;
    const auto nearest = object.closest_point(skin, std::numeric_limits<double>::infinity(), hint);
    const double away_m = std::abs(nearest->signed_distance);
    if (away_m > row.palm_tolerance_m) ++counts.wrong;
    counts.farthest_m = std::max(counts.farthest_m, away_m);
  }
  return counts;
}

void time(const Row& row, const Object& object, const StrokeFrames& frames,
          bench::Stopwatch& watch) {
  HandCorrector corrector(row.options);
  for (const TimedHand& frame : frames) {
    watch.measure([&] { (void)corrector.update(frame.pose, object, frame.time_ns); });
  }
}

/// Prints the lines of one object. The count of wrong frames.
Result<std::size_t> run(const std::string& spec) {
  const Result<LoadedObject> loaded = load_object(spec);
  if (!loaded) return loaded.error();
  const Object object = loaded->placed();
  std::vector<StrokeFrames> strokes;
  for (const double depth_m : kDepths_m) {
    Result<StrokeFrames> stroke = make_stroke(*loaded, depth_m);
    if (!stroke) return stroke.error();
    strokes.push_back(std::move(stroke).value());
  }
  std::size_t wrong = 0;
  for (const Row& row : rows()) {
    Counts counts;
    bench::Stopwatch watch(kDepths_m.size() * strokes.front().size());
    for (const StrokeFrames& stroke : strokes) {
      const Counts found = check(row, object, stroke);
      counts.frames += found.frames;
      counts.wrong += found.wrong;
      counts.farthest_m = std::max(counts.farthest_m, found.farthest_m);
      time(row, object, stroke, watch);
    }
    const bench::Summary times = watch.summary();
    const std::string triangles =
        loaded->soup ? std::to_string(loaded->soup->triangles.size()) : "-";
    fmt::print("{:<8}{:>10}  {:<8}{:>8}{:>10.1f}{:>10.1f}{:>14.4f}{:>8}\n", spec, triangles,
               row.name, counts.frames, 1e-3 * times.median_ns, 1e-3 * times.p99_ns,
               1e3 * counts.farthest_m, counts.wrong);
    wrong += counts.wrong;
  }
  return wrong;
}

}  // namespace

int main() {
  fmt::print("one corrected hand-frame; times in us, palm's skin off the surface in mm\n");
  fmt::print("{:<8}{:>10}  {:<8}{:>8}{:>10}{:>10}{:>14}{:>8}\n", "object", "triangles", "method",
             "frames", "median", "p99", "palm off max", "wrong");
  std::size_t wrong = 0;
  for (const char* spec : {"plane", "sphere", "dog"}) {
    const Result<std::size_t> found = run(spec);
    if (!found) {
      fmt::print(stderr, "corrector_bench: {}\n", found.error().message);
      return 1;
    }
    wrong += *found;
  }
  return wrong == 0 ? 0 : 1;
}
