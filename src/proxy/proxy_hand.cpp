#include "proxy_hand.h"

#include <algorithm>
#include <cmath>

#include "contact_finder.h"
#include "coupling.h"
#include "deformation.h"
#include "digit_contact.h"
#include "friction.h"
#include "hand/posed_hand.h"
#include "hand/step.h"
#include "inertia.h"
#include "mode.h"
#include "nade/assert.h"
#include "ramps.h"
#include "touch_report.h"
#include "way_out.h"

namespace nade {
namespace {

// Behaviour's numbers are in tuning.h. Here are fractions of them, and numerics.

/// Skin farther than this from pushing, and than this share of what the hand has moved, does not
/// come to it in the frame.
constexpr double kReach_m = 0.001;
constexpr double kReachOfMotion = 0.5;
/// Of a hand that is found anew.
constexpr double kFirstReach_m = 0.02;
/// One that was missing for long is found anew, unless it presses on: it was in the object, has not
/// come out, and is no farther from there than this.
constexpr double kPressesOn_m = 0.08;

constexpr int kRounds = 3;
constexpr int kHoldPasses = 3;
constexpr int kFirstRounds = 40;
/// A round is the last in which no skin that had no term can have come to touch, and whose step is
/// no longer than this: what the rows say is good for no longer ones.
constexpr double kLongestStep_m = 0.002;
/// Each round of a hand that is found anew makes shorter steps by this factor; the last moves no
/// skin farther than so.
constexpr double kShorterSteps = 0.85;
constexpr double kFirstSettled_m = 1e-4;
constexpr double kFirstTurn_rad = 0.3;
constexpr double kFirstShift_m = 0.05;
/// In the air, a correction smaller than this is over.
constexpr double kReleased_m = 1e-4;
/// A hand that nothing has held for this share of `return_s` is surely in the air. There it is
/// coupled more firmly, and comes home by up to so many times the speed of one at rest, or the
/// person's and a little.
constexpr double kInAirShare = 0.5;
constexpr double kFirmerInAir = 4.0;
constexpr double kHomeFaster = 5.0;
constexpr double kFasterInAir = 1.4;
/// On the surface, what is noticed of a shift comes back in so many times `return_s`, by up to so
/// many times the speed of a hand at rest.
constexpr double kCatchUpLonger = 1.5;
constexpr double kCatchUpFaster = 10.0;

}  // namespace

/// One frame's work, in the object's frame.
class ProxyFrame {
 public:
  ProxyFrame(const SeenHand& seen, const std::optional<ShownBefore>& before, const HandFlesh& flesh,
             const ProxyTuning& tuning, double scale, const ScaledSurface& object,
             const Rearrangement& around, double seconds, const SettleOptions& options,
             ProxyState& state)
      : tuning_(tuning),
        object_(object),
        around_(around),
        seen_(seen),
        before_(before),
        options_(options),
        state_(state),
        model_(measure_model(seen.tracked, scale)),
        search_{flesh, object, tuning, pose_flesh(seen.tracked, scale), {}, scale},
        since_last_s_(seconds),
        seconds_(frame_seconds(seconds, state.clock)) {
    limit_back_bend(model_);
  }

  ProxyResult run() {
    follow_object();
    follow_person();
    start();
    settle();
    if (!found_anew_ && is_displaced()) {
      start_anew();
      settle();
    }
    return finish();
  }

 private:
  void follow_object();
  void follow_person();
  [[nodiscard]] bool is_found_anew() const;
  void start();
  void start_anew();
  [[nodiscard]] double find_sink();
  void settle();
  void look_along();
  [[nodiscard]] double in_air() const;
  [[nodiscard]] double farthest_way() const;
  [[nodiscard]] Springs springs_at(const PosedHand& posed) const;
  [[nodiscard]] StepRange range_at(int round) const;
  void take_step(const PosedHand& posed, int round);
  [[nodiscard]] bool is_pushed(const HandFreedoms& step) const;
  void remember_touch();
  void remember_frame(const HandPose& drawn);
  [[nodiscard]] bool is_displaced() const;
  [[nodiscard]] HandPose on_its_way_back(const HandPose& settled);
  ProxyResult finish();

  const ProxyTuning& tuning_;
  const ScaledSurface& object_;
  const Rearrangement& around_;
  const SeenHand& seen_;
  const std::optional<ShownBefore>& before_;
  const SettleOptions& options_;
  ProxyState& state_;
  HandModel model_;
  ContactSearch search_;
  double since_last_s_;  ///< as it is
  double seconds_;       ///< as it counts

  bool deformed_ = false;  ///< whether the object has another shape or size than it had
  bool stirred_ = false;   ///< whether something beside it, and near the hand, moved
  bool replaced_ = false;  ///< whether the object, or what is near, is another than it was
  bool jumped_ = false;    ///< whether the tracked hand did
  bool found_anew_ = false;
  std::optional<Correction> let_go_from_;  ///< that it had when it was let go in this frame
  double motion_m_ = 0.0;                  ///< of the tracked hand since the last frame
  JointVectors coasted_{};                 ///< where the drawn joints would go on to
  Vec3 lag_ = Vec3::Zero();                ///< how much friction holds back, more than it did
  Vec3 normal_ = Vec3::Zero();             ///< of the surface, at the frame's start
  Vec3 catch_up_ = Vec3::Zero();           ///< along it, what comes back of the shift
  Correction correction_;
  PosedHand posed_;
  HandFreedoms step_ = HandFreedoms::Zero();  ///< the last round's
  FoundContacts found_;
  bool pushed_ = false;  ///< whether the object pushes or draws the hand
};

/// The object may have deformed, and taken the hand along.
void ProxyFrame::follow_object() {
  deformed_ = object_.scale() != state_.scale || object_.surface().shape() != state_.shape;
  replaced_ = seen_.at_another && !around_.carrier;
  if (!state_.last) return;
  for (const NearChange& change : around_.changes) {
    forget_near(change, around_.hand_radius_m, state_);
    if (!is_under_hand(change, state_)) continue;
    stirred_ = true;
    replaced_ = replaced_ || change.sudden;
  }
  if (deformed_ || stirred_) ride_along(object_, seconds_, state_);
}

/// How the tracked hand moves against it.
void ProxyFrame::follow_person() {
  if (!state_.last) {
    state_.motion.jumps_from = {};  // from who knows when
    return;
  }
  jumped_ = since_last_s_ <= kMissing_s && follow_jump(model_.tracked, seconds_, state_);
  motion_m_ = largest_motion(state_.last->tracked, model_.tracked);
  state_.way_m += motion_m_;
}

/// Whether the last frame says nothing about where the hand is.
bool ProxyFrame::is_found_anew() const {
  if (!state_.last) return true;
  const Vec3& palm = model_.tracked[Joint::palm].position;
  const double growth = std::abs(object_.scale() / state_.scale - 1.0);
  if (!(motion_m_ + growth * palm.norm() <= kTeleport_m)) return true;
  if ((deformed_ || stirred_ || replaced_) && is_swallowed(object_, state_)) return true;
  if (since_last_s_ <= kMissing_s) return false;
  const Vec3 way = palm - state_.last->tracked[Joint::palm].position;
  return state_.mode != ProxyMode::contact || motion_m_ > kPressesOn_m ||
         state_.touch.normal.dot(way) > state_.touch.height_m;
}

void ProxyFrame::start() {
  search_.seconds = seconds_;
  search_.up = model_.tracked[Joint::palm].rotation * Vec3::UnitY();
  if (is_found_anew()) return start_anew();
  if (follow_blocking(search_, state_)) {
    let_go_from_ = state_.shown;
    return start_anew();
  }
  search_.speed_mps = motion_m_ / seconds_;
  if (deformed_) forget_planes(state_);
  search_.planes_lost = jumped_ || deformed_;
  search_.reach_m = kReach_m + kReachOfMotion * motion_m_;
  search_.deepest_m = state_.mode == ProxyMode::blocked ? -1.0 : state_.touch.deepest_m;
  if (search_.up.dot(state_.touch.normal) < 0.0) search_.up = -search_.up;  // palm up
  search_.before = pose_flesh(state_.last->drawn, model_.scale);
  search_.sink_m = find_sink();
  if (jumped_) state_.offset_velocity.fill(Vec3::Zero());
  lag_ = follow_lag(seconds_, tuning_.return_s, state_.touch);
  coasted_ = coasted_joints(tuning_, state_, model_.tracked, lag_, seconds_);
  correction_ = after_step(state_.last->correction, HandFreedoms::Zero(), model_.ranges);
}

void ProxyFrame::start_anew() {
  found_anew_ = true;
  forget_frame(state_);
  search_.up = model_.tracked[Joint::palm].rotation * Vec3::UnitY();
  search_.speed_mps = 0.0;
  search_.reach_m = kFirstReach_m;
  search_.planes_lost = true;
  search_.before.reset();
  search_.deepest_m = -1.0;
  normal_.setZero();
  correction_ = {};
  correction_.palm.shift = shift_outside(search_, model_.tracked[Joint::palm].position);
  search_.sink_m = find_sink();
}

/// How far the skin may sink in. An object that becomes softer or harder under the hand takes its
/// time.
double ProxyFrame::find_sink() {
  SurfaceTouch& touch = state_.touch;
  const double share =
      state_.mode == ProxyMode::contact ? followed(seconds_, tuning_.return_s) : 1.0;
  touch.softness_m += share * (options_.softness_m - touch.softness_m);
  touch.softness_depth_m += share * (options_.softness_depth_m - touch.softness_depth_m);
  return touch.softness_m * followed(touch.height_m, touch.softness_depth_m);
}

/// Looks at the surface, and takes the step of least cost; again where that was too long for what
/// was seen.
void ProxyFrame::settle() {
  posed_ = pose_hand(model_, correction_);
  const int rounds = found_anew_ ? kFirstRounds : kRounds;
  for (int round = 0; round < rounds; ++round) {
    found_ = find_contacts(search_, posed_, state_);
    if (state_.terms.empty() && is_none(correction_)) break;
    // In the air, and where the hand is found anew, a finger comes home whatever is in between.
    const double firmness = found_anew_ ? 0.0 : 1.0 - in_air();
    keep_digits_apart(model_, search_.flesh, posed_, search_.reach_m, firmness, state_.terms);
    if (round == 0 && !found_anew_ && !found_.pull.isZero()) look_along();
    take_step(posed_, round);
    if (found_anew_) search_.deepest_m = found_.deepest_m;
    const double settled_m =
        found_anew_ ? kFirstSettled_m : std::min(search_.reach_m, kLongestStep_m);
    if (reach_of(step_) < settled_m) break;
  }
}

void ProxyFrame::look_along() {
  normal_ = found_.pull.normalized();
  const Vec3 along = along_surface(state_.last->correction.palm.shift, normal_);
  const Vec3 noticed = along - shortened(along, tuning_.unnoticed_m);
  catch_up_ = -shortened(followed(seconds_, kCatchUpLonger * tuning_.return_s) * noticed,
                         kCatchUpFaster * tuning_.rest_speed_mps * seconds_);
}

void ProxyFrame::take_step(const PosedHand& posed, int round) {
  const Springs springs = springs_at(posed);
  const StepRange range = range_at(round);
  step_ = least_cost_step(springs, range, state_.terms, HandFreedoms::Zero(), state_.room);
  Correction corrected = after_step(correction_, step_, model_.ranges);
  PosedHand next = pose_hand(model_, corrected);
  const double most_m = farthest_way();
  for (int pass = 0; pass < kHoldPasses && !found_anew_; ++pass) {
    if (!hold_back(state_.last->drawn, next.hand, most_m, posed, step_, state_.terms)) break;
    step_ = least_cost_step(springs, range, state_.terms, step_, state_.room);
    corrected = after_step(correction_, step_, model_.ranges);
    next = pose_hand(model_, corrected);
  }
  pushed_ = is_pushed(step_);
  correction_ = corrected;
  posed_ = next;
}

/// 0 for a hand that something holds, to 1 in the air.
double ProxyFrame::in_air() const {
  return found_anew_ ? 0.0 : smoothstep(0.0, kInAirShare * tuning_.return_s, state_.touch.air_s);
}

/// How far a joint goes in the frame at the most.
double ProxyFrame::farthest_way() const {
  const double held_m =
      lag_.norm() + catch_up_.norm() + std::max(motion_m_, tuning_.rest_speed_mps * seconds_);
  const double air = in_air();
  if (air == 0.0) return held_m;
  const double away_m = largest_motion(state_.last->tracked, state_.last->drawn);
  const double home_m =
      seconds_ * std::min(kHomeFaster * tuning_.rest_speed_mps, away_m / tuning_.return_s);
  return held_m + air * (std::max(kFasterInAir * motion_m_, home_m) - held_m);
}

Springs ProxyFrame::springs_at(const PosedHand& posed) const {
  Springs springs;
  const double firmness = 1.0 + in_air() * (kFirmerInAir - 1.0);
  const double held = firmness * tuning_.place_stiffness / kJointCount;
  const double inert = found_anew_ ? 0.0 : tuning_.joint_mass / (seconds_ * seconds_);
  JointVectors places;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    places[i] = model_.tracked.joints[i].position + state_.touch.drawn_lag;
    if (!found_anew_) places[i] += inert / (held + inert) * (coasted_[i] - places[i]);
  }
  add_joint_springs(places, held + inert, posed, springs);
  add_bend_springs(tuning_, correction_, firmness, springs);
  add_seat(tuning_, correction_, model_.tracked[Joint::palm], found_.palm, springs);
  springs.force += found_.even_pull;
  if (!found_anew_ && !normal_.isZero()) {
    const Vec3 shifted =
        correction_.palm.shift - state_.last->correction.palm.shift - lag_ - catch_up_;
    add_slide(tuning_, normal_, shifted, seconds_, springs);
  }
  return springs;
}

StepRange ProxyFrame::range_at(int round) const {
  StepRange range = step_range(model_, correction_);
  if (!found_anew_) return range;
  HandFreedoms most = HandFreedoms::Constant(kFirstTurn_rad);  // what the planes are good for
  most.head<3>().setConstant(kFirstShift_m);
  most *= std::pow(kShorterSteps, round);
  range.low = range.low.cwiseMax(-most).cwiseMin(0.0);
  range.high = range.high.cwiseMin(most).cwiseMax(0.0);
  return range;
}

bool ProxyFrame::is_pushed(const HandFreedoms& step) const {
  return !found_.even_pull.isZero() ||
         std::any_of(state_.terms.begin(), state_.terms.end(), [&](const ContactTerm& term) {
           return term.kind != ContactKind::speed && term.kind != ContactKind::digits &&
                  term.force_at(gap_after(term.row, step)) != 0.0;
         });
}

void ProxyFrame::remember_touch() {
  SurfaceTouch& touch = state_.touch;
  touch.deepest_m = found_.deepest_m;
  if (found_.pull.isZero()) {
    forget_stroke(touch);
    touch.normal.setZero();
    touch.height_m = 0.0;
    return;
  }
  touch.normal = found_.pull.normalized();
  touch.height_m = std::max(0.0, touch.normal.dot(correction_.palm.shift));
  if (!state_.last) return;
  const double grown = object_.scale() / state_.scale;
  const Vec3 way =
      model_.tracked[Joint::palm].position - grown * state_.last->tracked[Joint::palm].position;
  remember_stroke(along_surface(way, touch.normal), options_.friction, touch);
}

void ProxyFrame::remember_frame(const HandPose& drawn) {
  const HandPose& tracked = model_.tracked;
  if (found_anew_) {
    state_.motion.velocity.fill(Vec3::Zero());
    state_.offset_velocity.fill(Vec3::Zero());
  } else {
    const SettledFrame& last = *state_.last;
    follow_velocity(last.tracked, tracked, seconds_, jumped_, state_.motion);
    for (std::size_t i = 0; i < kJointCount; ++i) {
      const Vec3 way = tracked.joints[i].position - last.tracked.joints[i].position;
      const Vec3 drawn_way = drawn.joints[i].position - last.drawn.joints[i].position;
      state_.offset_velocity[i] = (drawn_way - way) / seconds_;
    }
  }
  state_.last = SettledFrame{tracked, drawn, correction_};
  watch_surface(object_, (deformed_ || stirred_) && !found_anew_, seconds_, state_);
  state_.shape = object_.surface().shape();
  state_.scale = object_.scale();
}

/// Whether its object is gone, or another is there, in which the drawn hand was.
bool ProxyFrame::is_displaced() const {
  return before_ && (found_anew_ || (replaced_ && is_thrown(*before_, correction_)));
}

/// What the object let go, or left, is found anew at once, and drawn so a little later: it comes
/// back through the object.
HandPose ProxyFrame::on_its_way_back(const HandPose& settled) {
  if (let_go_from_) {
    start_return(*let_go_from_, correction_, kLetGoLonger * tuning_.return_s, state_);
  } else if (is_displaced()) {
    start_return(before_->correction, correction_, kThrownLonger * tuning_.return_s, state_);
    state_.offset_velocity.fill(Vec3::Zero());
  }
  state_.shown = correction_;
  const double left = follow_return(seconds_, state_);
  if (left == 0.0) return settled;
  state_.shown = after_step(correction_, left * state_.returning.from, model_.ranges);
  return pose_hand(model_, state_.shown).hand;
}

ProxyResult ProxyFrame::finish() {
  const bool near = reach_of(step_between({}, correction_)) < kReleased_m;
  if (!pushed_ && near) correction_ = {};
  const bool touches =
      pushed_ || std::any_of(found_.parts.begin(), found_.parts.end(),
                             [this](const PartTouch& part) { return is_pressed(part, tuning_); });
  state_.touch.air_s = touches ? 0.0 : state_.touch.air_s + seconds_;
  const HandPose hand = is_none(correction_) ? model_.tracked : posed_.hand;
  remember_touch();
  remember_frame(hand);
  ProxyResult result;
  result.hand = on_its_way_back(hand);
  state_.mode = mode_after(touches, pushed_, state_);
  result.touches = touches;
  result.corrected = !is_none(correction_) || state_.mode == ProxyMode::returning;
  report_parts(search_, posed_, found_, result);
  // One that comes back is not where it was settled.
  if (state_.mode != ProxyMode::returning) report_bones(posed_, found_, result);
  return result;
}

ProxyHand::ProxyHand(const HandFlesh& flesh, const ProxyTuning& tuning)
    : flesh_(&flesh), tuning_(tuning), state_(std::make_unique<ProxyState>(flesh)) {}
ProxyHand::ProxyHand(ProxyHand&&) noexcept = default;
ProxyHand& ProxyHand::operator=(ProxyHand&&) noexcept = default;
ProxyHand::~ProxyHand() = default;

ProxyResult ProxyHand::update(const HandPose& tracked, double scale, const Object& object,
                              const Rearrangement& around, double seconds,
                              const SettleOptions& options) noexcept {
  if (is_nowhere(object, tracked)) return update(tracked, scale, nothing(), {}, seconds, options);
  const std::optional<SettledFrame>& last = state_->last;
  const SeenHand seen =
      see_hand(tracked, object, seconds, last ? &last->tracked : nullptr,
               around.carrier ? &around.carrier->placement.pose : nullptr, state_->object);
  const std::optional<ShownBefore> before = go_on(seen, object, around.carrier, *state_);
  const ScaledSurface surface(object);
  ProxyFrame frame(seen, before, *flesh_, tuning_, rounded(scale), surface, around, seconds,
                   options, *state_);
  return in_world(state_->object.place, tracked, frame.run());
}

void ProxyHand::forget() noexcept {
  state_->last.reset();
  state_->mode = ProxyMode::lost;
}

}  // namespace nade
