#include "performance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "console.h"
#include "nade/eval/quantile.h"

namespace nade::cli {
namespace {

constexpr std::size_t kGlimpses = 20'000;
constexpr std::int64_t kLongestGapNs = 200'000'000;
/// Palms this much less deep than the deepest count as being as deep.
constexpr double kSameDepth = 0.0005;
constexpr double kReach = 0.5;

std::optional<Glimpse> glimpse_of(const RecordedFrame& frame) {
  Glimpse glimpse;
  glimpse.time_ns = frame.time_ns;
  double count = 0.0;
  for (std::size_t side = 0; side < frame.hands.size(); ++side) {
    if (!frame.hands[side]) continue;
    const HandPose& hand = frame.hands[side]->pose;
    glimpse.center += hand[Joint::palm].position;
    glimpse.wrist += hand[Joint::wrist].position;
    glimpse.knuckle += hand[Joint::middle_proximal].position;
    glimpse.palms[side] = palm_skin(hand);
    count += 1.0;
  }
  if (count == 0.0) return std::nullopt;
  glimpse.center /= count;
  glimpse.wrist /= count;
  glimpse.knuckle /= count;
  return glimpse;
}

/// Keeps every frame, then every second, every fourth …
class Thinning {
 public:
  void add(Glimpse glimpse, std::vector<Glimpse>& kept) {
    if (seen_++ % stride_ != 0) return;
    kept.push_back(glimpse);
    if (kept.size() < kGlimpses) return;
    for (std::size_t i = 0; 2 * i < kept.size(); ++i) kept[i] = kept[2 * i];
    kept.resize((kept.size() + 1) / 2);
    stride_ *= 2;
  }

 private:
  std::size_t stride_ = 1;
  std::size_t seen_ = 0;
};

double palm_depth(const Glimpse& glimpse, const Object& object) {
  double deepest = -kReach;
  for (const auto& palm : glimpse.palms) {
    SurfaceHint hint;
    const auto near = palm ? object.closest_point(*palm, kReach, hint) : std::nullopt;
    if (near) deepest = std::max(deepest, -near->signed_distance);
  }
  return deepest;
}

/// A contact as recorded, with what a recording leaves out put back as near as can be.
Contacts contacts_of(const RecordedHand& corrected, const HandPose& tracked) {
  const SkinDepths skin = generic_skin_depths();
  const double scale = hand_length(tracked) / kGenericHandLength;
  Contacts contacts;
  for (std::size_t i = 0; i < kPartCount; ++i) {
    if (!corrected.contact[i]) continue;
    const RecordedContact& recorded = *corrected.contact[i];
    const Pose& joint = tracked[joint_of(part_at(i))];
    PartContact contact;
    contact.surface_point = recorded.point;
    contact.normal = recorded.normal;
    contact.depth_m = recorded.depth_m;
    contact.skin_depth_m = scale * skin.depth_m[i];
    contact.ray_origin = joint.position - contact.skin_depth_m * tracked.back();
    const Vec3 along = recorded.point - contact.ray_origin;
    contact.ray_direction = along.norm() > 1e-9 ? Vec3(along.normalized()) : tracked.back();
    contact.target = corrected.pose[joint_of(part_at(i))].position;
    contacts[i] = contact;
  }
  return contacts;
}

HandPose blended(const HandPose& a, const HandPose& b, double share) {
  HandPose hand = a;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    hand.joints[i].position += share * (b.joints[i].position - a.joints[i].position);
    hand.joints[i].rotation = a.joints[i].rotation.slerp(share, b.joints[i].rotation);
  }
  return hand;
}

Moment blended(const Moment& a, const Moment& b, std::int64_t time_ns) {
  const std::int64_t gap = b.time_ns - a.time_ns;
  const double share = static_cast<double>(time_ns - a.time_ns) / static_cast<double>(gap);
  Moment moment;
  moment.time_ns = time_ns;
  for (std::size_t side = 0; side < moment.hands.size(); ++side) {
    const auto& from = a.hands[side];
    const auto& to = b.hands[side];
    if (!from || !to || gap > kLongestGapNs) {
      if (time_ns - a.time_ns <= kLongestGapNs) moment.hands[side] = from;
      continue;
    }
    moment.hands[side] = share < 0.5 ? from : to;
    moment.hands[side]->tracked = blended(from->tracked, to->tracked, share);
    moment.hands[side]->corrected = blended(from->corrected, to->corrected, share);
  }
  return moment;
}

}  // namespace

Result<Survey> survey(const std::string& path, const draw::HandMeshes& meshes) {
  Result<RecordingReader> reader = RecordingReader::open(path);
  if (!reader) return reader.error();
  Survey seen;
  Thinning thinning;
  std::array<QuantileSketch, 2> scales;
  while (true) {
    const Result<std::optional<RecordedFrame>> frame = reader->next();
    if (!frame) return frame.error();
    if (!frame->has_value()) break;
    if (seen.frames++ == 0) seen.first_ns = (*frame)->time_ns;
    seen.last_ns = (*frame)->time_ns;
    seen.palms.add(**frame);
    if (const auto glimpse = glimpse_of(**frame)) thinning.add(*glimpse, seen.glimpses);
    for (std::size_t side = 0; side < meshes.size(); ++side) {
      const auto& hand = (*frame)->hands[side];
      if (hand) scales[side].add(hand_scale(meshes[side], hand->pose));
    }
  }
  for (const std::string& warning : reader->warnings()) warn(warning);
  for (std::size_t side = 0; side < meshes.size(); ++side) {
    seen.scale[side] = scales[side].quantile(0.5).value_or(1.0);
  }
  return seen;
}

std::optional<std::int64_t> deepest_press(const Survey& survey, const Object& object) {
  double deepest = -std::numeric_limits<double>::infinity();
  std::vector<double> depths;
  for (const Glimpse& glimpse : survey.glimpses) {
    depths.push_back(palm_depth(glimpse, object));
    deepest = std::max(deepest, depths.back());
  }
  std::vector<std::int64_t> times;
  for (std::size_t i = 0; i < depths.size(); ++i) {
    if (depths[i] >= deepest - kSameDepth) times.push_back(survey.glimpses[i].time_ns);
  }
  if (times.empty()) return std::nullopt;
  return times[times.size() / 2];
}

Result<std::optional<std::int64_t>> time_of_frame(const std::string& path, std::size_t frame) {
  Result<RecordingReader> reader = RecordingReader::open(path);
  if (!reader) return reader.error();
  while (true) {
    const Result<std::optional<RecordedFrame>> next = reader->next();
    if (!next) return next.error();
    if (!next->has_value()) return std::optional<std::int64_t>();
    if (frame-- == 0) return std::optional((*next)->time_ns);
  }
}

MomentReader::MomentReader(const Performance& performance, PlacedObject& placed,
                           RecordingReader tracked)
    : performance_(performance),
      placed_(&placed),
      tracked_(std::move(tracked)),
      correctors_{HandCorrector(performance.method), HandCorrector(performance.method)} {}

Result<MomentReader> MomentReader::open(const Performance& performance, PlacedObject& placed) {
  Result<RecordingReader> tracked = RecordingReader::open(performance.recording);
  if (!tracked) return tracked.error();
  MomentReader reader(performance, placed, std::move(tracked).value());
  if (performance.corrected) {
    Result<RecordingReader> corrected = RecordingReader::open(*performance.corrected);
    if (!corrected) return corrected.error();
    reader.corrected_ = std::move(corrected).value();
  }
  return reader;
}

Status MomentReader::find_partner(std::int64_t time_ns) {
  while (!partner_ || partner_->time_ns < time_ns) {
    Result<std::optional<RecordedFrame>> next = corrected_->next();
    if (!next) return next.error();
    partner_ = std::move(next).value();
    if (!partner_) break;
  }
  if (partner_ && partner_->time_ns == time_ns) return ok_status();
  return Error{ErrorCode::bad_value,
               fmt::format("{}: expected the corrected form of {}, found no frame of the time {}",
                           *performance_.corrected, performance_.recording, time_ns)};
}

Result<std::optional<Moment>> MomentReader::next() {
  Result<std::optional<RecordedFrame>> frame = tracked_.next();
  if (!frame) return frame.error();
  if (!frame->has_value()) return std::optional<Moment>();
  Moment moment;
  moment.time_ns = (*frame)->time_ns;
  if (corrected_) {
    const Status found = find_partner(moment.time_ns);
    if (!found) return found.error();
  } else {
    placed_->move_to(moment.time_ns);
  }
  const Object object = placed_->object();
  for (std::size_t side = 0; side < moment.hands.size(); ++side) {
    const auto& hand = (*frame)->hands[side];
    if (!hand) continue;
    draw::StagedHand staged{hand->pose, hand->pose, contacts_of(*hand, hand->pose),
                            performance_.scale[side], performance_.drawn};
    if (corrected_) {
      if (const auto& corrected = partner_->hands[side]) {
        staged.corrected = corrected->pose;
        staged.contacts = contacts_of(*corrected, hand->pose);
      }
    } else if (performance_.method.method != Method::none) {
      const CorrectedHand& corrected = correctors_[side].update(hand->pose, object, moment.time_ns);
      staged.corrected = corrected.pose;
      staged.contacts = corrected.contacts;
    }
    moment.hands[side] = staged;
  }
  return std::optional(moment);
}

Result<Moment> MomentSampler::at(std::int64_t time_ns) {
  while (!started_ || (after_ && after_->time_ns <= time_ns)) {
    started_ = true;
    before_ = std::move(after_);
    Result<std::optional<Moment>> next = reader_.next();
    if (!next) return next.error();
    after_ = std::move(next).value();
    if (!after_) break;
  }
  if (before_ && after_) return blended(*before_, *after_, time_ns);
  Moment moment = before_.value_or(Moment{});
  if (time_ns - moment.time_ns > kLongestGapNs) moment.hands = {};
  moment.time_ns = time_ns;
  return moment;
}

}  // namespace nade::cli
