// nade in a live frame loop: the tracker calls back with a hand, the loop draws a corrected one.
// Here the tracker is made up (a flat hand that strokes along a table, pressing into it) and
// drawing is printing; what `main` makes, and its call of `update`, a program of yours would keep.

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <string>

#include "nade/corrector.h"
#include "nade/hand.h"
#include "nade/surface.h"

namespace {

constexpr double kSkinToJoint_m = 0.02;  ///< about half the thickness of a hand

nade::HandPose flat_hand(const nade::Vec3& palm) {
  constexpr std::array<double, 5> kFinger{0.03, -0.035, -0.075, -0.1, -0.12};
  constexpr std::array<double, 4> kThumb{0.03, 0.0, -0.03, -0.06};
  nade::HandPose hand;
  hand[nade::Joint::palm].position = palm;
  hand[nade::Joint::wrist].position = palm + nade::Vec3(0.0, 0.0, 0.06);
  for (std::size_t d = 0; d < nade::kDigitCount; ++d) {
    const nade::DigitJoints joints = nade::joints_of(nade::digit_at(d));
    const double x = 0.02 * (static_cast<double>(d) - 2.0);
    for (std::size_t i = 0; i < joints.count(); ++i) {
      const double z = d == 0 ? kThumb[i] : kFinger[i];
      hand.joints[nade::index_of(joints.metacarpal) + i].position = palm + nade::Vec3(x, 0.0, z);
    }
  }
  return hand;
}

/// Two seconds at 90 Hz: down to 30 mm below the table's top and up again, forward all the time.
void run_tracker(const std::function<void(const nade::HandPose&, std::int64_t)>& on_hand) {
  for (int frame = 0; frame < 180; ++frame) {
    const double phase = frame / 180.0;
    const double height = kSkinToJoint_m + 0.05 - 0.08 * std::sin(3.14159265 * phase);
    on_hand(flat_hand({0.0, height, -0.2 * phase}), frame * std::int64_t{11'111'111});
  }
}

void draw(const nade::HandPose& tracked, const nade::CorrectedHand& hand) {
  const auto height_mm = [](const nade::HandPose& pose) {
    return 1000.0 * pose[nade::Joint::palm].position.y();
  };
  std::printf("tracked palm at %6.1f mm, drawn at %6.1f mm, %s\n", height_mm(tracked),
              height_mm(hand.pose), std::string(nade::name_of(hand.status)).c_str());
}

}  // namespace

int main() {
  const nade::PlaneSurface table;
  const nade::Object object(table);  // a placement moves, turns and scales it
  nade::HandCorrector corrector;     // one for each hand
  run_tracker([&](const nade::HandPose& tracked, std::int64_t time_ns) {
    draw(tracked, corrector.update(tracked, object, time_ns));
  });
  return 0;
}
