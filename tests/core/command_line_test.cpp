// Numbers that no option may take.
#include "engine/core/command_line.h"

#include <string>

#include <gtest/gtest.h>

namespace palace {
namespace {

TEST(CommandLine, RangesRefuseWhatIsNoNumberWithin) {
  const CLI::Validator range = FiniteRange(0.5, 45);
  for (std::string good : {"0.5", "45", "1e1"}) {
    EXPECT_EQ(range(good), "") << good;
  }
  for (std::string bad : {"nan", "-nan", "inf", "-1", "45.001", "wide", ""}) {
    EXPECT_EQ(range(bad), bad + " is not within 0.5 to 45");
  }
}

TEST(CommandLine, SeedsDoNotWrapAround) {
  const CLI::Validator seed = Seed();
  for (std::string good : {"0", "7", "18446744073709551615"}) {
    EXPECT_EQ(seed(good), "") << good;
  }
  for (std::string bad : {"-1", "18446744073709551616", "1.5", "0x7", "seven", " 7", ""}) {
    EXPECT_NE(seed(bad).find("is no seed: a whole number from 0 to"), std::string::npos) << bad;
  }
}

}  // namespace
}  // namespace palace
