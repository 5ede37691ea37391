#pragma once

#include <algorithm>
#include <cstdint>

#include "hand/freedoms.h"

namespace nade {

/// What a term of the energy does to a point of the hand.
enum class ContactKind : std::uint8_t {
  flesh,     ///< keeps skin out of the object beyond its flesh depth
  adhesion,  ///< draws palmar skin to the surface
  landing,   ///< brakes skin that comes down
  speed,     ///< holds back a joint that would outrun the person
  digits,    ///< keeps digits out of each other
};

/// One point of the hand against one plane. Its force is piecewise linear in the gap.
struct ContactTerm {
  ContactRow row;
  ContactKind kind = ContactKind::flesh;
  double stiffness = 0.0;  ///< 1/m^2
  /// Adhesion pulls above 0 and grows up to this gap; all else pushes below it.
  double edge_m = 0.0;

  /// Along the gap: above 0 where it pushes.
  [[nodiscard]] double force_at(double gap_m) const noexcept {
    if (kind == ContactKind::adhesion) return -stiffness * std::clamp(gap_m, 0.0, edge_m);
    return stiffness * std::max(0.0, edge_m - gap_m);
  }

  /// How that falls with the gap.
  [[nodiscard]] double stiffness_at(double gap_m) const noexcept {
    const bool acts =
        kind == ContactKind::adhesion ? gap_m > 0.0 && gap_m < edge_m : gap_m < edge_m;
    return acts ? stiffness : 0.0;
  }

  /// Whether `stiffness_at` changes between two gaps.
  [[nodiscard]] bool bends_between(double one_m, double other_m) const noexcept {
    const auto [low_m, high_m] = std::minmax(one_m, other_m);
    const auto lies_between = [low = low_m, high = high_m](double at) {
      return low < at && at < high;
    };
    return lies_between(edge_m) || (kind == ContactKind::adhesion && lies_between(0.0));
  }
};

}  // namespace nade
