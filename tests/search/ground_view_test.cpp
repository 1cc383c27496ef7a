// What a rig's pictures show of level ground, against its geometry worked out by hand.
#include "engine/search/ground_view.h"

#include <cmath>

#include <gtest/gtest.h>

#include "engine/camera/pinhole.h"
#include "engine/core/units.h"

namespace palace {
namespace {

/// 60 by 45 degrees or so, a baseline of 1 m, looking down by `down_deg`.
StereoRig Rig(double down_deg) {
  StereoRig rig;
  rig.left.pinhole = rig.right.pinhole = PinholeFromFov(640, 480, Rad(60));
  rig.tilt_rad = -Rad(down_deg);
  return rig;
}

TEST(GroundView, StraightDownItIsTheRectangleThatBothPicturesShow) {
  const GroundView view(Rig(90));
  const double half_m = 10 * std::tan(Rad(30));  // 5.77 m to either side
  struct Row {
    Eigen::Vector3d p_BQ;
    bool shown;
  };
  for (const Row& row :
       {Row{{0, 0, 10}, true}, Row{{0, half_m - 0.1, 10}, true}, Row{{0, half_m + 0.1, 10}, false},
        Row{{0, 1 - half_m + 0.1, 10}, true},  // the right camera sees no farther
        Row{{0, 1 - half_m - 0.1, 10}, false}, Row{{half_m * 0.75 - 0.1, 0, 10}, true},
        Row{{half_m * 0.75 + 0.1, 0, 10}, false}, Row{{0, 0, -1}, false}}) {
    EXPECT_EQ(view.Shows(row.p_BQ), row.shown) << row.p_BQ.transpose();
  }
}

TEST(GroundView, AheadItEndsWhereHalfAsManyPixelsFallOnAMetre) {
  const StereoRig rig = Rig(45);
  const GroundView view(rig);
  // Middle at slant 10 sqrt(2); half as many pixels a metre at slant 20, 17.3 m ahead.
  EXPECT_NEAR(view.Reach_m(10), std::sqrt(300.0), 1e-9);
  EXPECT_TRUE(view.Shows({17.2, 0, 10}));
  EXPECT_FALSE(view.Shows({17.4, 0, 10})) << "the picture shows it, too coarsely";
  const double near_m = 10 * std::tan(Rad(45) - std::atan(0.75 * std::tan(Rad(30))));
  EXPECT_TRUE(view.Shows({near_m + 0.1, 0, 10}));
  EXPECT_FALSE(view.Shows({near_m - 0.1, 0, 10})) << "below the picture";
}

}  // namespace
}  // namespace palace
