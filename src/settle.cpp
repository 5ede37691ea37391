#include "nade/settle.h"

#include <algorithm>
#include <cmath>

#include "nade/assert.h"
#include "posed_hand.h"
#include "ramps.h"
#include "settle_fold.h"
#include "settle_forces.h"
#include "settle_frame.h"
#include "settle_jump.h"
#include "settle_leave.h"
#include "settle_lift.h"
#include "settle_normal.h"
#include "settle_outside.h"
#include "settle_pace.h"
#include "settle_ride.h"
#include "settle_slide.h"
#include "settle_solver.h"
#include "settle_springs.h"
#include "settle_step.h"
#include "settle_unrest.h"
#include "touch_finder.h"

namespace nade {
namespace {

/// Skin farther than this from its plane, and than this share of what the hand has moved, does not
/// come to touch it in the frame.
constexpr double kRowReach_m = 0.0009;
constexpr double kRowReachOfMotion = 0.33;
/// Of a hand that is found anew, in the first round, and in the last.
constexpr double kFirstRowReach_m = 0.04;
constexpr double kLastRowReach_m = 0.002;

constexpr double kWallStiffness = 1e5;
/// A joint's mass: a spring of this over the square of the frame's seconds keeps it going. Less in
/// the air, where the hand comes back to the tracked one.
constexpr double kInertia = 1.85;
constexpr double kInertiaInAir = 1.3;
/// What the tracked joints do against the object is smoothed over this time.
constexpr double kVelocityTime_s = 0.016;
/// The direction of the object's push is smoothed over this time.
constexpr double kPushTime_s = 0.20506;
/// And so is how soft the object is.
constexpr double kSoftnessTime_s = 0.2;

/// One that was missing for long is found anew, unless it presses on: it was in the object, has not
/// come out, and is no farther from there than this.
constexpr double kPressesOn_m = 0.08;

constexpr int kRounds = 3;
constexpr int kFirstRounds = 40;
/// A round is the last in which no skin that had no row can have come to touch, and whose step is
/// no longer than this: what the rows say is good for no longer ones.
constexpr double kLongestStep_m = 0.005;
/// A hand that is found anew rests for long where it is put: each round's steps are shorter by this
/// factor, and the last moves no skin farther than so.
constexpr double kShorterSteps = 0.85;
constexpr double kFirstSettled_m = 1e-4;
/// In the air, a correction smaller than this is over.
constexpr double kReleased_m = 0.0001;
constexpr double kLongestTurn_rad = 0.3;

/// How long a hand found anew may step in a round, of the first one's way.
double step_share(int round) { return std::pow(kShorterSteps, round); }

/// One frame's work.
class Settling {
 public:
  Settling(const SeenHand& seen, const HandFlesh& flesh, double scale, const ScaledSurface& object,
           double seconds, const SettleOptions& options, SettleMemory& memory)
      : object_(object),
        seen_(seen),
        options_(options),
        memory_(memory),
        model_(measure_model(seen.from_object, scale)),
        search_{flesh, object, pose_flesh(seen.from_object, scale), {}, scale},
        since_last_s_(seconds),
        seconds_(frame_seconds(seconds, memory.unrest)) {
    start();
  }

  SettledHand run() {
    const int rounds = fresh_ ? kFirstRounds : kRounds;
    PosedHand posed = pose_hand(model_, correction_);
    for (int round = 0; round < rounds; ++round) {
      if (fresh_) {
        search_.row_reach_m = std::max(kLastRowReach_m, step_share(round) * kFirstRowReach_m);
      }
      patches_ = find_touches(search_, posed, memory_);
      if (memory_.rows.empty() && is_none(correction_)) break;
      SettleProblem problem = problem_at(posed, round);
      const double firmness = firmness_of_hold();
      HandFreedoms step = least_cost_step(problem, HandFreedoms::Zero());
      Correction corrected = after(step);
      PosedHand next = pose_hand(model_, corrected);
      if (!fresh_ && hold_back(memory_.last.drawn, next.hand, farthest_m_, firmness, posed, step,
                               search_.frame, memory_.rows)) {
        problem.rows = memory_.rows;
        step = least_cost_step(problem, step);
        corrected = after(step);
        next = pose_hand(model_, corrected);
      }
      const ContactForces forces = contact_forces(posed, memory_.rows, step, search_.frame);
      memory_.geometric = forces.geometric;
      touches_ = forces.touches;
      find_push(forces.push);
      correction_ = corrected;
      posed = next;
      if (reach_of(step) < settled_m()) break;
    }
    return finish(posed.hand);
  }

 private:
  void start();
  void find_motion();
  [[nodiscard]] bool is_found_anew() const;
  void find_strengths();
  [[nodiscard]] double find_sink();
  [[nodiscard]] Correction after(const HandFreedoms& step) const;
  [[nodiscard]] SettleProblem problem_at(const PosedHand& posed, int round) const;
  /// So firmly that neither a pull nor a climb overcomes it.
  [[nodiscard]] double firmness_of_hold() const {
    return std::max(search_.strengths[kNearestSkin], firmness_of_climb(memory_.rows));
  }
  /// A round that moves no skin farther is the last.
  [[nodiscard]] double settled_m() const {
    return fresh_ ? kFirstSettled_m : std::min(search_.row_reach_m, kLongestStep_m);
  }
  [[nodiscard]] bool is_in_air() const {
    return !fresh_ && (memory_.contact.push.isZero() || is_held_up(memory_));
  }
  [[nodiscard]] double farthest_way() const;
  [[nodiscard]] bool is_in_contact() const;
  void find_push(const Vec3& force);
  void remember_contact();
  void remember_frame(const HandPose& drawn);
  [[nodiscard]] bool is_displaced() const;
  [[nodiscard]] HandPose on_its_way_back(const HandPose& settled);
  SettledHand finish(const HandPose& posed);

  const ScaledSurface& object_;
  const SeenHand& seen_;
  const SettleOptions& options_;
  SettleMemory& memory_;
  HandModel model_;
  TouchSearch search_;
  double since_last_s_;  ///< as it is
  double seconds_;       ///< as it counts

  bool deformed_ = false;  ///< whether the object has another shape or size than it had
  bool jumped_ = false;    ///< whether the tracked hand did
  bool fresh_ = false;
  std::optional<Correction> let_go_from_;  ///< that it had when it was let go in this frame
  double motion_m_ = 0.0;                  ///< of the tracked hand since the last frame
  /// No joint goes farther in the frame unless the object pushes or pulls harder than this holds
  /// it back.
  double farthest_m_ = 0.0;
  JointVectors coasted_{};  ///< where the drawn joints would go on to
  Correction last_;
  Correction correction_;
  Vec3 push_ = Vec3::Zero();
  Vec3 normal_ = Vec3::Zero();  ///< of the surface at the tracked palm; zero in the air
  PatchTouches patches_{};
  bool touches_ = false;
};

/// How the tracked hand moves.
void Settling::find_motion() {
  const SettledFrame& last = memory_.last;
  if (!last.tracked) return;
  jumped_ = follow_jumps(model_.tracked, seconds_, memory_);
  motion_m_ = largest_motion(*last.tracked, model_.tracked);
  memory_.way_m += motion_m_;
  follow_rest(motion_m_, seconds_, memory_.rest);
  if (jumped_) return;
  const double follow = memory_.fresh ? 1.0 : followed(seconds_, kVelocityTime_s);
  follow_velocity(*last.tracked, model_.tracked, seconds_, follow, memory_.velocity);
}

/// Whether the last frame says nothing about where the hand is.
bool Settling::is_found_anew() const {
  if (!memory_.last.tracked) return true;
  const Vec3& palm = model_.tracked[Joint::palm].position;
  const double growth = std::abs(object_.scale() / memory_.scale - 1.0);
  if (!(motion_m_ + growth * palm.norm() <= kTeleport_m)) return true;
  if ((deformed_ || seen_.at_another) && is_swallowed(object_, memory_)) return true;
  if (since_last_s_ <= kMissing_s) return false;
  const ContactState& contact = memory_.contact;
  const double risen_m = contact.push.dot(palm - (*memory_.last.tracked)[Joint::palm].position);
  return contact.push.isZero() || is_held_up(memory_) || motion_m_ > kPressesOn_m ||
         risen_m > contact.height_m;
}

void Settling::start() {
  const HandPose& tracked = model_.tracked;
  deformed_ = object_.scale() != memory_.scale || object_.surface().shape() != memory_.shape;
  if (deformed_ && memory_.last.tracked) ride_along(object_, seconds_, memory_);
  if (!memory_.last.tracked) memory_.before_jumps = {};  // from who knows when
  find_motion();
  search_.seconds = seconds_;
  search_.speed_mps = motion_m_ / seconds_;
  fresh_ = is_found_anew();
  if (!fresh_ && follow_leaving(search_, memory_)) {
    let_go_from_ = memory_.shown;
    fresh_ = true;
  }
  if (fresh_) {
    forget_frame(memory_);
  } else if (deformed_) {
    forget_planes(memory_);
  }
  search_.nearest_m = memory_.contact.nearest_m;
  search_.deepest_m = memory_.contact.deepest_m;
  search_.sink_m = find_sink();
  push_ = memory_.contact.push;
  correction_ = memory_.last.correction;
  search_.row_reach_m = kRowReach_m + (jumped_ ? 1.0 : kRowReachOfMotion) * motion_m_;
  if (fresh_) {
    const OutsideStart outside = start_outside(search_, tracked[Joint::palm].position);
    push_ = outside.push;
    correction_.palm.shift = outside.shift;
  }
  search_.push = push_;
  normal_ = normal_under_palm(object_, tracked[Joint::palm], push_, motion_m_, seconds_, memory_);
  search_.frame = surface_frame(normal_, tracked[Joint::palm].rotation);
  find_strengths();
  correction_ = after(HandFreedoms::Zero());  // into the range of this frame's pose
  last_ = correction_;
  last_.palm.shift += follow_lag(seconds_, memory_.contact);
  search_.velocity = memory_.velocity;
  if (fresh_) return;
  search_.before = pose_flesh(memory_.last.drawn, model_.scale);
  farthest_m_ = farthest_way();
  if (jumped_) return;
  follow_strike(*memory_.last.tracked, tracked, normal_, seconds_, memory_.strike_mps);
  coasted_ = coasted_joints(memory_, tracked, normal_, seconds_);
  // Most often it goes on as it went: then the surface needs to be looked at only once.
  correction_ = after(step_between(memory_.before, memory_.last.correction, search_.frame));
}

/// How far the skin may sink in. An object that becomes softer or harder under the hand takes its
/// time.
double Settling::find_sink() {
  ContactState& contact = memory_.contact;
  const double share = contact.push.isZero() ? 1.0 : followed(seconds_, kSoftnessTime_s);
  contact.softness_m += share * (options_.softness_m - contact.softness_m);
  contact.softness_depth_m += share * (options_.softness_depth_m - contact.softness_depth_m);
  return contact.softness_m * followed(contact.height_m, contact.softness_depth_m);
}

/// How strongly the object may draw this hand.
void Settling::find_strengths() {
  follow_unrest(seen_.from_home, seen_.from_object, since_last_s_, memory_.unrest);
  const FingerCurls curls = curls_of(model_);
  if (memory_.contact.push.isZero()) memory_.contact.curl_at_touch = curls;
  search_.strengths = pull_strengths(memory_.unrest, curls, memory_.contact.curl_at_touch);
  search_.pulls = !is_held_up(memory_);
  // On a hand found anew no pull has to come first.
  search_.pulls_before = fresh_ ? search_.strengths : memory_.contact.pulls;
}

Correction Settling::after(const HandFreedoms& step) const {
  return after_step(correction_, step, search_.frame, model_.ranges);
}

SettleProblem Settling::problem_at(const PosedHand& posed, int round) const {
  SettleProblem problem;

  HandFreedoms away = step_between({}, correction_, search_.frame);
  away.head<3>() -=
      search_.frame.transpose() * (memory_.contact.carried + memory_.contact.drawn_lag);
  const bool in_air = is_in_air();
  problem.springs.add(in_air ? stiffness_in_air(away) : stiffness_of_pose(away), -away);
  // The forces on a hand found anew are not yet those that it will rest with.
  if (!fresh_) {
    problem.springs.add(memory_.geometric, HandFreedoms::Zero());
    fold_alike(posed, patches_, problem.springs);
    if (!in_air) lift_over(posed, search_, memory_.rows, problem.springs);
  }
  problem.rows = memory_.rows;

  const HandFreedoms changed = step_between(last_, correction_, search_.frame);
  if (!fresh_) {
    problem.springs.add(
        (in_air ? damping_in_air() : damping(away, memory_.contact.height_m)) / seconds_, -changed);
    const double inertia = in_air ? kInertiaInAir : kInertia;
    if (!jumped_)
      add_inertia(coasted_, inertia / (seconds_ * seconds_), posed, search_.frame, problem.springs);
  }

  problem.range.low.setConstant(-1.0);
  problem.range.high.setConstant(1.0);
  problem.rate.stiffness.setConstant(kWallStiffness);
  problem.range.stiffness.setConstant(kWallStiffness);
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    const Eigen::Index first = first_freedom(d);
    problem.range.low.segment<4>(first) = model_.ranges[d].low - correction_.bend[d];
    problem.range.high.segment<4>(first) = model_.ranges[d].high - correction_.bend[d];
  }

  if (fresh_) {  // in steps that the planes are good for
    const double share = step_share(round);
    problem.rate.high.setConstant(share * kLongestTurn_rad);
    problem.rate.high.head<3>().setConstant(share * kDeepest_m);
    problem.rate.low = -problem.rate.high;
    return problem;
  }
  const HandFreedoms rate = in_air ? steps_of(farthest_m_, farthest_m_, farthest_m_)
                                   : steps_on_surface(motion_m_, memory_.rest, seconds_);
  problem.rate.low = -rate - changed;
  problem.rate.high = rate - changed;
  return problem;
}

/// How far a joint goes in the frame at the most.
double Settling::farthest_way() const {
  if (!is_in_air()) return way_on_surface(motion_m_, memory_.rest, seconds_);
  const double away_m = reach_of(step_between({}, memory_.last.correction, search_.frame));
  return way_in_air(motion_m_, away_m, seconds_);
}

/// Whether the drawn hand touches, or the person is in the object near where it hovers for a
/// moment.
bool Settling::is_in_contact() const {
  return touches_ || std::any_of(patches_.begin(), patches_.end(), [](const PatchTouch& patch) {
           return patch.depth_m > 0.0 && patch.gap_m < kPullReach_m;
         });
}

/// The way the object pushes, smoothed.
void Settling::find_push(const Vec3& force) {
  const double strength = force.norm();
  if (!(strength > 1e-12)) {
    push_ = is_in_contact() ? memory_.contact.push : Vec3::Zero();
    return;
  }
  push_ = force / strength;
  if (memory_.contact.push.isZero()) return;
  push_ = mixed(memory_.contact.push, push_, followed(seconds_, kPushTime_s));
}

void Settling::remember_contact() {
  if (push_.isZero() || memory_.contact.normal.isZero() || is_held_up(memory_)) {
    forget_slide(memory_.contact);
  } else {
    const Vec3& palm = model_.tracked[Joint::palm].position;
    const double grown = object_.scale() / memory_.scale;
    const Vec3 before = grown * (*memory_.last.tracked)[Joint::palm].position;
    remember_slide(correction_.palm.shift, along_surface(palm - before, normal_), normal_,
                   options_.friction, memory_.contact);
  }
  memory_.contact.height_m = std::max(0.0, push_.dot(correction_.palm.shift));
  memory_.contact.nearest_m = patches_[kNearestSkin].gap_m + search_.sink_m;
  memory_.contact.deepest_m = patches_[kNearestSkin].depth_m;
  memory_.contact.push = push_;
  memory_.contact.normal = push_.isZero() ? push_ : normal_;
}

void Settling::remember_frame(const HandPose& drawn) {
  const SettledFrame now{model_.tracked, drawn, correction_};
  if (!fresh_) follow_pace(now, seconds_, jumped_, memory_);
  memory_.before = fresh_ ? now.correction : memory_.last.correction;
  memory_.last = now;
  memory_.fresh = fresh_;
  watch_surface(object_, deformed_ && !fresh_, seconds_, memory_);
  memory_.object = object_.identity();
  memory_.shape = object_.surface().shape();
  memory_.scale = object_.scale();
}

/// What the object let go, or left, is found anew at once, and drawn so a little later: it comes
/// back through the object.
HandPose Settling::on_its_way_back(const HandPose& settled) {
  double motion_m = motion_m_;
  if (let_go_from_) {
    start_return(*let_go_from_, correction_, memory_);
  } else if (is_displaced()) {
    start_return(seen_.before->correction, correction_, memory_);
    forget_drift(memory_);
    motion_m = 0.0;  // it has not moved itself
  }
  follow_return(motion_m, seconds_, is_in_contact(), memory_);
  memory_.shown = correction_;
  if (memory_.return_share == 0.0) return settled;
  const HandFreedoms left = memory_.return_share * memory_.returning;
  const Eigen::Matrix3d frame = Eigen::Matrix3d::Identity();
  memory_.shown = after_step(correction_, left, frame, model_.ranges);
  return pose_hand(model_, memory_.shown).hand;
}

/// Whether its object is gone, or another is there, in which the drawn hand was.
bool Settling::is_displaced() const {
  if (!seen_.before) return false;
  if (fresh_) return true;
  return seen_.at_another && is_thrown(*seen_.before, correction_);
}

SettledHand Settling::finish(const HandPose& posed) {
  const double away_m = reach_of(step_between({}, correction_, search_.frame));
  if (!touches_ && away_m < kReleased_m) correction_ = {};
  SettledHand settled;
  const HandPose& hand = is_none(correction_) ? model_.tracked : posed;
  remember_contact();
  remember_frame(hand);
  settled.hand = on_its_way_back(hand);
  settled.touches = is_in_contact();
  settled.corrected = !is_none(correction_) || memory_.return_share > 0.0;
  for (std::size_t i = 0; i < kPartCount; ++i) {
    const PatchTouch& part = patches_[i];
    if (!(part.depth_m > 0.0) || part.gap_m > kPullReach_m) continue;
    PartContact contact;
    contact.ray_origin = search_.tracked.position(*part.point);
    contact.ray_direction = contact.skin_direction = contact.normal = part.normal;
    contact.surface_point = part.surface_point;
    contact.target = settled.hand[joint_of(part_at(i))].position;
    contact.skin_depth_m = part.normal.dot(contact.target - part.surface_point);
    contact.depth_m = part.depth_m;
    settled.contacts[i] = contact;
  }
  return settled;
}

}  // namespace

SettledHand settle_hand(const HandPose& tracked, const HandFlesh& flesh, double scale,
                        const Object& object, double seconds, const SettleOptions& options,
                        SettleMemory& memory) noexcept {
  NADE_ASSERT(memory.pads.size() == flesh.pads.size());
  if (is_nowhere(object, tracked)) {
    return settle_hand(tracked, flesh, scale, nothing(), seconds, options, memory);
  }
  const SeenHand seen = see_hand(tracked, object, seconds, memory);
  const ScaledSurface surface(object);
  Settling settling(seen, flesh, rounded(scale), surface, seconds, options, memory);
  return brought_back(memory.place, tracked, settling.run());
}

}  // namespace nade
