#include "nade/eval/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "linkage_meter.h"
#include "nade/eval/press.h"
#include "nade/eval/wrist_offset.h"
#include "nade/io/assets.h"
#include "nade/io/hand_file.h"
#include "skin_probe.h"

namespace nade {
namespace {

constexpr double kSearch_m = 0.2;

ComparedMethod corrector_method(std::string name, Method method,
                                std::shared_ptr<const ProxyTuning> tuning = nullptr) {
  return {std::move(name), [method, tuning](const SolverContext& context) -> HandSolver {
            CorrectorOptions options;
            options.method = method;
            options.tuning = tuning;
            options.hand_length_m = context.hand_scale * context.flesh->hand_length_m;
            const auto corrector = std::make_shared<HandCorrector>(options);
            return [corrector](const HandPose& tracked, const Object& object,
                               std::int64_t time_ns) -> CorrectedHand {
              return corrector->update(tracked, object, time_ns);
            };
          }};
}

ComparedMethod wrist_offset_method() {
  return {"wrist-offset", [](const SolverContext& context) -> HandSolver {
            const auto offset = std::make_shared<WristOffset>(context.flesh, context.hand_scale);
            return [offset](const HandPose& tracked, const Object& object, std::int64_t) {
              CorrectedHand hand;
              hand.pose = offset->update(tracked, object);
              const bool moved = hand.pose[Joint::palm].position != tracked[Joint::palm].position;
              hand.status = moved ? HandStatus::corrected : HandStatus::free;
              return hand;
            };
          }};
}

/// One scale for each hand of a recording, as `nade measure` has it for the whole.
double median_scale(const CaseRecording& recording, const DrawnHands& hands) {
  QuantileSketch scales;
  for (const RecordedFrame& frame : recording.frames) {
    for (std::size_t side = 0; side < frame.hands.size(); ++side) {
      const auto& hand = frame.hands[side];
      if (hand && is_usable(hand->pose)) scales.add(hand_scale(hands.meshes[side], hand->pose));
    }
  }
  return scales.quantile(0.5).value_or(1.0);
}

/// How far tracked palms go along the surface while their skin is pressed in.
double pressed_path_m(const CaseRecording& recording, const SuiteObject& touched) {
  const Object object = touched.loaded.placed(recording.placement);
  double path_m = 0.0;
  for (std::size_t side = 0; side < 2; ++side) {
    SurfaceHint hint;
    Vec3 before = Vec3::Zero();
    bool was_pressed = false;
    for (const RecordedFrame& frame : recording.frames) {
      const auto& hand = frame.hands[side];
      const auto skin = hand ? palm_skin(hand->pose) : std::nullopt;
      const auto nearest = skin ? object.closest_point(*skin, kSearch_m, hint) : std::nullopt;
      const bool pressed = nearest && nearest->signed_distance < -kPressing_m;
      if (pressed && was_pressed) {
        path_m += along_surface(*skin - before, nearest->normal).norm();
      }
      if (skin) before = *skin;
      was_pressed = pressed;
    }
  }
  return path_m;
}

RecordedHand recorded(const CorrectedHand& corrected) {
  RecordedHand hand;
  hand.pose = corrected.pose;
  hand.status = corrected.status;
  for (std::size_t i = 0; i < kPartCount; ++i) {
    if (const auto& contact = corrected.contacts[i]) {
      hand.contact[i] = RecordedContact{contact->surface_point, contact->normal, contact->depth_m};
    }
  }
  return hand;
}

}  // namespace

Result<DrawnHands> load_drawn_hands() {
  DrawnHands hands;
  for (const Handedness side : {Handedness::left, Handedness::right}) {
    const Result<std::string> path = find_asset(fmt::format("hands/{}.glb", name_of(side)));
    if (!path) return path.error();
    Result<HandMesh> mesh = load_hand_mesh(*path, side);
    if (!mesh) return mesh.error();
    hands.flesh[index_of(side)] = std::make_shared<HandFlesh>(measure_flesh(*mesh));
    hands.meshes[index_of(side)] = std::move(mesh).value();
  }
  return hands;
}

std::vector<ComparedMethod> library_methods() {
  return {corrector_method("none", Method::none), paper_method(),
          corrector_method("nade", Method::nade), wrist_offset_method()};
}

ComparedMethod tuned_method(std::shared_ptr<const ProxyTuning> tuning) {
  return corrector_method("nade", Method::nade, std::move(tuning));
}

ComparedMethod paper_method() { return corrector_method("paper", Method::paper); }

CorrectedRecording correct(const CaseRecording& tracked, const SuiteObject& object,
                           const DrawnHands& hands, const ComparedMethod& method) {
  ObjectPlayer player(tracked, object);
  const double scale = median_scale(tracked, hands);
  std::array<HandSolver, 2> solvers;
  CorrectedRecording corrected;
  corrected.frames.reserve(tracked.frames.size());
  for (std::size_t i = 0; i < tracked.frames.size(); ++i) {
    const RecordedFrame& frame = tracked.frames[i];
    const Object& now = player.at(i);
    RecordedFrame& result = corrected.frames.emplace_back();
    result.time_ns = frame.time_ns;
    for (const Handedness side : {Handedness::left, Handedness::right}) {
      const auto& hand = frame.hands[index_of(side)];
      if (!hand) continue;
      HandSolver& solver = solvers[index_of(side)];
      if (!solver) {
        solver = method.make(
            {&object.loaded, tracked.placement, side, scale, hands.flesh[index_of(side)]});
      }
      const auto start = std::chrono::steady_clock::now();
      const CorrectedHand solved = solver(hand->pose, now, frame.time_ns);
      const std::chrono::duration<double, std::micro> took =
          std::chrono::steady_clock::now() - start;
      corrected.solve_us.add(took.count());
      result.hands[index_of(side)] = recorded(solved);
    }
  }
  return corrected;
}

Metrics measure(const CaseRecording& tracked, const SuiteObject& object, const DrawnHands& hands,
                const CorrectedRecording& corrected) {
  ObjectPlayer player(tracked, object);
  const MetricsOptions options{median_scale(tracked, hands)};
  std::array<MetricsMeter, 2> meters{MetricsMeter(hands.meshes[0], options),
                                     MetricsMeter(hands.meshes[1], options)};
  for (std::size_t i = 0; i < tracked.frames.size() && i < corrected.frames.size(); ++i) {
    const Object& now = player.at(i);
    for (std::size_t side = 0; side < meters.size(); ++side) {
      const auto& before = tracked.frames[i].hands[side];
      const auto& after = corrected.frames[i].hands[side];
      if (before && after && after->status != HandStatus::untracked) {
        meters[side].add(tracked.frames[i].time_ns, before->pose, after->pose, now);
      } else {
        meters[side].add_gap();
      }
    }
  }
  meters[0].merge(meters[1]);
  return meters[0].finish();
}

CaseScore score(const SuiteCase& suite_case, const CaseRecording& tracked,
                const SuiteObject& object, const DrawnHands& hands, const ComparedMethod& method) {
  const CorrectedRecording corrected = correct(tracked, object, hands, method);
  CaseScore result{measure(tracked, object, hands, corrected), corrected.solve_us.quantile(0.5),
                   corrected.solve_us.quantile(0.99)};
  const bool presses = !suite_case.clip && suite_case.synth.stroke == Stroke::press;
  const bool moves = !tracked.states.empty();
  if (presses || moves || pressed_path_m(tracked, object) < kShortestStroke_m) {
    result.metrics.linkage_gain.reset();
    result.metrics.linkage_r.reset();
    result.metrics.linkage_lag_ms.reset();
  }
  return result;
}

double badness(const MetricBounds& bounds, double value) {
  if (bounds.at_least && bounds.at_most) {
    return std::abs(value - 0.5 * (*bounds.at_least + *bounds.at_most));
  }
  if (bounds.at_least) return *bounds.at_least - value;
  return value - bounds.at_most.value_or(0.0);
}

}  // namespace nade
