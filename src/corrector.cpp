#include "nade/corrector.h"

// Based on: Yanagida, Mori, Toyama. Composition of CG Hand Images for Visual Feedback of Contact
// Sensation in Stroking Motion. 2023.

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "hand/carry_over.h"
#include "nade/assert.h"
#include "proxy/proxy_hand.h"
#include "ramps.h"
#include "surface/near_objects.h"
#include "surface/query_steps.h"

namespace nade {
namespace {

/// A correction that changes by more than this many times the tracked hand's own motion, and
/// the margin, has jumped. The motion counts up to a limit: beyond it the hand itself jumped.
constexpr double kJumpRatio = 4.0;
constexpr double kJumpMargin_m = 0.002;
constexpr double kLongestMotion_m = 0.03;
/// A hand that was missing for longer is found anew. By the paper's method, when the release of
/// what it had is over, but no sooner than the second.
constexpr double kLongestGap_s = 1.0;
constexpr double kShortestGap_s = 0.1;
/// A clock that goes back by no more than this was read late before, or foretold too far.
constexpr double kLateClock_s = 0.025;
/// The mean hand length forgets frames older than about this many.
constexpr std::int64_t kLengthFrames = 512;
/// Where so many in a row are all longer, or shorter, by more than this share, it forgets those
/// before them.
constexpr std::int64_t kOtherLengthFrames = 30;
constexpr double kOtherLength = 0.02;

/// A hand that the paper's method would draw farther off is in something that is no object of a
/// hand's, or placed absurdly.
constexpr double kFarthestCorrection_m = 10.0;

constexpr double kThinnestTip_m = 0.003;
constexpr double kThickestTip_m = 0.015;
constexpr double kSameRadius_m = 1e-4;

/// `first` as a change on top of `second`.
Correction difference(const Correction& first, const Correction& second) {
  Correction result;
  result.palm.shift = first.palm.shift - second.palm.shift;
  result.palm.turn = first.palm.turn * second.palm.turn.conjugate();
  for (std::size_t d = 0; d < kDigitCount; ++d) result.bend[d] = first.bend[d] - second.bend[d];
  return result;
}

Correction sum(const Correction& base, const Correction& change, double share) {
  Correction result;
  const Eigen::AngleAxisd turn{change.palm.turn};
  result.palm.shift = base.palm.shift + share * change.palm.shift;
  result.palm.turn =
      (Quat(Eigen::AngleAxisd(share * turn.angle(), turn.axis())) * base.palm.turn).normalized();
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    result.bend[d] = base.bend[d] + share * change.bend[d];
  }
  return result;
}

/// 1 at the start of a release, 0 at its end, smooth at both.
double share_left(double elapsed_s, double release_s) {
  return elapsed_s < release_s ? 1.0 - smoothstep(0.0, release_s, elapsed_s) : 0.0;
}

/// `to_ns` is not before `from_ns`; times of any origin may be farther apart than their type holds.
double seconds(std::int64_t from_ns, std::int64_t to_ns) {
  return 1e-9 * static_cast<double>(static_cast<std::uint64_t>(to_ns) -
                                    static_cast<std::uint64_t>(from_ns));
}

bool is_just_before(std::int64_t time_ns, std::int64_t last_ns) {
  return time_ns < last_ns && seconds(time_ns, last_ns) <= kLateClock_s;
}

/// What carries the skin of a part.
Joint bone_of(Part part) {
  const Joint joint = joint_of(part);
  return part == Part::palm ? joint : joint_at(index_of(joint) - 1);
}

/// Another hand at the same time counts as one of so much later.
constexpr double kShortestFrame_s = 0.001;

/// Not where it is no number either.
bool is_near(const HandPose& drawn, const HandPose& tracked) {
  for (std::size_t i = 0; i < kJointCount; ++i) {
    const Vec3 way = drawn.joints[i].position - tracked.joints[i].position;
    if (!(way.norm() <= kFarthestCorrection_m)) return false;
    if (!drawn.joints[i].rotation.coeffs().allFinite()) return false;
  }
  return true;
}

/// What was remembered of one object of a scene, seen from another.
void go_on_at(const CarrierBefore& carrier, ContactMemory& memory) {
  if (memory.held_palm_ray) {
    memory.held_palm_ray = carrier.from_other.rotation * *memory.held_palm_ray;
  }
  for (std::optional<Vec3>& point : memory.last_point) {
    if (!point) continue;
    point = carrier.from_other.apply(carrier.other_scale * *point) / carrier.placement.scale;
  }
}

bool touches(const Contacts& contacts) {
  return std::any_of(contacts.begin(), contacts.end(),
                     [](const auto& contact) { return contact.has_value(); });
}

}  // namespace

std::array<Vec3, kJointCount> no_velocity() noexcept {
  std::array<Vec3, kJointCount> velocity;
  velocity.fill(Vec3::Zero());
  return velocity;
}

std::optional<SkinDepths> believable_radii(const HandPose& hand) noexcept {
  const auto [least, most] = std::minmax_element(hand.radius.begin(), hand.radius.end());
  if (!(*most - *least >= kSameRadius_m)) return std::nullopt;
  SkinDepths depths;
  for (std::size_t i = 1; i < kPartCount; ++i) {
    const double radius = hand.radius[index_of(joint_of(part_at(i)))];
    if (!(radius >= kThinnestTip_m && radius <= kThickestTip_m)) return std::nullopt;
    depths.depth_m[i] = radius;
  }
  return depths;
}

HandCorrector::HandCorrector(const CorrectorOptions& options)
    : options_(options), near_(std::make_unique<NearObjects>()) {
  NADE_ASSERT(check_options(options).ok());
  if (options.method != Method::nade) return;
  for (const Handedness side : {Handedness::left, Handedness::right}) {
    proxies_[index_of(side)] = std::make_unique<ProxyHand>(
        flesh_of(side), options.tuning ? *options.tuning : ProxyTuning{});
  }
}
HandCorrector::HandCorrector(HandCorrector&&) noexcept = default;
HandCorrector& HandCorrector::operator=(HandCorrector&&) noexcept = default;
HandCorrector::~HandCorrector() = default;

void HandCorrector::set_settle(const SettleOptions& settle) noexcept {
  NADE_ASSERT(check_options(settle).ok());
  answered_.reset();
  options_.settle = settle;
}

void HandCorrector::reset() noexcept {
  contact_memory_ = {};
  forget_proxies();
  near_->forget();
  shown_.reset();
  answered_.reset();
  last_.reset();
  release_start_ns_.reset();
  hand_length_m_ = 0.0;
  frames_ = frames_longer_ = 0;
}

const CorrectedHand& HandCorrector::update(const HandPose& tracked, const Object& object,
                                           std::int64_t time_ns) noexcept {
  const Question question{
      tracked, object.identity(), object.placement(), object.surface().shape(), 0, time_ns};
  if (answered_ == question) return result_;
  answered_ = question;
  answer(tracked, &object, time_ns);
  return result_;
}

const CorrectedHand& HandCorrector::update(const HandPose& tracked, const Scene& scene,
                                           std::int64_t time_ns) noexcept {
  const NearObjects::Version version = near_->version_of(scene);
  const Question question{tracked,        {nullptr, version.scene}, {},
                          version.shapes, version.changes,          time_ns};
  if (answered_ == question) return result_;
  answer(tracked, &scene, time_ns);
  answered_ = question;
  answered_->shape = near_->version_of(scene).shapes;  // other objects are near now
  return result_;
}

void HandCorrector::answer(const HandPose& tracked, Touchable objects,
                           std::int64_t time_ns) noexcept {
  std::optional<HandFault> fault = fault_of(tracked);
  if (!fault) return correct(tracked, objects, time_ns);
  const HandPose unit = with_unit_rotations(tracked);
  fault = fault_of(unit);
  if (!fault) return correct(unit, objects, time_ns);
  result_ = {tracked, HandStatus::untracked, fault, {}, {}};
}

HandPose HandCorrector::preview(const HandPose& tracked) const noexcept {
  const bool corrected =
      result_.status == HandStatus::corrected || result_.status == HandStatus::released;
  if (!answered_ || !corrected || tracked.side != result_.pose.side) return tracked;
  const HandPose newer = with_unit_rotations(tracked);
  if (fault_of(newer)) return tracked;
  return carried_over(with_unit_rotations(answered_->tracked), result_.pose, newer);
}

void HandCorrector::correct(const HandPose& tracked, Touchable objects,
                            std::int64_t time_ns) noexcept {
  result_ = {tracked, HandStatus::free, {}, {}, {}};
  if (options_.method == Method::none) return;
  if (last_ && is_just_before(time_ns, last_->time_ns)) time_ns = last_->time_ns;
  start_frame(tracked, time_ns);
  const detail::StepLimit limit(detail::kMostFrameSteps);
  const Scene* const* const scene = std::get_if<const Scene*>(&objects);
  if (scene != nullptr) {
    near_->gather(**scene, tracked, shown_ ? &shown_->drawn : nullptr);
  } else {
    near_->forget();
  }
  const Object object = scene != nullptr ? near_->object() : *std::get<const Object*>(objects);
  if (options_.method == Method::paper) correct_by_paper(tracked, object, time_ns);
  if (options_.method == Method::nade) follow_proxy(tracked, object, time_ns);
  if (limit.is_used_up()) {
    // What was found before it was used up and what was not do not make a hand.
    reset();
    result_ = {tracked, HandStatus::free, {}, {}, {}};
    return;
  }
  measure_motion(object, time_ns);
}

void HandCorrector::add_contact(const SkinContact& contact, std::size_t place) noexcept {
  touched_[result_.skin_contact_count] = place;
  result_.skin_contacts[result_.skin_contact_count++] = contact;
}

/// Those of method paper.
void HandCorrector::add_part_contacts() noexcept {
  for (std::size_t i = 0; i < kPartCount; ++i) {
    const std::optional<PartContact>& part = result_.contacts[i];
    if (!part) continue;
    SkinContact contact;
    contact.bone = bone_of(part_at(i));
    contact.point = part->surface_point;
    contact.normal = part->normal;
    contact.depth_m = std::max(0.0, part->depth_m);
    add_contact(contact, near_->nearest_to(contact.point));
  }
}

/// How the drawn hand goes, in the world and against what it touches; and whom that is.
void HandCorrector::measure_motion(const Object& object, std::int64_t time_ns) noexcept {
  const std::optional<Shown> before =
      std::exchange(shown_, Shown{result_.pose, object.identity(), object.placement(), time_ns});
  const double frame_s =
      before ? std::max(kShortestFrame_s, seconds(before->time_ns, time_ns)) : kShortestFrame_s;
  const auto contacts = std::span(result_.skin_contacts).first(result_.skin_contact_count);
  for (std::size_t i = 0; i < kJointCount && before; ++i) {
    result_.velocity_mps[i] =
        (result_.pose.joints[i].position - before->drawn.joints[i].position) / frame_s;
  }
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    SkinContact& contact = contacts[i];
    contact.object = near_->has_scene() ? near_->id_of(touched_[i]) : object.identity().instance;
    if (!before) continue;
    const Vec3 on_bone = result_.pose[contact.bone].inverse().apply(contact.point);
    const Vec3 skin_mps = (contact.point - before->drawn[contact.bone].apply(on_bone)) / frame_s;
    Vec3 object_mps = Vec3::Zero();
    if (near_->has_scene()) {
      object_mps = near_->velocity_of(touched_[i], contact.point, frame_s);
    } else if (before->object == object.identity()) {
      object_mps = velocity_at(contact.point, before->placement, object.placement(), frame_s);
    }
    contact.velocity_mps = skin_mps - object_mps;
  }
  const auto deepest = std::max_element(
      contacts.begin(), contacts.end(),
      [](const SkinContact& one, const SkinContact& other) { return one.depth_m < other.depth_m; });
  if (deepest != contacts.end()) {
    std::swap(touched_[0], touched_[static_cast<std::size_t>(deepest - contacts.begin())]);
  }
  if (near_->has_scene()) near_->touch(std::span(touched_).first(contacts.size()));
}

void HandCorrector::correct_by_paper(const HandPose& tracked, const Object& object,
                                     std::int64_t time_ns) noexcept {
  const std::optional<CarrierBefore> carrier = near_->rearrangement().carrier;
  if (carrier) {
    go_on_at(*carrier, contact_memory_);
  } else if (object.identity() != met_) {
    contact_memory_ = {};
  }
  met_ = object.identity();
  Contacts contacts =
      find_contacts(tracked, skin_of(tracked), object, options_.contact, contact_memory_);
  const SeatedPalm seated = seat_palm(tracked, contacts[index_of(Part::palm)]);
  const LaidFingers laid = lay_fingers(tracked, seated.hand, object, options_.fingers, contacts);

  if (!is_near(laid.hand, tracked)) {
    contact_memory_ = {};
    release(tracked, {}, time_ns);
    return;
  }
  result_.pose = laid.hand;
  result_.contacts = contacts;
  result_.ray_turn_rad = laid.ray_turn_rad;
  add_part_contacts();
  if (touches(contacts)) result_.status = HandStatus::corrected;
  release(tracked, {seated.correction, laid.bend}, time_ns);
}

void HandCorrector::follow_proxy(const HandPose& tracked, const Object& object,
                                 std::int64_t time_ns) noexcept {
  const double since_last_s = last_ ? seconds(last_->time_ns, time_ns) : 0.0;
  const double scale = hand_length_m_ / flesh_of(tracked.side).hand_length_m;
  const ProxyResult proxy = proxies_[index_of(tracked.side)]->update(
      tracked, scale, object, near_->rearrangement(), since_last_s,
      near_->has_scene() ? near_->feel() : options_.settle);
  result_.pose = proxy.hand;
  result_.contacts = proxy.contacts;
  for (const BoneContact& bone : std::span(proxy.bones).first(proxy.bone_count)) {
    add_contact({0, bone.bone, bone.point, bone.normal, bone.depth_m, Vec3::Zero()},
                NearObjects::place_of(bone.hint));
  }
  if (proxy.touches) {
    result_.status = HandStatus::corrected;
  } else if (proxy.corrected) {
    result_.status = HandStatus::released;
  }
  last_ = Frame{tracked, {}, time_ns};
}

void HandCorrector::forget_proxies() noexcept {
  for (const std::unique_ptr<ProxyHand>& proxy : proxies_) {
    if (proxy) proxy->forget();
  }
}

void HandCorrector::start_frame(const HandPose& tracked, std::int64_t time_ns) noexcept {
  const bool goes_on = last_ && last_->tracked.side == tracked.side && time_ns >= last_->time_ns;
  if (!goes_on) reset();
  // What was touched before a gap says nothing about where the hand comes back.
  const double longest_gap_s = options_.method == Method::nade
                                   ? kLongestGap_s
                                   : std::max(options_.release_s, kShortestGap_s);
  if (last_ && seconds(last_->time_ns, time_ns) > longest_gap_s) {
    contact_memory_ = {};
    forget_proxies();
    near_->forget();
    shown_.reset();
    last_.reset();
    release_start_ns_.reset();
  }
  follow_length(hand_length(tracked));
}

/// A tracker that has measured the hand anew says another length in every frame from then on.
void HandCorrector::follow_length(double length_m) noexcept {
  const double longer_m = length_m - hand_length_m_;
  const bool same = std::abs(longer_m) < kOtherLength * hand_length_m_;
  if (same || (longer_m > 0.0) != (frames_longer_ > 0)) frames_longer_ = 0;
  if (!same) frames_longer_ += longer_m > 0.0 ? 1 : -1;
  const bool is_other = std::abs(frames_longer_) > kOtherLengthFrames;
  if (is_other) frames_ = std::min(frames_, kOtherLengthFrames);
  frames_ = std::min(frames_ + 1, kLengthFrames);
  hand_length_m_ += longer_m / static_cast<double>(frames_);
  if (options_.hand_length_m > 0.0) hand_length_m_ = options_.hand_length_m;
}

const HandFlesh& HandCorrector::flesh_of(Handedness side) const {
  const std::shared_ptr<const HandFlesh>& own = options_.flesh[index_of(side)];
  return own ? *own : generic_flesh(side);
}

SkinDepths HandCorrector::skin_of(const HandPose& tracked) const noexcept {
  SkinDepths skin = options_.skin;
  for (double& depth_m : skin.depth_m) depth_m *= hand_length_m_ / options_.skin_hand_length_m;
  if (options_.skin_source == SkinSource::mesh) return skin;
  if (const std::optional<SkinDepths> radii = believable_radii(tracked)) {
    for (std::size_t i = 1; i < kPartCount; ++i) skin.depth_m[i] = radii->depth_m[i];
  }
  return skin;
}

void HandCorrector::release(const HandPose& tracked, const Correction& correction,
                            std::int64_t time_ns) noexcept {
  if (last_ && options_.release_s > 0.0) {
    const double tracked_motion_m = largest_motion(last_->tracked, tracked);
    const double jump_m = largest_motion(apply(last_->correction, tracked), result_.pose);
    if (jump_m > kJumpRatio * std::min(tracked_motion_m, kLongestMotion_m) + kJumpMargin_m) {
      Correction drawn = last_->correction;
      if (release_start_ns_) {
        const double before_s = seconds(*release_start_ns_, last_->time_ns);
        drawn = sum(drawn, residue_, share_left(before_s, options_.release_s));
      }
      residue_ = difference(drawn, correction);
      release_start_ns_ = last_->time_ns;
    }
  }
  last_ = Frame{tracked, correction, time_ns};
  if (!release_start_ns_) return;
  const double share = share_left(seconds(*release_start_ns_, time_ns), options_.release_s);
  if (share == 0.0) {
    release_start_ns_.reset();
    return;
  }
  result_.pose = apply(sum(correction, residue_, share), tracked);
  if (result_.status == HandStatus::free) result_.status = HandStatus::released;
}

}  // namespace nade
