#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <utility>

#include "nade/io/hand_file.h"

namespace nade::test {

/// The viewer looks for hands and dog among what was built.
inline const bool kAssetsNamed = [] {
  return ::setenv("NADE_ASSETS", NADE_TEST_HANDS_DIR "/..", 1) == 0;
}();

inline HandPose relaxed_hand() {
  Result<HandPose> hand = load_relaxed_hand(Handedness::right);
  EXPECT_TRUE(hand.ok());
  return std::move(hand).value();
}

}  // namespace nade::test
