// Time of one corrected hand-frame: HandCorrector::update over a stroke with the palm pressed 20
// and 30 mm into each object, and of the frame in which a hand is found there; at the end how it
// grows from a thousand triangles to a million, and with a thousand objects beside.
//     corrector_bench
// Answers are checked first; the exit status is 1 where one is wrong.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "nade/corrector.h"
#include "nade/eval/shapes.h"
#include "nade/eval/synth.h"
#include "nade/io/object_file.h"
#include "nade/scene.h"
#include "nade/solids.h"
#include "stopwatch.h"
#include "support/meshes.h"

namespace {

using namespace nade;

constexpr std::array kDepths_m{0.02, 0.03};
constexpr double kDuration_s = 30.0;
/// A hand is found in one frame of so many.
constexpr std::size_t kFoundEvery = 30;
/// Sectors and rings, for a thousand, seventy thousand and a million triangles.
constexpr std::array<std::array<std::uint32_t, 2>, 3> kBalls{{{32, 17}, {265, 133}, {1000, 501}}};

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
Counts check(const Row& row, double edges_m, const Object& object, const StrokeFrames& frames) {
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
    if (away_m > row.palm_tolerance_m + edges_m) ++counts.wrong;
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

/// Hands that are seen for the first time.
void time_found(const Row& row, const Object& object, const StrokeFrames& frames,
                bench::Stopwatch& watch) {
  for (std::size_t i = 0; i < frames.size(); i += kFoundEvery) {
    HandCorrector corrector(row.options);
    watch.measure([&] { (void)corrector.update(frames[i].pose, object, frames[i].time_ns); });
  }
}

/// A ball of 2 * sectors * (rings - 1) triangles, to be stroked on its side, where they are even.
Result<LoadedObject> ball(std::uint32_t sectors, std::uint32_t rings) {
  constexpr float kRadius_m = 0.15F;
  const Quat aside(Eigen::AngleAxisd(0.5 * std::numbers::pi, Vec3::UnitX()));
  return shape_object("ball", {test::uv_sphere(kRadius_m, sectors, rings),
                               {{"side", {kRadius_m * (aside * Vec3::UnitY()), aside}}}});
}

/// Far objects in a scene; half of them move, and are placed anew in each frame.
constexpr ObjectId kFarObjects = 1000;

/// A frame on an object with and without a thousand far ones in the scene, median; and whether the
/// hand was the same, bit for bit.
struct CrowdTimes {
  double alone_ns = 0.0;
  double among_ns = 0.0;
  double placing_ns = 0.0;
  bool same = true;
};

CrowdTimes time_crowd(const Row& row, const Object& object, const StrokeFrames& frames) {
  const BoxSurface box({0.2, 0.1, 0.3});
  Scene one;
  Scene many;
  for (Scene* const scene : {&one, &many}) scene->add(0, object.surface(), object.placement());
  const auto far = [](ObjectId id, double time_s) {
    const double angle = 0.37 * static_cast<double>(id) + time_s;
    const double away_m = 2.0 + 0.01 * static_cast<double>(id);
    return Placement{{{away_m * std::cos(angle), 0.3 * std::sin(angle), away_m * std::sin(angle)},
                      Quat(Eigen::AngleAxisd(angle, Vec3::UnitY()))},
                     1.0};
  };
  for (ObjectId id = 1; id <= kFarObjects; ++id) many.add(id, box, far(id, 0.0));
  HandCorrector alone(row.options);
  HandCorrector among(row.options);
  bench::Stopwatch alone_watch(frames.size());
  bench::Stopwatch among_watch(frames.size());
  bench::Stopwatch placing_watch(frames.size());
  std::vector<Placement> places(kFarObjects / 2);
  CrowdTimes times;
  for (const TimedHand& frame : frames) {
    const double time_s = 1e-9 * static_cast<double>(frame.time_ns);
    for (ObjectId id = 1; id <= places.size(); ++id) places[id - 1] = far(id, time_s);
    placing_watch.measure([&] {
      for (ObjectId id = 1; id <= places.size(); ++id) many.place(id, places[id - 1]);
    });
    const auto measure_alone = [&] {
      alone_watch.measure([&] { (void)alone.update(frame.pose, one, frame.time_ns); });
    };
    // By turns, since the second finds the object's triangles in the cache.
    const bool alone_first = (&frame - frames.data()) % 2 == 0;
    if (alone_first) measure_alone();
    among_watch.measure([&] { (void)among.update(frame.pose, many, frame.time_ns); });
    if (!alone_first) measure_alone();
    times.same = times.same && alone.update(frame.pose, one, frame.time_ns).pose ==
                                   among.update(frame.pose, many, frame.time_ns).pose;
  }
  times.alone_ns = alone_watch.summary().median_ns;
  times.among_ns = among_watch.summary().median_ns;
  times.placing_ns = placing_watch.summary().median_ns;
  return times;
}

/// Gives how many of the methods drew another hand.
Result<std::size_t> run_crowd(const Result<LoadedObject>& loaded) {
  if (!loaded) return loaded.error();
  const Result<StrokeFrames> stroke = make_stroke(*loaded, kDepths_m.front());
  if (!stroke) return stroke.error();
  std::size_t wrong = 0;
  for (const Row& row : rows()) {
    const CrowdTimes times = time_crowd(row, loaded->placed(), *stroke);
    fmt::print(
        "{:<8}{} on the {} alone in a scene {:.1f} us, with {} far ones {:.1f} us, {:.1f} to "
        "place half of them: {:.2f} times as long, {:.2f} with placing{}\n",
        "crowd", row.name, loaded->spec, 1e-3 * times.alone_ns, kFarObjects, 1e-3 * times.among_ns,
        1e-3 * times.placing_ns, times.among_ns / times.alone_ns,
        (times.among_ns + times.placing_ns) / times.alone_ns, times.same ? "" : "; ANOTHER HAND");
    if (!times.same) ++wrong;
  }
  return wrong;
}

/// Of all rows of an object.
struct Ran {
  std::size_t wrong = 0;
  double nade_median_ns = 0.0;
};

/// Prints the lines of one object. Where its facets meet, the palm may be off by `edges_m` more.
Result<Ran> run(const Result<LoadedObject>& loaded, double edges_m) {
  if (!loaded) return loaded.error();
  const Object object = loaded->placed();
  std::vector<StrokeFrames> strokes;
  for (const double depth_m : kDepths_m) {
    Result<StrokeFrames> stroke = make_stroke(*loaded, depth_m);
    if (!stroke) return stroke.error();
    strokes.push_back(std::move(stroke).value());
  }
  Ran ran;
  for (const Row& row : rows()) {
    Counts counts;
    bench::Stopwatch watch(kDepths_m.size() * strokes.front().size());
    bench::Stopwatch found_watch(0);
    for (const StrokeFrames& stroke : strokes) {
      const Counts found = check(row, edges_m, object, stroke);
      counts.frames += found.frames;
      counts.wrong += found.wrong;
      counts.farthest_m = std::max(counts.farthest_m, found.farthest_m);
      time(row, object, stroke, watch);
      time_found(row, object, stroke, found_watch);
    }
    const bench::Summary times = watch.summary();
    const std::string triangles =
        loaded->soup ? std::to_string(loaded->soup->triangles.size()) : "-";
    const bench::Summary found_times = found_watch.summary();
    fmt::print("{:<8}{:>10}  {:<8}{:>8}{:>10.1f}{:>10.1f}{:>10.0f}{:>10.0f}{:>14.4f}{:>8}\n",
               loaded->spec, triangles, row.name, counts.frames, 1e-3 * times.median_ns,
               1e-3 * times.p99_ns, 1e-3 * found_times.median_ns, 1e-3 * found_times.p99_ns,
               1e3 * counts.farthest_m, counts.wrong);
    ran.wrong += counts.wrong;
    if (row.options.method == Method::nade) ran.nade_median_ns = times.median_ns;
  }
  return ran;
}

}  // namespace

int main() {
  fmt::print("one corrected hand-frame; times in us, palm's skin off the surface in mm\n");
  fmt::print("{:<8}{:>10}  {:<8}{:>8}{:>10}{:>10}{:>10}{:>10}{:>14}{:>8}\n", "object", "triangles",
             "method", "frames", "median", "p99", "found", "its p99", "palm off max", "wrong");
  std::vector<Result<LoadedObject>> objects;
  for (const char* spec : {"plane", "sphere", "dog"}) objects.push_back(load_object(spec));
  for (const auto& [sectors, rings] : kBalls) objects.push_back(ball(sectors, rings));
  std::size_t wrong = 0;
  std::vector<double> nade_ns;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const bool coarse = i == objects.size() - kBalls.size();
    const Result<Ran> ran = run(objects[i], coarse ? 1e-3 : 0.0);
    if (!ran) {
      fmt::print(stderr, "corrector_bench: {}\n", ran.error().message);
      return 1;
    }
    wrong += ran->wrong;
    nade_ns.push_back(ran->nade_median_ns);
  }
  fmt::print("nade on balls: {:.2f} times as long on the last as on the first\n",
             nade_ns.back() / nade_ns[nade_ns.size() - kBalls.size()]);
  const Result<std::size_t> crowd = run_crowd(load_object("dog"));
  if (!crowd) {
    fmt::print(stderr, "corrector_bench: {}\n", crowd.error().message);
    return 1;
  }
  wrong += *crowd;
  return wrong == 0 ? 0 : 1;
}
