// Four threads with hands of their own in one scene, who make and destroy handles all the while.

#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

#include "nade.h"

namespace {

std::atomic<int> g_errors{0};

void expect(nade_status expected, nade_status status) {
  if (status != expected) ++g_errors;
}

/// How many of the frames were corrected.
int stroke(const nade_scene* scene, nade_side side) {
  nade_corrector* corrector = nullptr;
  expect(NADE_OK, nade_corrector_create(nullptr, &corrector));
  int corrected = 0;
  for (int frame = 0; frame < 60; ++frame) {
    nade_surface* surface = nullptr;
    expect(NADE_OK, nade_surface_create_sphere(0.1, &surface));
    expect(NADE_OK, nade_surface_destroy(surface));
    expect(NADE_ERROR_ARGUMENT, nade_surface_create_sphere(-1.0, &surface));
    if (nade_last_error()[0] == '\0') ++g_errors;
    nade_joint joints[NADE_JOINT_COUNT];
    expect(NADE_OK, nade_rest_hand(side, joints));
    for (nade_joint& joint : joints)
      joint.position[1] += 0.05F - 0.001F * static_cast<float>(frame);
    nade_result result{};
    result.size = sizeof result;
    expect(NADE_OK, nade_corrector_update_scene(corrector, side, joints, scene,
                                                std::int64_t{11'000'000} * frame, &result));
    if (result.status == NADE_HAND_CORRECTED) ++corrected;
  }
  expect(NADE_OK, nade_corrector_destroy(corrector));
  return corrected;
}

}  // namespace

int main() {
  nade_scene* scene = nullptr;
  nade_surface* plane = nullptr;
  expect(NADE_OK, nade_scene_create(&scene));
  expect(NADE_OK, nade_surface_create_plane(&plane));
  expect(NADE_OK, nade_scene_add(scene, 1, plane, nullptr, nullptr));
  expect(NADE_OK, nade_surface_destroy(plane));
  std::atomic<int> hands{0};
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&, i] { hands += stroke(scene, i % 2) > 0 ? 1 : 0; });
  }
  for (std::thread& thread : threads) thread.join();
  expect(NADE_OK, nade_scene_destroy(scene));
  return g_errors == 0 && hands == 4 ? 0 : 1;
}
