#include "nade/version.h"

#include <gtest/gtest.h>

#include <string>

namespace nade {
namespace {

TEST(Version, SaysTheSameEverywhere) {
  EXPECT_EQ(std::to_string(NADE_VERSION_MAJOR) + "." + std::to_string(NADE_VERSION_MINOR) + "." +
                std::to_string(NADE_VERSION_PATCH),
            NADE_VERSION);
  EXPECT_STREQ(version(), NADE_VERSION);
  EXPECT_STREQ(NADE_PROJECT_VERSION, NADE_VERSION);
}

}  // namespace
}  // namespace nade
