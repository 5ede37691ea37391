#include <utility>

#include "nade/eval/scene.h"
#include "nade/skeleton.h"

namespace nade {
namespace {

constexpr std::optional<Bend> bend(double base_deg, double middle_deg, double last_deg) {
  return Bend{base_deg * kDegree, middle_deg * kDegree, last_deg * kDegree, std::nullopt};
}
constexpr std::optional<Bend> bend(double base_deg, double middle_deg, double last_deg,
                                   double abduction_deg) {
  return Bend{base_deg * kDegree, middle_deg * kDegree, last_deg * kDegree,
              abduction_deg * kDegree};
}

constexpr std::optional<Bend> kAsRelaxed{};
constexpr std::optional<Bend> kStraight = bend(0, 4, 2);
constexpr std::optional<Bend> kClosed = bend(80, 95, 55, 0);
constexpr std::optional<Bend> kThumbOver = bend(25, 35, 45, 10);

/// Thumb, index, middle, ring, little.
constexpr std::array<std::pair<std::string_view, Gesture>, 10> kGestures{{
    {"relaxed", Gesture{}},
    {"flat", Gesture{kAsRelaxed, kStraight, kStraight, kStraight, kStraight}},
    {"fist", Gesture{kThumbOver, kClosed, kClosed, kClosed, kClosed}},
    {"one_finger", Gesture{kThumbOver, kStraight, kClosed, kClosed, kClosed}},
    {"two_fingers", Gesture{kThumbOver, kStraight, kStraight, kClosed, kClosed}},
    {"index_lifted", Gesture{kAsRelaxed, bend(-30, 4, 2), kAsRelaxed, kAsRelaxed, kAsRelaxed}},
    {"pinch", Gesture{bend(30, 20, 20, 35), bend(50, 45, 20), bend(55, 50, 25), bend(60, 60, 35),
                      bend(60, 60, 35)}},
    {"pinch_open", Gesture{bend(5, 10, 10, 40), bend(25, 30, 15), bend(35, 40, 20),
                           bend(45, 50, 30), bend(45, 50, 30)}},
    {"wrap", Gesture{bend(25, 20, 20, 45), bend(45, 60, 35), bend(50, 65, 35), bend(50, 65, 35),
                     bend(50, 60, 35)}},
    {"claw", Gesture{bend(10, 20, 30), bend(15, 60, 40), bend(15, 60, 40), bend(15, 60, 40),
                     bend(15, 60, 40)}},
}};

}  // namespace

std::optional<Gesture> gesture_from_name(std::string_view name) {
  for (const auto& [known, gesture] : kGestures) {
    if (known == name) return gesture;
  }
  return std::nullopt;
}

std::string gesture_names() {
  std::string names;
  for (const auto& [known, gesture] : kGestures) {
    names += (names.empty() ? "" : ", ") + std::string(known);
  }
  return names;
}

}  // namespace nade
