#include "tuning.h"

#include <array>

namespace nade {

std::span<const TuningInfo> tuning_table() {
  static constexpr std::array kTable{
      TuningInfo{"place_stiffness", "1/m^2", 1000.0, 30000.0,
                 "shared by the joints: holds the drawn ones to the tracked",
                 &ProxyTuning::place_stiffness},
      TuningInfo{"knuckle_stiffness", "1/rad^2", 0.0, 10.0,
                 "a finger gives way at its knuckle first; the thumb lies down beside the hand",
                 &ProxyTuning::knuckle_stiffness},
      TuningInfo{"finger_stiffness", "1/rad^2", 0.0, 40.0,
                 "a finger keeps its bend, and twice as firmly its place beside the others",
                 &ProxyTuning::finger_stiffness},
      TuningInfo{"seat_stiffness", "1/rad^2", 0.0, 400.0,
                 "a palm that is pressed flat does not tilt", &ProxyTuning::seat_stiffness},
      TuningInfo{"joint_mass", "1", 0.0, 8.0, "steadies what the correction adds",
                 &ProxyTuning::joint_mass},
      TuningInfo{"offset_time_s", "s", 0.0, 0.2, "a velocity of its own lasts so long",
                 &ProxyTuning::offset_time_s},
      TuningInfo{"adhesion", "1/m^4", 0.0, 1e8, "per area of skin and height",
                 &ProxyTuning::adhesion},
      TuningInfo{"adhesion_height_m", "m", 0.001, 0.01, "it grows up to this gap, then is constant",
                 &ProxyTuning::adhesion_height_m},
      TuningInfo{"adhesion_full_m", "m", 0.005, 0.03,
                 "depth of the tracked patch at which it is whole; with more, lifted fingers are "
                 "drawn down",
                 &ProxyTuning::adhesion_full_m},
      TuningInfo{"adhesion_reach_m", "m", 0.02, 0.1,
                 "a patch farther off is let be, a part farther off does not touch",
                 &ProxyTuning::adhesion_reach_m},
      TuningInfo{"pressed_m", "m", 0.003, 0.03,
                 "deepest palmar skin at which the person surely presses", &ProxyTuning::pressed_m},
      TuningInfo{"landing_m", "m", 0.005, 0.04, "skin brakes evenly over this way",
                 &ProxyTuning::landing_m},
      TuningInfo{"slide_time_s", "s", 0.0, 100.0,
                 "along the surface a correction fades so slowly that strokes are kept",
                 &ProxyTuning::slide_time_s},
      TuningInfo{"unnoticed_m", "m", 0.0, 0.05,
                 "a shift so far off goes unnoticed; what is more comes back",
                 &ProxyTuning::unnoticed_m},
      TuningInfo{"step_up_m", "m", 0.0, 0.1,
                 "what holds skin back so far is stepped over, where it is low",
                 &ProxyTuning::step_up_m},
      TuningInfo{"rest_speed_mps", "m/s", 0.0, 0.03,
                 "a drawn joint may go so fast while the person rests",
                 &ProxyTuning::rest_speed_mps},
      TuningInfo{"let_go_s", "s", 0.05, 1.0,
                 "held up for so long while the person is clear of the object, a hand is let go",
                 &ProxyTuning::let_go_s},
      TuningInfo{"elsewhere_m", "m", 0.05, 0.5, "a hand so far off was left behind",
                 &ProxyTuning::elsewhere_m},
      TuningInfo{"return_s", "s", 0.1, 1.0,
                 "what the person did not ask for comes and goes in about this time",
                 &ProxyTuning::return_s},
  };
  return kTable;
}

}  // namespace nade
