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

/// A tip error of so much weighs as one radian of change. Softly first, so that the digit finds
/// its way along the curve of equal reach; in the end a target within reach is met to a
/// micrometre.
constexpr std::array<double, 3> kTipWeights_m{3e-3, 3e-4, 3e-5};
/// What a radian of change costs, by freedom: base abduction, base, middle and last flexion. A
/// finger pushed from below gives way at its base and keeps its shape.
const DigitFreedoms kStiffness{4.0, 1.0, 4.0, 9.0};
constexpr int kMostSteps = 60;
constexpr double kSmallestStep_rad = 1e-7;

/// Least squares over one digit: tip error against deviation from the tracked angles.
struct ReachProblem {
  const DigitChain& chain;
  Vec3 target;
  DigitFreedoms tracked;
  BendRange bounds;
  double tip_weight_m = kTipWeights_m.front();

  [[nodiscard]] double cost(const Vec3& tip, const DigitFreedoms& x) const {
    return (target - tip).squaredNorm() / (tip_weight_m * tip_weight_m) +
           (x - tracked).cwiseAbs2().dot(kStiffness);
  }
};

/// A bound that the descent direction pushes against is held for this step.
bool is_held(const BendRange& bounds, const DigitFreedoms& x, const DigitFreedoms& descent,
             Eigen::Index i) {
  return (x[i] <= bounds.low[i] && descent[i] < 0.0) ||
         (x[i] >= bounds.high[i] && descent[i] > 0.0);
}

/// Half the cost's derivatives at a pose: descent is the negative gradient.
struct Derivatives {
  DigitFreedoms descent;
  Hessian gauss_newton;
  Hessian newton;  ///< with the chain's curvature: it matters where the target is out of reach
};

Derivatives derivatives_at(const ReachProblem& problem, const DigitAxes& axes,
                           const DigitFreedoms& x) {
  const Vec3 error = (problem.target - axes.tip) / problem.tip_weight_m;
  Eigen::Matrix<double, 3, kDigitFreedoms> jacobian;
  for (Eigen::Index i = 0; i < jacobian.cols(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    jacobian.col(i) = axes.axis[k].cross(axes.tip - axes.center[k]) / problem.tip_weight_m;
  }
  Derivatives result;
  result.descent = jacobian.transpose() * error + kStiffness.cwiseProduct(problem.tracked - x);
  result.gauss_newton = jacobian.transpose() * jacobian;
  result.gauss_newton.diagonal() += kStiffness;
  result.newton = result.gauss_newton;
  // Base abduction turns about an axis that base flexion carries along, so flexion comes first.
  constexpr std::array<std::size_t, kDigitFreedoms> kFromBase{1, 0, 2, 3};
  for (std::size_t i = 0; i < kDigitFreedoms; ++i) {
    for (std::size_t j = i; j < kDigitFreedoms; ++j) {
      const auto outer = static_cast<Eigen::Index>(kFromBase[i]);
      const auto inner = static_cast<Eigen::Index>(kFromBase[j]);
      const double bend = error.dot(axes.axis[kFromBase[i]].cross(jacobian.col(inner)));
      result.newton(outer, inner) -= bend;
      if (outer != inner) result.newton(inner, outer) -= bend;
    }
  }
  return result;
}

/// The damped step over the angles that are free to move; nothing where the Hessian, damped, is
/// not positive definite.
std::optional<DigitFreedoms> free_step(Hessian hessian, DigitFreedoms descent,
                                       const BendRange& bounds, const DigitFreedoms& x,
                                       const DigitFreedoms& damping) {
  hessian.diagonal() += damping;
  for (Eigen::Index i = 0; i < hessian.rows(); ++i) {
    if (!is_held(bounds, x, descent, i)) continue;
    hessian.row(i).setZero();
    hessian.col(i).setZero();
    hessian(i, i) = 1.0;
    descent[i] = 0.0;
  }
  const Eigen::LLT<Hessian> factor(hessian);
  if (factor.info() != Eigen::Success) return std::nullopt;
  return factor.solve(descent);
}

DigitFreedoms solve(const ReachProblem& problem, DigitFreedoms x, int most_steps) {
  DigitAxes axes = chain_axes(problem.chain, with_freedoms(problem.chain.angles, x));
  Derivatives at_x = derivatives_at(problem, axes, x);
  double cost = problem.cost(axes.tip, x);
  double damping = 1e-4;
  for (int step = 0; step < most_steps; ++step) {
    const DigitFreedoms damped = damping * at_x.gauss_newton.diagonal();
    std::optional<DigitFreedoms> change =
        free_step(at_x.newton, at_x.descent, problem.bounds, x, damped);
    if (!change) change = free_step(at_x.gauss_newton, at_x.descent, problem.bounds, x, damped);
    if (!change) break;
    const DigitFreedoms wanted =
        (x + *change).cwiseMax(problem.bounds.low).cwiseMin(problem.bounds.high);
    const double moved = (wanted - x).cwiseAbs().maxCoeff();
    if (moved < kSmallestStep_rad) break;
    const DigitAxes wanted_axes =
        chain_axes(problem.chain, with_freedoms(problem.chain.angles, wanted));
    const double wanted_cost = problem.cost(wanted_axes.tip, wanted);
    if (!(wanted_cost <= cost)) {
      damping = std::max(10.0 * damping, 1e-6);
      continue;
    }
    x = wanted;
    axes = wanted_axes;
    cost = wanted_cost;
    at_x = derivatives_at(problem, axes, x);
    damping *= 0.1;
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

double span_of(const PartContact& contact, const Vec3& base) {
  return (contact.target - base).norm();
}

/// Between a turn that falls short and one that does not: the turn at which the span is just
/// `reach_m`, by false position; the end that stays loses half its say (Illinois).
TurnSearch just_enough(const TurnedRay& ray, const Vec3& base, double reach_m, TurnSearch low,
                       TurnSearch high) {
  constexpr int kMostTries = 30;
  constexpr double kCloseEnough_m = 1e-7;
  double low_weight = span_of(low.contact, base) - reach_m;
  double high_weight = span_of(high.contact, base) - reach_m;
  for (int i = 0; i < kMostTries; ++i) {
    const double share = std::clamp(low_weight / (low_weight - high_weight), 0.01, 0.99);
    const double turn_rad = low.turn_rad + share * (high.turn_rad - low.turn_rad);
    const std::optional<PartContact> between = ray.at(turn_rad);
    if (!between) break;
    const double error_m = span_of(*between, base) - reach_m;
    if (std::abs(error_m) < kCloseEnough_m) return {*between, turn_rad};
    if (error_m < 0.0) {
      low = {*between, turn_rad};
      low_weight = error_m;
      high_weight *= 0.5;
    } else {
      high = {*between, turn_rad};
      high_weight = error_m;
      low_weight *= 0.5;
    }
  }
  return high;
}

/// The least turn for which base-to-tip is no shorter than `reach_m`; where none is, the turn
/// that comes closest.
TurnSearch extend(const TurnedRay& ray, const Vec3& base, double reach_m, double max_turn_rad) {
  constexpr int kSamples = 24;
  TurnSearch low{ray.straight, 0.0};
  TurnSearch longest = low;
  for (int i = 1; i <= kSamples; ++i) {
    const double turn_rad = max_turn_rad * i / kSamples;
    const std::optional<PartContact> contact = ray.at(turn_rad);
    if (!contact) break;
    const TurnSearch here{*contact, turn_rad};
    if (span_of(*contact, base) >= reach_m) return just_enough(ray, base, reach_m, low, here);
    if (span_of(*contact, base) > span_of(longest.contact, base)) longest = here;
    low = here;
  }
  return longest;
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
  ReachProblem problem{chain, target_world, tracked, bend_range(chain)};
  // Starting from the finger turned whole toward the target: of several answers it is always
  // the one next to the tracked shape.
  const Vec3 tip = chain_axes(chain, chain.angles).tip;
  const Quat turn = turn_toward(tip - chain.base, target_world - chain.base, 1.0);
  DigitFreedoms x = freedoms_of(turned_whole(chain, turn))
                        .cwiseMax(problem.bounds.low)
                        .cwiseMin(problem.bounds.high);
  for (double weight_m : kTipWeights_m) {
    problem.tip_weight_m = weight_m;
    x = solve(problem, x, kMostSteps);
  }
  return with_freedoms(chain.angles, x);
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
