#include "digit_contact.h"

#include <algorithm>

#include "hand/phalanx.h"
#include "ramps.h"

namespace nade {
namespace {

/// 1/m^2. Softer than the surface, so that fingers do not stop dead at each other; much stiffer
/// than what bends them.
constexpr double kPhalanxStiffness = 1e5;
/// A digit that is on the other side of its neighbour than the tracked one may pass: by the cosine
/// between their ways to the neighbour.
constexpr double kPasses = -0.9;
constexpr double kKept = -0.5;

/// A point so far along a phalanx.
FleshPoint point_on(std::size_t phalanx, double share) {
  FleshPoint point;  // its heavier joint first
  const bool late = share > 0.5;
  point.attach(0, late ? phalanx : phalanx - 1, late ? share : 1.0 - share, Vec3::Zero());
  point.attach(1, late ? phalanx - 1 : phalanx, late ? 1.0 - share : share, Vec3::Zero());
  return point;
}

class Digits {
 public:
  Digits(const HandModel& model, const HandFlesh& flesh, const PosedHand& posed, double reach_m,
         double stiffness, std::vector<ContactTerm>& terms)
      : model_(model),
        flesh_(flesh),
        posed_(posed),
        reach_m_(reach_m),
        stiffness_(stiffness),
        terms_(terms) {
    for (const std::size_t i : kPhalanges) {
      const Vec3& start = posed.hand.joints[i - 1].position;
      const Vec3& end = posed.hand.joints[i].position;
      middle_[i] = 0.5 * (start + end);
      extent_m_[i] = 0.5 * (end - start).norm() + model.scale * flesh.phalanx_radius_m[i] + reach_m;
    }
  }

  void keep_apart(std::size_t one, std::size_t other) {
    const double extent_m = extent_m_[one] + extent_m_[other];
    if ((middle_[one] - middle_[other]).squaredNorm() > extent_m * extent_m) return;
    const double thick_m =
        model_.scale * (flesh_.phalanx_radius_m[one] + flesh_.phalanx_radius_m[other]);
    const NearestPoints drawn = nearest_of(posed_.hand, one, other);
    const double apart_m = drawn.way.norm();
    if (apart_m - thick_m > 2.0 * reach_m_ || apart_m == 0.0) return;
    const NearestPoints tracked = nearest_of(model_.tracked, one, other);
    const double tracked_m = tracked.way.norm();
    const double gap_m = apart_m - std::min(thick_m, tracked_m);
    if (gap_m > 2.0 * reach_m_ || tracked_m == 0.0) return;
    const Vec3 normal = drawn.way / apart_m;
    const Vec3 side = posed_.hand[Joint::palm].rotation *
                      (model_.tracked[Joint::palm].rotation.conjugate() * tracked.way);
    const double stiffness = stiffness_ * smoothstep(kPasses, kKept, normal.dot(side) / tracked_m);
    if (stiffness == 0.0) return;
    add(point_on(one, drawn.one_share), normal, 0.5 * gap_m, stiffness);
    add(point_on(other, drawn.other_share), -normal, 0.5 * gap_m, stiffness);
  }

 private:
  void add(const FleshPoint& point, const Vec3& normal, double gap_m, double stiffness) {
    if (terms_.size() == terms_.capacity()) return;
    ContactTerm& term = terms_.emplace_back();
    term.kind = ContactKind::digits;
    term.row = motion_along(posed_, point, normal);
    term.row.wrist.setZero();  // takes the other digit along
    term.row.gap_m = gap_m;
    term.stiffness = stiffness;
  }

  const HandModel& model_;
  const HandFlesh& flesh_;
  const PosedHand& posed_;
  double reach_m_;
  double stiffness_;
  std::vector<ContactTerm>& terms_;
  JointVectors middle_{};                       ///< of each phalanx
  std::array<double, kJointCount> extent_m_{};  ///< how far from it another may matter
};

}  // namespace

void keep_digits_apart(const HandModel& model, const HandFlesh& flesh, const PosedHand& posed,
                       double reach_m, double firmness, std::vector<ContactTerm>& terms) noexcept {
  if (firmness == 0.0) return;
  Digits digits(model, flesh, posed, reach_m, firmness * kPhalanxStiffness, terms);
  for (const auto& [one, other] : kPhalanxPairs) digits.keep_apart(one, other);
}

}  // namespace nade
