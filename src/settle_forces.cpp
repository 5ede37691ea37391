#include "settle_forces.h"

#include <array>

#include "settle_solver.h"

namespace nade {

ContactForces contact_forces(const PosedHand& posed, const std::vector<ContactRow>& rows,
                             const HandFreedoms& step, const Eigen::Matrix3d& frame) noexcept {
  ContactForces forces;
  Eigen::Matrix<double, 6, 1> wrist = Eigen::Matrix<double, 6, 1>::Zero();
  std::array<Eigen::Matrix4d, kDigitCount> bend;
  bend.fill(Eigen::Matrix4d::Zero());
  for (const ContactRow& row : rows) {
    if (row.kind == RowKind::climb || row.kind == RowKind::hold_back) continue;
    const double gap_m = gap_after(row, step);
    if (const double force = force_at(row, gap_m); force != 0.0) {
      const LeverGrowth growth = lever_growth(posed, row, frame);
      wrist -= force * growth.wrist;
      if (row.digit) bend[index_of(*row.digit)] -= force * growth.bend;
    }
    if (gap_m > row.push_reach_m()) continue;
    forces.touches = true;
    if (row.kind == RowKind::draw_near) continue;
    forces.push += (row.push_reach_m() - gap_m) * (frame * row.wrist.head<3>());
  }
  // By rows, so that it is no less than the matrix where that is above 0 (Gershgorin).
  forces.geometric.head<6>() = wrist.cwiseMax(0.0);
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    const DigitFreedoms own = bend[d].diagonal();
    forces.geometric.segment<4>(first_freedom(d)) =
        (bend[d].cwiseAbs().rowwise().sum() + own - own.cwiseAbs()).cwiseMax(0.0);
  }
  return forces;
}

}  // namespace nade
