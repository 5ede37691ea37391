#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <string>

#include "nade/io/hand_file.h"

namespace nade::test {

/// The fetched generic hand, where it is there.
inline std::optional<std::string> generic_hand_path(Handedness side) {
  const std::string path =
      std::string(NADE_TEST_HANDS_DIR) + "/" + std::string(name_of(side)) + ".glb";
  if (!std::filesystem::exists(path)) return std::nullopt;
  return path;
}

/// Loaded; no value where it was not fetched.
inline std::optional<HandMesh> generic_hand(Handedness side) {
  const std::optional<std::string> path = generic_hand_path(side);
  if (!path) return std::nullopt;
  Result<HandMesh> mesh = load_hand_mesh(*path, side);
  EXPECT_TRUE(mesh) << mesh.error().message;
  if (!mesh) return std::nullopt;
  return std::move(mesh).value();
}

}  // namespace nade::test

/// Declares `mesh`, the generic hand of `side`, or skips the test, visibly, without it.
#define NADE_TEST_GENERIC_HAND(mesh, side)                                                 \
  const std::optional<::nade::HandMesh> mesh##_found = ::nade::test::generic_hand(side);   \
  if (!mesh##_found) GTEST_SKIP() << "the generic hand is not in " << NADE_TEST_HANDS_DIR; \
  const ::nade::HandMesh& mesh = *mesh##_found
