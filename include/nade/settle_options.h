#pragma once

namespace nade {

/// Friction to be seen, not felt: the drawn hand lags the person's along the surface, then slips.
struct VisibleFriction {
  double coefficient = 0.0;     ///< lag over pressing depth at which it slips, 0 (none) to 2
  double kinetic = 0.6;         ///< share of that lag which is left while it slips, 0 to 1
  double longest_lag_m = 0.03;  ///< whatever the depth
};

/// No object is softer.
inline constexpr double kSoftest_m = 0.02;

/// What the object under the hand is like.
struct SettleOptions {
  /// The skin sinks in this far at the most, metres: 0 for a hard object, up to `kSoftest_m`.
  double softness_m = 0.0;
  /// Pressing so deep makes it sink by two thirds of that, metres, above 0.
  double softness_depth_m = 0.02;
  VisibleFriction friction;
};

}  // namespace nade
