#include "tuning.h"

#include <array>

namespace nade {

std::span<const TuningInfo> tuning_table() {
  static constexpr std::array kTable{
      TuningInfo{"shift_stiffness", "1/m^2", 1000.0, 10000.0,
                 "holds the drawn hand on to the tracked place", &ProxyTuning::shift_stiffness},
      TuningInfo{"turn_stiffness", "1/rad^2", 2.0, 30.0,
                 "the wrist turns before the palm is lifted off", &ProxyTuning::turn_stiffness},
      TuningInfo{"abduction_stiffness", "1/rad^2", 2.0, 40.0, "fingers do not split around a leg",
                 &ProxyTuning::abduction_stiffness},
      TuningInfo{"knuckle_stiffness", "1/rad^2", 0.5, 10.0,
                 "a finger gives way at its knuckle first", &ProxyTuning::knuckle_stiffness},
      TuningInfo{"finger_stiffness", "1/rad^2", 1.0, 20.0, "and keeps its bend",
                 &ProxyTuning::finger_stiffness},
      TuningInfo{"thumb_stiffness", "1/rad^2", 0.5, 10.0, "the thumb lies down beside the hand",
                 &ProxyTuning::thumb_stiffness},
      TuningInfo{"seat_stiffness", "1/rad^2", 0.0, 400.0,
                 "a palm that is pressed flat does not tilt", &ProxyTuning::seat_stiffness},
      TuningInfo{"most_bent_back_rad", "rad", 0.0, 0.78,
                 "25 degrees: farther back a knuckle looks broken",
                 &ProxyTuning::most_bent_back_rad},
      TuningInfo{"joint_mass", "1", 0.5, 8.0, "steadies what the correction adds",
                 &ProxyTuning::joint_mass},
      TuningInfo{"offset_time_s", "s", 0.02, 0.2, "a velocity of its own lasts so long",
                 &ProxyTuning::offset_time_s},
      TuningInfo{"adhesion", "1/m^4", 3e6, 1e8, "per area of skin and height",
                 &ProxyTuning::adhesion},
      TuningInfo{"adhesion_height_m", "m", 0.001, 0.01, "it grows up to this gap, then is constant",
                 &ProxyTuning::adhesion_height_m},
      TuningInfo{"adhesion_from_m", "m", -0.02, 0.0,
                 "depth of the tracked patch from which it acts: a lifted finger stays lifted",
                 &ProxyTuning::adhesion_from_m},
      TuningInfo{"adhesion_full_m", "m", 0.005, 0.03, "and at which it is whole",
                 &ProxyTuning::adhesion_full_m},
      TuningInfo{"adhesion_reach_m", "m", 0.02, 0.1, "a patch farther off is let be",
                 &ProxyTuning::adhesion_reach_m},
      TuningInfo{"pressed_m", "m", 0.003, 0.03,
                 "depth of the deepest palmar skin at which the person surely presses",
                 &ProxyTuning::pressed_m},
      TuningInfo{"landing_m", "m", 0.005, 0.04, "skin brakes evenly over this way",
                 &ProxyTuning::landing_m},
      TuningInfo{"landing_damping", "s/m^2", 100.0, 3000.0, "as firmly as this",
                 &ProxyTuning::landing_damping},
      TuningInfo{"slide_time_s", "s", 1.0, 100.0,
                 "along the surface a correction fades so slowly that strokes are kept",
                 &ProxyTuning::slide_time_s},
      TuningInfo{"rest_speed_mps", "m/s", 0.003, 0.03,
                 "a drawn joint goes as fast as this though the person rests",
                 &ProxyTuning::rest_speed_mps},
  };
  return kTable;
}

}  // namespace nade
