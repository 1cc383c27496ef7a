// When an engine is started again, and when it is said to hang.
#include "engine/runtime/engine_watch.h"

#include <gtest/gtest.h>

namespace palace {
namespace {

TEST(EngineWatch, RestartsThreeTimesFiveSecondsApart) {
  EngineWatch watch;
  EXPECT_EQ(watch.Stopped("Engine", "x", 100), 100);
  watch.Started(100);
  EXPECT_EQ(watch.Stopped("Engine", "x", 101), 105);
  EXPECT_NE(watch.Complaint(103).find("starts again in 2 s"), std::string::npos);
  watch.Started(105);
  EXPECT_EQ(watch.Stopped("Engine", "x", 500), 500);
  watch.Started(500);
  EXPECT_FALSE(watch.Stopped("Engine", "y", 900).has_value());
  EXPECT_NE(watch.Complaint(900).find("Engine stopped: y. It was started again 3 times"),
            std::string::npos);
}

TEST(EngineWatch, APassIsSaidToHangOnlyBeyondItsLimit) {
  EngineWatch watch;
  EXPECT_EQ(watch.Complaint(50), "");
  watch.Begin(50);
  EXPECT_EQ(watch.Complaint(51), "");
  EXPECT_NE(watch.Complaint(51.5).find("1.5 s, limit 1 s"), std::string::npos);
  watch.End();
  EXPECT_EQ(watch.Complaint(99), "");
}

}  // namespace
}  // namespace palace
