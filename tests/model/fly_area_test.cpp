// The area that the vehicle is kept to: its shape, its inside, ways that leave it.
#include "engine/model/mission/fly_area.h"

#include <cmath>

#include <gtest/gtest.h>

namespace palace {
namespace {

FlyArea Square(double half_m) {
  return {{{-half_m, -half_m}, {half_m, -half_m}, {half_m, half_m}, {-half_m, half_m}}, 30};
}
/// An L: the quarter to the north-east is cut out.
FlyArea Bent() { return {{{-10, -10}, {10, -10}, {10, 0}, {0, 0}, {0, 10}, {-10, 10}}, 30}; }

TEST(FlyArea, WhatIsNoneIsToldWhy) {
  EXPECT_EQ(WhyNoArea(Square(10)), "");
  EXPECT_EQ(WhyNoArea(Bent()), "");
  struct Row {
    FlyArea area;
    const char* why;
  };
  FlyArea many = Square(10);
  many.corners_W.resize(33, {0, 0});
  FlyArea high = Square(10);
  high.ceiling_m = NAN;
  for (const Row& row : {Row{{{{0, 0}, {10, 0}}, 30}, "An area has 3 to 32 corners, not 2"},
                         Row{many, "An area has 3 to 32 corners, not 33"},
                         Row{{{{0, 0}, {20, 20}, {20, 0}, {0, 20}}, 30}, "Its edges cross"},
                         Row{{{{0, 0}, {20, 0}, {20, 0}, {0, 20}}, 30}, "Its edges cross"},
                         Row{Square(2), "It is 16 m² large, min 25 m²"},
                         Row{{{{0, 0}, {20, 0}, {NAN, 20}}, 30},
                             "A corner lies more than 1000 m from where the flight began, or "
                             "nowhere"},
                         Row{high, "The ceiling is nan m, limit 1000 m"}}) {
    EXPECT_EQ(WhyNoArea(row.area), row.why);
  }
}

TEST(FlyArea, SizeInsideAndEdge) {
  EXPECT_DOUBLE_EQ(AreaOf_m2(Square(10)), 400);
  EXPECT_DOUBLE_EQ(AreaOf_m2(Bent()), 300);
  EXPECT_TRUE(IsInside(Bent(), {-5, 5}));
  EXPECT_TRUE(IsInside(Bent(), {0, 5})) << "on the edge";
  EXPECT_TRUE(IsInside(Bent(), {10, -10})) << "a corner";
  EXPECT_FALSE(IsInside(Bent(), {5, 5})) << "cut out";
  EXPECT_FALSE(IsInside(Bent(), {NAN, 5}));
  EXPECT_DOUBLE_EQ(ToEdge_m(Bent(), {5, 5}), 5);
  EXPECT_DOUBLE_EQ(ToEdge_m(Square(10), {14, 13}), 5);
}

TEST(FlyArea, AWayLeavesItByItsFarthestPointOutside) {
  EXPECT_EQ(LeavesBy_m(Square(10), {-5, 0}, {9, 9}), 0);
  EXPECT_DOUBLE_EQ(LeavesBy_m(Square(10), {0, 0}, {13, 0}), 3);
  EXPECT_EQ(LeavesBy_m(Square(10), {15, 0}, {5, 0}), 0) << "a way in";
  EXPECT_DOUBLE_EQ(LeavesBy_m(Square(10), {15, 0}, {17, 0}), 7) << "it ends outside";
  EXPECT_NEAR(LeavesBy_m(Bent(), {8, -2}, {-2, 8}), 3, 0.1) << "over the cut: (3, 3)";
}

}  // namespace
}  // namespace palace
