#pragma once

#include <span>

namespace nade {

/// How the proxy hand lies on a surface, goes along it, and leaves it: the numbers of its energy
/// and of its modes. What follows from one of them stands beside its use, as a share of it; what is
/// numerics, anatomy, or of trackers says so where it stands. Stiffnesses are those of one energy,
/// in which a turn of one radian about a joint of stiffness 1 costs one half. Each member's unit,
/// range and reason are in `tuning_table`.
struct ProxyTuning {
  double place_stiffness = 10000.0;
  double knuckle_stiffness = 2.0;
  double finger_stiffness = 10.0;
  double seat_stiffness = 100.0;
  double joint_mass = 2.0;
  double offset_time_s = 0.06;
  double adhesion = 1.5e7;
  double adhesion_height_m = 0.003;
  double adhesion_full_m = 0.012;
  double adhesion_reach_m = 0.05;
  double pressed_m = 0.01;
  double landing_m = 0.02;
  double slide_time_s = 10.0;
  double unnoticed_m = 0.02;
  double step_up_m = 0.024;
  double rest_speed_mps = 0.01;
  double let_go_s = 0.16;
  double elsewhere_m = 0.13;
  double return_s = 0.2;
};

/// One of its numbers, for tables and options.
struct TuningInfo {
  const char* name;  ///< the member's
  const char* unit;
  double least;  ///< what it may be set to
  double most;
  const char* why;
  double ProxyTuning::*value;
};

/// All of them, in order.
[[nodiscard]] std::span<const TuningInfo> tuning_table();

}  // namespace nade
