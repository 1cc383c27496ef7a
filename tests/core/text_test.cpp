// Numbers in words.
#include "engine/core/text.h"

#include <cmath>

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace palace
