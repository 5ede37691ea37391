#include "nade/settle.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "posed_hand.h"
#include "settle_solver.h"

namespace nade {
namespace {

// What the tracked pose is worth. A shift of 2 cm costs as much as bending a knuckle by a radian.
constexpr double kShiftStiffness = 1.0 / (0.02 * 0.02);
constexpr double kTurnStiffness = 10.0;
/// About the surface's normal: the heading is the person's own.
constexpr double kSpinStiffness = 40.0;
/// Base abduction, base, middle and last flexion. A finger pushed from below gives way at its
/// knuckle and keeps its curl; a thumb gives way as a whole.
const DigitFreedoms kFingerStiffness{4.0, 1.0, 4.0, 6.0};
const DigitFreedoms kThumbStiffness{1.0, 1.0, 2.0, 2.0};

/// The skin is kept this far out.
constexpr double kMargin_m = 0.0002;
/// Skin farther than this from its plane, and than the hand has moved, does not come to touch it
/// in the frame.
constexpr double kRowReach_m = 0.005;

// A part that the person pressed in is drawn to the surface until it is this near, from as far as
// `kPullReach_m`, with a pull that grows to its full strength with the tracked part's depth.
constexpr double kPullRest_m = 0.001;
constexpr double kPullReach_m = 0.03;
constexpr double kPullFade_m = 0.01;
constexpr double kPullStart_m = 0.001;
constexpr double kPullFull_m = 0.025;
constexpr double kPullStiffness = 1.0 / (0.006 * 0.006);

// How fast a correction may change where nothing pushes: so many times the tracked hand's own
// motion, and a little more, so that a hand at rest is released as well.
constexpr double kShiftRate = 1.5;
constexpr double kTurnRate = 0.6;
constexpr double kBendRate = 0.6;
constexpr double kFreeRate_m_per_s = 0.027;
constexpr double kTurnLever_m = 0.10;
constexpr double kBendLever_m = 0.07;
constexpr double kWallStiffness = 1e5;
/// Turns and bends follow with this time constant.
constexpr double kViscosity_s = 0.022;
/// And shifts along the surface with this.
constexpr double kSlideTime_s = 0.088;
/// The direction of the object's push is smoothed over this time.
constexpr double kPushTime_s = 0.07;
/// The drawn hand strays along the surface by no more than this share of the depth.
constexpr double kCarriedCone = 0.6;

/// A hand that moves farther from one frame to the next was lost and found.
constexpr double kTeleport_m = 0.15;
constexpr double kShortestFrame_s = 0.001;
constexpr double kLongestFrame_s = 0.05;

constexpr int kRounds = 3;
constexpr int kFirstRounds = 8;
/// A round that moves no skin farther than this is the last.
constexpr double kSettled_m = 0.0002;
/// A pad's plane serves for as long as the pad stays within this.
constexpr double kSamePlane_m = 0.0004;
constexpr double kSamePlaneNextFrame_m = 0.00002;
/// A pad that is too far is not looked at again until it could have come so much nearer.
constexpr double kFarSlack_m = 0.02;
/// A hand that is found anew is got out of the object if it lies no deeper than this.
constexpr double kDeepest_m = 0.3;
constexpr double kLongestTurn_rad = 0.3;
constexpr double kPalmThickness_m = 0.02;
/// Skin stretches by no more than this when the hand is posed.
constexpr double kStretch = 1.3;

double smoothstep(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

Vec3 along_surface(const Vec3& vector, const Vec3& normal) {
  return vector - normal.dot(vector) * normal;
}

Vec3 shortened(const Vec3& vector, double most) {
  const double length = vector.norm();
  return length > most ? Vec3(most / length * vector) : vector;
}

Vec3 rotation_vector(const Quat& turn) {
  const Eigen::AngleAxisd angle_axis{turn.w() < 0.0 ? Quat(-turn.coeffs()) : turn};
  return angle_axis.angle() * angle_axis.axis();
}

Quat turn_about(const Vec3& rotation_vector) {
  const double angle = rotation_vector.norm();
  if (angle == 0.0) return Quat::Identity();
  return Quat(Eigen::AngleAxisd(angle, rotation_vector / angle));
}

bool is_none(const Correction& correction) {
  return correction.palm.shift.isZero(0.0) && correction.palm.turn.vec().isZero(0.0) &&
         std::all_of(correction.bend.begin(), correction.bend.end(),
                     [](const DigitFreedoms& bend) { return bend.isZero(0.0); });
}

/// The farthest that any skin goes in a step, about.
double reach_of(const HandFreedoms& step) {
  return step.head<3>().norm() + kTurnLever_m * step.segment<3>(3).norm() +
         kBendLever_m * step.tail<kHandFreedoms - 6>().cwiseAbs().maxCoeff();
}

/// Z along `normal`, X as near as can be to where the hand points; the hand's own axes where there
/// is no normal.
Eigen::Matrix3d surface_frame(const Vec3& normal, const Quat& palm) {
  const Vec3 ahead = palm * -Vec3::UnitZ();
  const Vec3 along = along_surface(ahead, normal);
  if (normal.isZero() || along.norm() < 1e-6) return palm.toRotationMatrix();
  Eigen::Matrix3d frame;
  frame.col(0) = along.normalized();
  frame.col(1) = normal.cross(frame.col(0));
  frame.col(2) = normal;
  return frame;
}

/// The plane through the surface point nearest to a pad's middle. The surface's own normal, which
/// runs smoothly over a mesh's faces; at an edge or a tip the direction to the middle.
PadPlane plane_at(const SurfacePoint& nearest, const Vec3& middle) {
  PadPlane plane{middle, nearest.point, nearest.normal};
  if (!(nearest.signed_distance > 1e-4)) return plane;
  const Vec3 outward = (middle - nearest.point).normalized();
  const double smooth = smoothstep(0.6, 0.9, outward.dot(nearest.normal));
  plane.normal = (smooth * nearest.normal + (1.0 - smooth) * outward).normalized();
  return plane;
}

/// A part's patch of skin, drawn and tracked, against the surface near it.
struct PartTouch {
  double gap_m = std::numeric_limits<double>::infinity();
  double depth_m = -std::numeric_limits<double>::infinity();  ///< of the tracked patch
  const FleshPoint* point = nullptr;
  Vec3 surface_point = Vec3::Zero();
  Vec3 normal = Vec3::UnitY();
};

/// One frame's work.
class Settling {
 public:
  Settling(const HandPose& tracked, const HandFlesh& flesh, double scale, const Object& object,
           double seconds, const SettleOptions& options, SettleMemory& memory)
      : flesh_(flesh),
        object_(object),
        options_(options),
        memory_(memory),
        model_(measure_model(tracked, scale)),
        tracked_flesh_(pose_flesh(tracked, scale)),
        seconds_(std::clamp(seconds, kShortestFrame_s, kLongestFrame_s)) {
    start();
  }

  SettledHand run() {
    const int rounds = fresh_ ? kFirstRounds : kRounds;
    for (int round = 0; round < rounds; ++round) {
      const PosedHand posed = pose_hand(model_, correction_);
      find_rows(posed, round == 0 ? kSamePlaneNextFrame_m : kSamePlane_m);
      if (memory_.rows.empty() && is_none(correction_)) break;
      const HandFreedoms step = least_cost_step(problem());
      take_step(step);
      find_push(step);
      if (reach_of(step) < kSettled_m) break;
    }
    return finish();
  }

 private:
  void start();
  void start_outside();
  void find_rows(const PosedHand& posed, double same_plane_m);
  const PadPlane* plane_of(std::size_t pad, const Vec3& middle_world, double reach_m,
                           double same_plane_m);
  void add_rows(const FleshPad& pad, const PadPlane& plane_world, const PosedHand& posed);
  void add_pulls(const PosedHand& posed);
  [[nodiscard]] HandFreedoms step_between(const Correction& from, const Correction& to) const;
  void take_step(const HandFreedoms& step);
  [[nodiscard]] ContactRow row_of(const PosedHand& posed, const FleshPoint& point,
                                  const Vec3& normal) const;
  [[nodiscard]] SettleProblem problem() const;
  void find_push(const HandFreedoms& step);
  void remember_surface_motion();
  void rub(const Vec3& stroked);
  SettledHand finish();

  const HandFlesh& flesh_;
  const Object& object_;
  const SettleOptions& options_;
  SettleMemory& memory_;
  HandModel model_;
  PosedFlesh tracked_flesh_;
  double seconds_;

  bool fresh_ = false;
  double motion_m_ = 0.0;  ///< of the tracked hand, in the world or against the object
  double row_reach_m_ = 0.0;
  double sink_m_ = 0.0;
  /// In which the wrist's freedoms are counted: Z along the object's push, X ahead as far as the
  /// surface allows.
  Eigen::Matrix3d frame_ = Eigen::Matrix3d::Identity();
  Correction last_;
  Correction correction_;
  Vec3 push_ = Vec3::Zero();
  std::array<PartTouch, kPartCount> parts_{};
  bool touches_ = false;
};

void Settling::start() {
  const Placement& placement = object_.placement();
  const std::uint64_t shape = object_.surface().shape();
  const bool same_surface = memory_.surface == &object_.surface();
  if (!same_surface || placement.scale != memory_.object.scale || shape != memory_.shape) {
    for (PadMemory& pad : memory_.pads) {
      pad.plane.reset();
      pad.clearance_m = 0.0;
    }
  }
  const HandPose& tracked = model_.tracked;
  if (memory_.tracked) {
    const Pose object_motion = placement.pose * memory_.object.pose.inverse();
    motion_m_ = std::max(largest_motion(*memory_.tracked, tracked),
                         largest_motion(moved(*memory_.tracked, object_motion), tracked));
  }
  fresh_ = !memory_.tracked || !same_surface || motion_m_ > kTeleport_m;
  if (fresh_) {
    memory_.correction = {};
    memory_.push = memory_.carried = memory_.lag = Vec3::Zero();
    memory_.height_m = 0.0;
    memory_.slips = false;
  }
  sink_m_ = options_.softness_m * (1.0 - std::exp(-memory_.height_m / options_.softness_depth_m));
  push_ = memory_.push;
  correction_ = memory_.correction;
  row_reach_m_ = fresh_ ? kDeepest_m : kRowReach_m + motion_m_;
  if (fresh_) start_outside();
  frame_ = surface_frame(push_, tracked[Joint::palm].rotation);
  take_step(HandFreedoms::Zero());  // into the range of this frame's pose
  last_ = correction_;
}

/// A hand that was lost comes back on the side of the object that its palm is nearest to.
void Settling::start_outside() {
  const Vec3& palm = model_.tracked[Joint::palm].position;
  SurfaceHint hint;
  const std::optional<SurfacePoint> nearest = object_.closest_point(palm, kDeepest_m, hint);
  if (!nearest || nearest->signed_distance > 0.0) return;
  push_ = nearest->normal;
  correction_.palm.shift = nearest->point - palm + model_.scale * kPalmThickness_m * push_;
}

/// The plane of a pad, if it is near enough to matter: found anew, or as it was.
const PadPlane* Settling::plane_of(std::size_t pad, const Vec3& middle_world, double reach_m,
                                   double same_plane_m) {
  PadMemory& known = memory_.pads[pad];
  const Placement& placement = object_.placement();
  const Vec3 middle = placement.to_local(middle_world);
  const double away_m = placement.scale * (middle - known.middle).norm();
  if (known.clearance_m - away_m > reach_m) return nullptr;
  if (known.plane && away_m <= same_plane_m) return &*known.plane;
  const double scale = placement.scale;
  const double search_m = reach_m + kFarSlack_m;
  const std::optional<SurfacePoint> nearest =
      object_.surface().closest_point(middle, search_m / scale, known.hint);
  known.middle = middle;
  known.plane.reset();
  known.clearance_m = nearest ? scale * nearest->signed_distance : search_m;
  if (!nearest || known.clearance_m > reach_m) return nullptr;
  known.plane = plane_at(*nearest, middle);
  return &*known.plane;
}

void Settling::find_rows(const PosedHand& posed, double same_plane_m) {
  memory_.rows.clear();
  parts_ = {};
  const Placement& placement = object_.placement();
  for (std::size_t i = 0; i < flesh_.pads.size(); ++i) {
    const FleshPad& pad = flesh_.pads[i];
    const double reach_m = kStretch * model_.scale * pad.radius_m +
                           std::max(row_reach_m_, pad.part ? kPullReach_m : 0.0);
    const PadPlane* plane = plane_of(i, posed.flesh.position(pad.middle), reach_m, same_plane_m);
    if (!plane) continue;
    const PadPlane world{Vec3::Zero(), placement.to_world(plane->point),
                         placement.pose.rotation * plane->normal};
    add_rows(pad, world, posed);
  }
  add_pulls(posed);
}

void Settling::add_rows(const FleshPad& pad, const PadPlane& plane_world, const PosedHand& posed) {
  const Vec3& normal = plane_world.normal;
  for (std::size_t k = pad.first; k < pad.first + pad.count; ++k) {
    const FleshPoint& point = flesh_.skin[k];
    const double gap_m = normal.dot(posed.flesh.position(point) - plane_world.point);
    if (pad.part) {
      PartTouch& part = parts_[index_of(*pad.part)];
      const Vec3 tracked = tracked_flesh_.position(point);
      part.depth_m = std::max(part.depth_m, normal.dot(plane_world.point - tracked));
      if (gap_m < part.gap_m) {
        part.gap_m = gap_m;
        part.point = &point;
        part.surface_point = plane_world.point;
        part.normal = normal;
      }
    }
    if (gap_m > row_reach_m_ || memory_.rows.size() == kMostContactRows) continue;
    ContactRow row = row_of(posed, point, normal);
    row.gap_m = gap_m + sink_m_ - kMargin_m;
    memory_.rows.push_back(row);
  }
}

void Settling::add_pulls(const PosedHand& posed) {
  for (const PartTouch& part : parts_) {
    if (!part.point || memory_.rows.size() == kMostContactRows) continue;
    const double share = smoothstep(kPullStart_m, kPullStart_m + kPullFull_m, part.depth_m) *
                         smoothstep(-kPullReach_m, kPullFade_m - kPullReach_m, -part.gap_m);
    if (share == 0.0) continue;
    ContactRow row = row_of(posed, *part.point, part.normal);
    row.gap_m = part.gap_m + sink_m_ - kPullRest_m;
    row.pull = share * kPullStiffness;
    memory_.rows.push_back(row);
  }
}

/// A correction as the step that leads to it from another.
HandFreedoms Settling::step_between(const Correction& from, const Correction& to) const {
  HandFreedoms step;
  step.head<3>() = frame_.transpose() * (to.palm.shift - from.palm.shift);
  step.segment<3>(3) =
      frame_.transpose() * rotation_vector(to.palm.turn * from.palm.turn.conjugate());
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    step.segment<4>(first_freedom(d)) = to.bend[d] - from.bend[d];
  }
  return step;
}

void Settling::take_step(const HandFreedoms& step) {
  PalmCorrection& palm = correction_.palm;
  palm.shift += frame_ * step.head<3>();
  palm.turn = (turn_about(frame_ * step.segment<3>(3)) * palm.turn).normalized();
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    const BendRange& range = model_.ranges[d];
    correction_.bend[d] = (correction_.bend[d] + step.segment<4>(first_freedom(d)))
                              .cwiseMax(range.low)
                              .cwiseMin(range.high);
  }
}

ContactRow Settling::row_of(const PosedHand& posed, const FleshPoint& point,
                            const Vec3& normal) const {
  ContactRow row = motion_along(posed, point, normal);
  row.wrist.head<3>() = frame_.transpose() * row.wrist.head<3>();
  row.wrist.tail<3>() = frame_.transpose() * row.wrist.tail<3>();
  return row;
}

SettleProblem Settling::problem() const {
  SettleProblem problem;
  problem.rows = memory_.rows;

  HandFreedoms& back = problem.back.stiffness;
  back.head<3>().setConstant(kShiftStiffness);
  back.segment<3>(3) << kTurnStiffness, kTurnStiffness, kSpinStiffness;
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    back.segment<4>(first_freedom(d)) =
        digit_at(d) == Digit::thumb ? kThumbStiffness : kFingerStiffness;
  }
  problem.back.from = step_between({}, correction_);
  problem.back.from.head<3>() -= frame_.transpose() * (memory_.carried + memory_.lag);

  const HandFreedoms changed = step_between(last_, correction_);
  problem.viscous.from = changed;
  if (!fresh_ && !memory_.push.isZero()) {  // in the air the rate alone bounds the release
    problem.viscous.stiffness = kViscosity_s / seconds_ * back;
    problem.viscous.stiffness.head<2>() *= kSlideTime_s / kViscosity_s;
    problem.viscous.stiffness[2] = 0.0;  // out of the object at once, and back
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

  HandFreedoms rate;
  if (fresh_) {  // in steps that the planes are good for
    rate.setConstant(kLongestTurn_rad);
    rate.head<3>().setConstant(kDeepest_m);
    problem.rate.low = -rate;
    problem.rate.high = rate;
    return problem;
  }
  const double slack_m = kFreeRate_m_per_s * seconds_;
  rate.setConstant((kBendRate * motion_m_ + slack_m) / kBendLever_m);
  rate.head<3>().setConstant(kShiftRate * motion_m_ + slack_m);
  rate.segment<3>(3).setConstant((kTurnRate * motion_m_ + slack_m) / kTurnLever_m);
  problem.rate.low = -rate - changed;
  problem.rate.high = rate - changed;
  return problem;
}

/// The way the object pushes, smoothed.
void Settling::find_push(const HandFreedoms& step) {
  Vec3 force = Vec3::Zero();
  touches_ = false;
  for (const ContactRow& row : memory_.rows) {
    const double gap_m = gap_after(row, step);
    if (gap_m > 0.0) continue;
    touches_ = true;
    if (row.pull == 0.0) force -= gap_m * (frame_ * row.wrist.head<3>());
  }
  const double strength = force.norm();
  if (!(strength > 1e-12)) {
    push_ = touches_ ? memory_.push : Vec3::Zero();
    return;
  }
  push_ = force / strength;
  if (memory_.push.isZero()) return;
  const double share = 1.0 - std::exp(-seconds_ / kPushTime_s);
  push_ = (memory_.push + share * (push_ - memory_.push)).normalized();
}

/// Friction: what was stroked along the surface stays behind, up to a bound; then it slips, and
/// catches up no faster than the hand strokes.
void Settling::rub(const Vec3& stroked) {
  const VisibleFriction& friction = options_.friction;
  const double stick_m =
      std::min(friction.coefficient * std::max(memory_.height_m, 0.0), friction.longest_lag_m);
  const double slide_m = friction.kinetic * stick_m;
  const double before_m = memory_.lag.norm();
  Vec3 lag = along_surface(memory_.lag, push_) - stroked;
  if (lag.norm() > stick_m) memory_.slips = true;
  if (memory_.slips) {
    lag = shortened(lag, std::max(slide_m, before_m - stroked.norm()));
    if (lag.norm() <= slide_m) memory_.slips = false;
  }
  memory_.lag = shortened(lag, stick_m);
}

/// What lies between drawn and tracked hand along the surface. On a curved surface the drawn hand
/// goes on as far as the tracked one went, not as far as the nearest point would.
void Settling::remember_surface_motion() {
  if (push_.isZero() || memory_.push.isZero()) {
    memory_.carried.setZero();
    memory_.lag.setZero();
    memory_.slips = false;
  } else {
    const Vec3 offset = memory_.carried + memory_.push.dot(correction_.palm.shift) * memory_.push;
    const double most = kCarriedCone * std::max(0.0, push_.dot(correction_.palm.shift));
    memory_.carried = shortened(along_surface(offset, push_), most);
    if (options_.friction.coefficient > 0.0) {
      const Vec3& palm = model_.tracked[Joint::palm].position;
      const Vec3 before = object_.placement().to_world(
          memory_.object.to_local((*memory_.tracked)[Joint::palm].position));
      rub(along_surface(palm - before, push_));
    }
  }
  memory_.height_m = std::max(0.0, push_.dot(correction_.palm.shift));
  memory_.push = push_;
}

SettledHand Settling::finish() {
  if (!touches_ && reach_of(step_between({}, correction_)) < 1e-7) correction_ = {};
  remember_surface_motion();
  memory_.correction = correction_;
  memory_.tracked = model_.tracked;
  memory_.surface = &object_.surface();
  memory_.object = object_.placement();
  memory_.shape = object_.surface().shape();

  SettledHand settled;
  settled.correction = correction_;
  settled.hand = is_none(correction_) ? model_.tracked : pose_hand(model_, correction_).hand;
  settled.touches = touches_;
  settled.corrected = !is_none(correction_);
  for (std::size_t i = 0; i < kPartCount; ++i) {
    const PartTouch& part = parts_[i];
    if (!(part.depth_m > 0.0) || part.gap_m > kPullReach_m) continue;
    PartContact contact;
    contact.ray_origin = tracked_flesh_.position(*part.point);
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

SettleMemory settle_memory(const HandFlesh& flesh) {
  SettleMemory memory;
  memory.pads.resize(flesh.pads.size());
  memory.rows.reserve(kMostContactRows);
  return memory;
}

SettledHand settle_hand(const HandPose& tracked, const HandFlesh& flesh, double scale,
                        const Object& object, double seconds, const SettleOptions& options,
                        SettleMemory& memory) noexcept {
  return Settling(tracked, flesh, scale, object, seconds, options, memory).run();
}

}  // namespace nade
