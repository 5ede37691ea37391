// Two hands on one mesh, each corrected on a thread of its own: for the thread sanitizer.
#include <array>
#include <cmath>
#include <cstdint>
#include <thread>

#include "nade/corrector.h"
#include "nade/mesh.h"
#include "support/meshes.h"
#include "support/sample_hand.h"

namespace {

using namespace nade;

/// Strokes over the box and presses into it; how many frames were corrected.
int stroke(const Object& object, Method method, Handedness side) {
  CorrectorOptions options;
  options.method = method;
  HandCorrector corrector(options);
  const HandPose hand = test::sample_hand(side);
  int corrected = 0;
  for (int frame = 0; frame < 120; ++frame) {
    const double phase = 0.05 * frame;
    const Vec3 palm(0.05 * std::sin(phase), 0.04 - 0.03 * std::sin(0.5 * phase), 0.02);
    const auto& drawn =
        corrector.update(test::placed_hand(hand, palm), object, std::int64_t{11'000'000} * frame);
    if (drawn.status == HandStatus::corrected) ++corrected;
  }
  return corrected;
}

}  // namespace

int main() {
  const auto soup = test::subdivided(test::box_mesh({0.1F, 0.02F, 0.1F}), 3);
  const auto mesh = MeshSurface::build(soup, "box");
  const Object object(**mesh);
  for (const Method method : {Method::paper, Method::nade}) {
    std::array<int, 2> corrected{};
    std::thread left([&] { corrected[0] = stroke(object, method, Handedness::left); });
    std::thread right([&] { corrected[1] = stroke(object, method, Handedness::right); });
    left.join();
    right.join();
    if (corrected[0] == 0 || corrected[1] == 0) return 1;
  }
  return 0;
}
