// Graphics that fail frame after frame: the window is opened anew at its time, not at once four
// times over, and what is said at the end promises nothing.
#include "gui/app/window_restarts.h"

#include <gtest/gtest.h>

namespace palace {
namespace {

TEST(WindowRestarts, AreFiveSecondsApartThreeTimes) {
  WindowRestarts restarts;
  EXPECT_FALSE(restarts.waiting());
  EXPECT_TRUE(restarts.Stopped("reset", 100));
  EXPECT_TRUE(restarts.waiting());
  EXPECT_TRUE(restarts.TakeTurn(100)) << "the first time at once";
  EXPECT_FALSE(restarts.waiting());
  EXPECT_FALSE(restarts.TakeTurn(100)) << "once";
  for (const double at_s : {105.0, 110.0}) {
    EXPECT_TRUE(restarts.Stopped("reset", at_s - 4.9));
    EXPECT_FALSE(restarts.TakeTurn(at_s - 0.1));
    EXPECT_TRUE(restarts.waiting()) << "keys are obeyed until then";
    EXPECT_TRUE(restarts.TakeTurn(at_s));
  }
  const Status end = restarts.Stopped("no memory", 200);
  ASSERT_FALSE(end.ok());
  EXPECT_FALSE(restarts.waiting());
  EXPECT_EQ(end.error().message,
            "Window stopped: no memory. It was opened anew 3 times: start the station again");
}

}  // namespace
}  // namespace palace
