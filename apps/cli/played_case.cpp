#include "played_case.h"

#include <utility>

#include "nade/eval/shapes.h"

namespace nade::cli {
namespace {

constexpr std::size_t kProbeEvery = 3;  // frames between those that are looked at for pressing

draw::StagedHands hands_of(const PlayedCase& played, std::size_t frame, std::size_t method,
                           const DrawnHands& drawn) {
  draw::StagedHands hands;
  for (std::size_t side = 0; side < 2; ++side) {
    const auto& tracked = played.tracked.frames[frame].hands[side];
    const auto& corrected = played.corrected[method].frames[frame].hands[side];
    if (!tracked || !corrected) continue;
    hands[side] = draw::StagedHand{tracked->pose,
                                   corrected->pose,
                                   {},
                                   hand_scale(drawn.meshes[side], tracked->pose),
                                   played.drawn[method]};
  }
  return hands;
}

}  // namespace

Result<PlayedCase> play_case(const std::array<ComparedMethod, 2>& methods,
                             const SuiteCase& suite_case, const DrawnHands& hands) {
  Result<SuiteObject> object = load_case_object(suite_case);
  if (!object) return object.error();
  Result<CaseRecording> tracked = make_recording(suite_case, *object);
  if (!tracked) return tracked.error();
  PlayedCase played{std::move(object).value(), std::move(tracked).value(), {}, {}};
  for (std::size_t m = 0; m < methods.size(); ++m) {
    played.corrected[m] = correct(played.tracked, played.object, hands, methods[m]);
    played.drawn[m] = method_from_name(methods[m].name).value_or(Method::none);
  }
  return played;
}

std::vector<std::size_t> pressing_frames(const PlayedCase& played, const DrawnHands& hands) {
  std::vector<std::size_t> pressing;
  ObjectPlayer player(played.tracked, played.object);
  for (std::size_t i = 0; i < played.tracked.frames.size(); i += kProbeEvery) {
    const RecordedFrame& frame = played.tracked.frames[i];
    for (std::size_t side = 0; side < 2; ++side) {
      const auto& hand = frame.hands[side];
      if (!hand || !played.corrected[0].frames[i].hands[side]) continue;
      MetricsMeter meter(hands.meshes[side], {hand_scale(hands.meshes[side], hand->pose)});
      if (meter.add(frame.time_ns, hand->pose, hand->pose, player.at(i)).penetration_mm) {
        pressing.push_back(i);
        break;
      }
    }
  }
  return pressing;
}

HandsByMethod hands_in(const PlayedCase& played, std::size_t frame, const DrawnHands& drawn) {
  return {hands_of(played, frame, 0, drawn), hands_of(played, frame, 1, drawn)};
}

Status CaseStager::set_frame(std::size_t frame) {
  const CaseRecording& tracked = played_.tracked;
  const bool still = frame >= tracked.states.size();
  const Placement& placement = still ? tracked.placement : tracked.states[frame].placement;
  const LoadedObject& loaded = played_.object.loaded;
  if (still || tracked.states[frame].stretch == Vec3::Ones() || !loaded.soup) {
    if (!std::exchange(rests_, true)) return stage_.set_object(loaded, placement);
    stage_.set_placement(placement);
    return ok_status();
  }
  rests_ = false;
  MeshFile shape{stretched(*loaded.soup, tracked.states[frame].stretch), {}};
  Result<LoadedObject> now = shape_object(loaded.spec, std::move(shape));
  if (!now) return now.error();
  stretched_ = std::move(now).value();
  return stage_.set_object(*stretched_, placement);
}

}  // namespace nade::cli
