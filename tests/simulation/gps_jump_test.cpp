// A GPS that jumps must not end a landing that vision steers well: the watch over the estimates
// asks the vehicle's own velocity, and that comes through.
#include <gtest/gtest.h>

#include "engine/flight/estimate_watch.h"
#include "engine/simulation/vehicle_navigator.h"

namespace palace {
namespace {

using Eigen::Vector3d;

TEST(GpsJump, DoesNotMakeTheEstimatesLookAstray) {
  for (const double jump_m : {0.0, 3.0, 10.0, -10.0}) {
    SCOPED_TRACE(jump_m);
    GpsNavigator navigator({{0}, Vector3d::Zero(), Vector3d::Zero()}, 0.03);
    EstimateWatch watch;
    ASSERT_EQ(watch.Begin(Vector3d::Zero(), Vector3d::Zero()), "");
    double own_moved_m = 0;
    for (int step = 1; step <= 60 * 100; ++step) {
      const Timestamp now{step * 10'000};
      navigator.Propagate(now, Vector3d::Zero());
      if (step % 20 == 0) {
        const double off_m = step > 20 * 100 ? jump_m : 0;
        navigator.Update({now, {off_m, 0, 0}, Vector3d::Zero(), 1.5, 2.5});
      }
      if (step % 2 == 0) {
        watch.Propagate(now, navigator.now().v_WB);
      }
      if (step % 10 == 0) {
        PositionEstimate estimate;
        estimate.time = now;
        ASSERT_EQ(watch.Judge(estimate), "") << "after " << step / 100.0 << " s";
      }
      own_moved_m = std::max(own_moved_m, std::abs(navigator.now().p_WB.x()));
    }
    EXPECT_GE(own_moved_m, 0.3 * std::abs(jump_m)) << "the own position followed its GPS";
  }
}

}  // namespace
}  // namespace palace
