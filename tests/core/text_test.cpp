// Numbers in words.
#include "engine/core/text.h"

#include <cmath>

#include <gtest/gtest.h>

#include "engine/core/shown_difference.h"

namespace palace {
namespace {

TEST(Text, NumbersReadAsTheyAreMeant) {
  EXPECT_EQ(WithNumbers("%.1f to %.0f", 0.25, 3), "0.2 to 3");
  EXPECT_EQ(OrDash("%.2f m", 1.5), "1.50 m");
  EXPECT_EQ(OrDash("%.2f m", NAN), "-");
  EXPECT_EQ(OrDash("%.2f m", -INFINITY), "-");
  EXPECT_EQ(NumberText(0.1), "0.1");
  EXPECT_EQ(NumberText(15.24), "15.24");
  EXPECT_EQ(NumberText(1e20), "1e+20");
  EXPECT_EQ(NumberText(NAN), "nan");
  EXPECT_EQ(Joined({"a", "b", "c"}), "a, b, c");
  EXPECT_EQ(Joined({}), "");
}

TEST(Text, ADifferenceIsThatOfTheNumbersThatAreShown) {
  EXPECT_EQ(WithNumbers("%.1f", DifferenceAsShown(3.66, 2.64)), "1.1") << "3.7 and 2.6 are read";
  EXPECT_EQ(WithNumbers("%.1f", DifferenceAsShown(2.64, 3.66)), "-1.1");
  EXPECT_EQ(WithNumbers("%.1f", DifferenceAsShown(2.64, 2.56)), "0.1") << "both read 2.6";
  EXPECT_TRUE(std::isnan(DifferenceAsShown(NAN, 1)));
  EXPECT_TRUE(std::isinf(DifferenceAsShown(INFINITY, 1)));
}

}  // namespace
}  // namespace palace
