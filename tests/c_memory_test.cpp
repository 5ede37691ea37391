#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <new>

#include "nade.h"

namespace {

/// How many allocations may still succeed; below 0: all.
long g_left = -1;

}  // namespace

void* operator new(std::size_t size) {
  if (g_left == 0) throw std::bad_alloc();
  if (g_left > 0) --g_left;
  void* const memory = std::malloc(size == 0 ? 1 : size);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  if (g_left == 0) return nullptr;
  if (g_left > 0) --g_left;
  return std::malloc(size == 0 ? 1 : size);
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, const std::nothrow_t&) noexcept { std::free(memory); }

namespace {

template <class Call>
nade_status with_memory_for(long allocations, Call&& call) {
  g_left = allocations;
  const nade_status status = call();
  g_left = -1;
  return status;
}

/// Lets the first allocation of `call` fail, the second, and so on, until it succeeds.
template <class Call>
void expect_only_memory_errors(Call&& call) {
  for (long allocations = 0; allocations < 10000; ++allocations) {
    const nade_status status = with_memory_for(allocations, call);
    if (status == NADE_OK) {
      EXPECT_GT(allocations, 0);
      return;
    }
    ASSERT_EQ(status, NADE_ERROR_MEMORY) << nade_last_error();
  }
  FAIL() << "it never succeeds";
}

TEST(CMemory, WhereNoneIsLeftTheCallFails) {
  nade_corrector* corrector = nullptr;
  expect_only_memory_errors([&] { return nade_corrector_create(nullptr, &corrector); });
  EXPECT_EQ(nade_corrector_destroy(corrector), NADE_OK);

  const std::array<float, 12> corners{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  nade_surface* hull = nullptr;
  expect_only_memory_errors([&] { return nade_surface_create_hull(corners.data(), 4, &hull); });
  EXPECT_EQ(nade_surface_destroy(hull), NADE_OK);

  const std::array<std::uint32_t, 3> triangle{0, 2, 1};
  nade_mesh mesh{};
  mesh.size = sizeof mesh;
  mesh.vertex_count = 4;
  mesh.triangle_count = 1;
  mesh.vertices = corners.data();
  mesh.triangles = triangle.data();
  nade_surface* sheet = nullptr;
  expect_only_memory_errors([&] { return nade_surface_create_mesh(&mesh, nullptr, &sheet); });
  EXPECT_EQ(nade_surface_destroy(sheet), NADE_OK);
}

TEST(CMemory, AnObjectThatFindsNoneIsNotInTheScene) {
  nade_scene* scene = nullptr;
  nade_surface* plane = nullptr;
  ASSERT_EQ(nade_scene_create(&scene), NADE_OK);
  ASSERT_EQ(nade_surface_create_plane(&plane), NADE_OK);
  for (std::uint64_t id = 0; id < 100; ++id) {
    const auto add = [&] { return nade_scene_add(scene, id, plane, nullptr, nullptr); };
    std::size_t size = 0;
    for (long allocations = 0; with_memory_for(allocations, add) != NADE_OK; ++allocations) {
      ASSERT_EQ(nade_scene_size(scene, &size), NADE_OK);
      ASSERT_EQ(size, id);
    }
    ASSERT_EQ(nade_scene_size(scene, &size), NADE_OK);
    ASSERT_EQ(size, id + 1);
  }
  EXPECT_EQ(nade_surface_destroy(plane), NADE_OK);
  EXPECT_EQ(nade_scene_destroy(scene), NADE_OK);
}

}  // namespace
