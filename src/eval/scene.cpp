#include "nade/eval/scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "nade/eval/posing.h"
#include "nade/eval/shapes.h"
#include "nade/eval/synth.h"
#include "nade/flesh.h"
#include "smooth_path.h"

namespace nade {
namespace {

constexpr std::size_t kMotions = 6;        // 3 shifts, 3 turns
constexpr std::size_t kBendsPerDigit = 4;  // base, middle, last, abduction
constexpr std::size_t kMotionNumbers = 9;  // 3 shifts, 3 turns, 3 stretches

/// A gesture as angles to be added to those of the relaxed hand.
HandAngles added_angles(const Gesture& gesture, const HandAngles& relaxed) {
  HandAngles added{};
  for (std::size_t i = 0; i < kDigitCount; ++i) {
    if (!gesture[i]) continue;
    added[i][0].flexion = gesture[i]->base - relaxed[i][0].flexion;
    added[i][1].flexion = gesture[i]->middle - relaxed[i][1].flexion;
    added[i][2].flexion = gesture[i]->last - relaxed[i][2].flexion;
    if (gesture[i]->abduction) {
      added[i][0].abduction = *gesture[i]->abduction - relaxed[i][0].abduction;
    }
  }
  return added;
}

HandAngles angles_in(const Eigen::VectorXd& numbers) {
  HandAngles angles{};
  for (std::size_t i = 0; i < kDigitCount; ++i) {
    const auto at = static_cast<Eigen::Index>(kMotions + kBendsPerDigit * i);
    for (std::size_t hinge = 0; hinge < kHingeCount; ++hinge) {
      angles[i][hinge].flexion = numbers(at + static_cast<Eigen::Index>(hinge));
    }
    angles[i].front().abduction = numbers(at + 3);
  }
  return angles;
}

/// How far below its palm joint a hand's skin reaches, along -Y.
double reach_down(const HandPose& hand) {
  const HandFlesh& flesh = generic_flesh(hand.side);
  const double scale = hand_length(hand) / flesh.hand_length_m;
  double lowest = std::numeric_limits<double>::infinity();
  for (const FleshPoint& point : flesh.skin) {
    lowest = std::min(lowest, position_of(point, hand, scale).y());
  }
  return hand[Joint::palm].position.y() - lowest;
}

/// Where the palm joint is when a key's anchor is where the key says.
Vec3 palm_position(const SceneKey& key, const PosableHand& hand, const HandAngles& added) {
  const Quat rotation = turned_by(key.turn_rad);
  const HandPose posed = moved(hand.posed({}, added), {Vec3::Zero(), rotation});
  if (const Joint* joint = std::get_if<Joint>(&key.anchor)) {
    return key.at - posed[*joint].position;
  }
  if (std::get<SceneAnchor>(key.anchor) == SceneAnchor::lowest) {
    return key.at + reach_down(posed) * Vec3::UnitY();
  }
  return hand.palm_at(key.at, rotation).position;
}

/// The right hand's way: where its palm joint is, how it is turned, and how much more than relaxed
/// each digit is bent.
SmoothPath hand_path(const BenchScene& scene, const PosableHand& hand) {
  const HandAngles relaxed = measure_angles(hand.relaxed());
  std::vector<double> times_s;
  std::vector<Eigen::VectorXd> values;
  for (const SceneKey& key : scene.path) {
    const HandAngles added = added_angles(key.gesture, relaxed);
    Eigen::VectorXd numbers(static_cast<Eigen::Index>(kMotions + kBendsPerDigit * kDigitCount));
    numbers << palm_position(key, hand, added), key.turn_rad,
        Eigen::VectorXd::Zero(static_cast<Eigen::Index>(kBendsPerDigit * kDigitCount));
    for (std::size_t i = 0; i < kDigitCount; ++i) {
      numbers.segment<kBendsPerDigit>(static_cast<Eigen::Index>(kMotions + kBendsPerDigit * i))
          << added[i][0].flexion,
          added[i][1].flexion, added[i][2].flexion, added[i][0].abduction;
    }
    times_s.push_back(key.time_s);
    values.push_back(std::move(numbers));
  }
  return {std::move(times_s), std::move(values)};
}

std::optional<SmoothPath> object_path(const BenchScene& scene) {
  if (scene.motion.empty()) return std::nullopt;
  std::vector<double> times_s;
  std::vector<Eigen::VectorXd> values;
  for (const SceneMotionKey& key : scene.motion) {
    Eigen::VectorXd numbers(static_cast<Eigen::Index>(kMotionNumbers));
    numbers << key.at, key.turn_rad, key.stretch;
    times_s.push_back(key.time_s);
    values.push_back(std::move(numbers));
  }
  return SmoothPath(std::move(times_s), std::move(values));
}

ObjectState state_in(const Eigen::VectorXd& numbers) {
  return {{{numbers.head<3>(), turned_by(numbers.segment<3>(3))}, 1.0}, numbers.tail<3>()};
}

/// What the tracker gets wrong in one frame.
struct FrameFaults {
  bool lost = false;
  bool swapped = false;
  Pose error;
};

FrameFaults faults_at(const BenchScene& scene, double time_s) {
  // A time that is a frame's own counts, however it was rounded.
  const double half_frame_s = 0.5 / scene.rate_hz;
  const auto lasts = [&](double from_s, double duration_s) {
    return time_s >= from_s - half_frame_s && time_s < from_s + duration_s - half_frame_s;
  };
  FrameFaults faults;
  for (const SceneFault& fault : scene.faults) {
    if (const auto* loss = std::get_if<SceneLoss>(&fault)) {
      faults.lost |= lasts(loss->time_s, loss->duration_s);
    } else if (const auto* swap = std::get_if<SceneSwap>(&fault)) {
      faults.swapped |= lasts(swap->time_s, swap->duration_s);
    } else if (const auto* glitch = std::get_if<SceneGlitch>(&fault)) {
      const double duration_s = static_cast<double>(glitch->frames) / scene.rate_hz;
      if (lasts(glitch->time_s, duration_s)) faults.error = glitch->error;
    }
  }
  return faults;
}

/// One hand of a scene, frame by frame.
class SceneHand {
 public:
  SceneHand(const BenchScene& scene, Handedness side, const HandPose& relaxed,
            const SmoothPath& path, const Pose& frame)
      : side_(side),
        hand_(relaxed, side, scene.hand_scale),
        noise_(scene.noise, scene.seed + index_of(side)),
        path_(path),
        frame_(frame) {}

  /// The hand where this side's is, or, swapped, where the other's is.
  [[nodiscard]] HandPose at(double time_s, const FrameFaults& faults) {
    const Eigen::VectorXd numbers = path_.at(time_s);
    TrackerError error = noise_.next(time_s);
    Pose palm{numbers.head<3>(), turned_by(numbers.segment<3>(3))};
    palm = palm * error.palm;
    if ((side_ == Handedness::left) != faults.swapped) palm = mirrored(palm);
    HandAngles added = angles_in(numbers);
    for (std::size_t i = 0; i < kDigitCount; ++i) {
      for (std::size_t hinge = 0; hinge < kHingeCount; ++hinge) {
        added[i][hinge].flexion += error.angles[i][hinge].flexion;
        added[i][hinge].abduction += error.angles[i][hinge].abduction;
      }
    }
    palm = frame_ * palm;
    palm.position += faults.error.position;
    palm.rotation = (faults.error.rotation * palm.rotation).normalized();
    return moved(hand_.posed({}, added), palm);
  }

 private:
  Handedness side_;
  PosableHand hand_;
  TrackerNoise noise_;
  const SmoothPath& path_;
  Pose frame_;
};

/// The frame in which the path is told.
Result<Pose> path_frame(const BenchScene& scene, const LoadedObject& object) {
  if (scene.place.empty()) return Pose{};
  const Result<MeshPlace> place = object.place(scene.place);
  if (!place) return place.error();
  return place->pose;
}

}  // namespace

Quat turned_by(const Vec3& turn_rad) {
  return Quat(Eigen::AngleAxisd(turn_rad.y(), Vec3::UnitY()) *
              Eigen::AngleAxisd(turn_rad.x(), Vec3::UnitX()) *
              Eigen::AngleAxisd(turn_rad.z(), Vec3::UnitZ()));
}

Result<SuiteObject> load_scene_object(const BenchScene& scene) {
  if (!scene.object.empty()) return load_suite_object(scene.object);
  Result<LoadedObject> loaded = shape_object("scene/" + scene.name, {scene.soup, {{"origin", {}}}});
  if (!loaded) return loaded.error();
  return SuiteObject{std::move(loaded).value(), StrokeGuide::surface};
}

Result<CaseRecording> make_scene_recording(const BenchScene& scene, const SuiteObject& object) {
  const Result<HandPose> relaxed = load_relaxed_hand(Handedness::right);
  if (!relaxed) return relaxed.error();
  const Result<Pose> frame = path_frame(scene, object.loaded);
  if (!frame) return frame.error();
  const SmoothPath path =
      hand_path(scene, PosableHand(*relaxed, Handedness::right, scene.hand_scale));
  const std::optional<SmoothPath> moves = object_path(scene);
  std::array<SceneHand, 2> hands{SceneHand(scene, Handedness::left, *relaxed, path, *frame),
                                 SceneHand(scene, Handedness::right, *relaxed, path, *frame)};
  CaseRecording recording;
  recording.header.source = "scene";
  recording.header.hand_scale_known = true;
  recording.header.unknown_json = nlohmann::ordered_json{{"scene", scene.name}}.dump();
  if (moves) recording.placement = state_in(moves->at(0.0)).placement;
  const auto frames = std::llround(scene.path.back().time_s * scene.rate_hz) + 1;
  for (std::int64_t i = 0; i < frames; ++i) {
    const double time_s = static_cast<double>(i) / scene.rate_hz;
    const FrameFaults faults = faults_at(scene, time_s);
    RecordedFrame& recorded = recording.frames.emplace_back();
    recorded.time_ns = std::llround(1e9 * time_s);
    if (moves) recording.states.push_back(state_in(moves->at(time_s)));
    for (std::size_t side = 0; side < hands.size(); ++side) {
      if (faults.lost || !scene.hands[faults.swapped ? 1 - side : side]) continue;
      recorded.hands[side].emplace().pose = hands[side].at(time_s, faults);
    }
  }
  return recording;
}

}  // namespace nade
