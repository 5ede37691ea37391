#include "nade/fingers.h"

// Based on: Yanagida, Mori, Toyama. Composition of CG Hand Images for Visual Feedback of Contact
// Sensation in Stroking Motion. 2023. Section 2 (2) (b).
// Bounded least squares: Bertsekas. Projected Newton methods for optimization problems with
// simple constraints. 1982.

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace nade {
namespace {

using Hessian = Eigen::Matrix<double, kDigitFreedoms, kDigitFreedoms>;

/// A tip error of this much weighs as one radian of change: small enough that a target within
/// reach is met to a micrometre, large enough that one beyond reach keeps the problem tame.
constexpr double kTipWeight_m = 1e-4;
constexpr int kMostSteps = 60;
constexpr double kSmallestStep_rad = 1e-10;

struct Bounds {
  DigitFreedoms low;
  DigitFreedoms high;
};

/// Least squares over one digit: tip error against deviation from the tracked angles.
struct ReachProblem {
  const DigitChain& chain;
  Vec3 target;
  DigitFreedoms tracked;
  Bounds bounds;

  [[nodiscard]] double cost(const Vec3& tip, const DigitFreedoms& x) const {
    return (target - tip).squaredNorm() / (kTipWeight_m * kTipWeight_m) +
           (x - tracked).squaredNorm();
  }
};

Bounds bounds_of(const DigitChain& chain, const DigitFreedoms& tracked) {
  const HingeRange base = range_of_motion(chain.digit, 0);
  const HingeRange middle = range_of_motion(chain.digit, 1);
  const HingeRange last = range_of_motion(chain.digit, 2);
  Bounds bounds;
  bounds.low << base.abduction_min, base.flexion_min, middle.flexion_min, last.flexion_min;
  bounds.high << base.abduction_max, base.flexion_max, middle.flexion_max, last.flexion_max;
  bounds.low = bounds.low.cwiseMin(tracked);
  bounds.high = bounds.high.cwiseMax(tracked);
  return bounds;
}

/// A bound that the descent direction pushes against is held for this step.
bool is_held(const Bounds& bounds, const DigitFreedoms& x, const DigitFreedoms& descent,
             Eigen::Index i) {
  return (x[i] <= bounds.low[i] && descent[i] < 0.0) ||
         (x[i] >= bounds.high[i] && descent[i] > 0.0);
}

/// The damped Gauss-Newton step over the angles that are free to move.
DigitFreedoms free_step(Hessian hessian, DigitFreedoms descent, const Bounds& bounds,
                        const DigitFreedoms& x, double damping) {
  for (Eigen::Index i = 0; i < hessian.rows(); ++i) {
    hessian(i, i) *= 1.0 + damping;
    if (!is_held(bounds, x, descent, i)) continue;
    hessian.row(i).setZero();
    hessian.col(i).setZero();
    hessian(i, i) = 1.0;
    descent[i] = 0.0;
  }
  return hessian.llt().solve(descent);
}

DigitFreedoms solve(const ReachProblem& problem) {
  DigitFreedoms x = problem.tracked;
  DigitAxes axes = chain_axes(problem.chain, problem.chain.angles);
  double cost = problem.cost(axes.tip, x);
  double damping = 1e-4;
  for (int step = 0; step < kMostSteps; ++step) {
    Eigen::Matrix<double, 3, kDigitFreedoms> jacobian;
    for (std::size_t i = 0; i < kDigitFreedoms; ++i) {
      jacobian.col(static_cast<Eigen::Index>(i)) =
          axes.axis[i].cross(axes.tip - axes.center[i]) / kTipWeight_m;
    }
    const Hessian hessian = jacobian.transpose() * jacobian + Hessian::Identity();
    const DigitFreedoms descent =
        jacobian.transpose() * ((problem.target - axes.tip) / kTipWeight_m) + (problem.tracked - x);
    const DigitFreedoms wanted = (x + free_step(hessian, descent, problem.bounds, x, damping))
                                     .cwiseMax(problem.bounds.low)
                                     .cwiseMin(problem.bounds.high);
    const double moved = (wanted - x).cwiseAbs().maxCoeff();
    const DigitAxes wanted_axes =
        chain_axes(problem.chain, with_freedoms(problem.chain.angles, wanted));
    const double wanted_cost = problem.cost(wanted_axes.tip, wanted);
    if (!(wanted_cost <= cost)) {
      if (moved < kSmallestStep_rad) break;
      damping = std::max(10.0 * damping, 1e-6);
      continue;
    }
    x = wanted;
    axes = wanted_axes;
    cost = wanted_cost;
    damping *= 0.1;
    if (moved < kSmallestStep_rad) break;
  }
  return x;
}

/// A tip's ray that can be turned toward extension.
struct TurnedRay {
  const PartContact& straight;
  Vec3 distal;  ///< unit, square to the ray
  const Object& object;

  [[nodiscard]] std::optional<PartContact> at(double turn_rad) const {
    const Vec3 direction =
        std::cos(turn_rad) * straight.ray_direction + std::sin(turn_rad) * distal;
    const std::optional<RayHit> hit = object.first_hit({straight.ray_origin, direction});
    if (!hit || !hit->from_inside) return std::nullopt;
    return moved_to(straight, direction, *hit);
  }
};

struct TurnSearch {
  PartContact contact;
  double turn_rad = 0.0;
};

/// The least turn for which base-to-tip is no shorter than `reach_m`; where none is, the turn
/// that comes closest.
TurnSearch extend(const TurnedRay& ray, const Vec3& base, double reach_m, double max_turn_rad) {
  constexpr int kSamples = 24;
  constexpr int kHalvings = 30;
  const auto span_of = [&](const PartContact& contact) { return (contact.target - base).norm(); };
  TurnSearch best{ray.straight, 0.0};
  double low = 0.0;
  for (int i = 1; i <= kSamples; ++i) {
    double high = max_turn_rad * i / kSamples;
    std::optional<PartContact> contact = ray.at(high);
    if (!contact) break;
    if (span_of(*contact) > span_of(best.contact)) best = {*contact, high};
    if (span_of(*contact) < reach_m) {
      low = high;
      continue;
    }
    for (int halving = 0; halving < kHalvings; ++halving) {
      const double middle = 0.5 * (low + high);
      const std::optional<PartContact> between = ray.at(middle);
      if (between && span_of(*between) < reach_m) {
        low = middle;
      } else if (between) {
        high = middle;
        contact = between;
      } else {
        break;
      }
    }
    return {*contact, high};
  }
  return best;
}

/// Turns the ray of a tip whose target lies nearer to the digit's base than the tracked tip
/// does; says by how much.
double turn_ray_if_short(const HandPose& tracked, const DigitChain& chain, const Object& object,
                         const FingerOptions& options, PartContact& contact) {
  const DigitJoints joints = joints_of(chain.digit);
  const double reach_m =
      (tracked[joints.tip].position - tracked[hinge_joint(chain.digit, 0)].position).norm();
  if ((contact.target - chain.base).norm() >= reach_m) return 0.0;
  const Vec3 along = tracked[joints.metacarpal].rotation * -Vec3::UnitZ();
  const Vec3 square = along - along.dot(contact.ray_direction) * contact.ray_direction;
  if (square.norm() < 1e-6) return 0.0;
  const TurnSearch found =
      extend({contact, square.normalized(), object}, chain.base, reach_m, options.max_ray_turn_rad);
  contact = found.contact;
  return found.turn_rad;
}

}  // namespace

DigitAngles reach(const DigitChain& chain, const Vec3& target_world) noexcept {
  const DigitFreedoms tracked = freedoms_of(chain.angles);
  const ReachProblem problem{chain, target_world, tracked, bounds_of(chain, tracked)};
  return with_freedoms(chain.angles, solve(problem));
}

LaidFingers lay_fingers(const HandPose& tracked, const HandPose& seated, const Object& object,
                        const FingerOptions& options, Contacts& contacts) noexcept {
  LaidFingers laid;
  laid.hand = seated;
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    const Digit digit = digit_at(d);
    const Joint tip = joints_of(digit).tip;
    const DigitChain chain = measure_chain(seated, digit);
    std::optional<PartContact>& contact = contacts[index_of(part_of(digit))];
    if (contact) {
      laid.ray_turn_rad[d] = turn_ray_if_short(tracked, chain, object, options, *contact);
    }
    const Vec3 target = contact ? contact->target : tracked[tip].position;  // Eq. (1)
    if (target == seated[tip].position) continue;
    const DigitAngles angles = reach(chain, target);
    laid.bend[d] = freedoms_of(angles) - freedoms_of(chain.angles);
    set_digit(laid.hand, digit, pose_chain(chain, angles));
  }
  return laid;
}

}  // namespace nade
