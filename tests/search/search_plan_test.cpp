// The search: what was looked at, and which look comes next.
#include "engine/search/search_plan.h"

#include <cmath>
#include <iostream>
#include <random>

#include <gtest/gtest.h>

#include "engine/camera/pinhole.h"
#include "engine/core/units.h"
#include "engine/search/ground_looks.h"

namespace palace {
namespace {

StereoRig Rig() {
  StereoRig rig;
  rig.left.pinhole = rig.right.pinhole = PinholeFromFov(640, 480, Rad(60));
  rig.tilt_rad = -Rad(45);
  return rig;
}

bool Always(const FlyTo&) { return true; }

struct Search {
  explicit Search(const FlyTo& from) : here(from), seen(NothingSeen(from.p_WB.head<2>())) {}
  SearchGround Ground() const { return {seen, view, area ? &*area : nullptr}; }
  void Look() {
    for (int map = 0; map < SeenGround::kMapsOfALook; ++map) {
      AddLook(seen, view, here);
    }
  }
  std::optional<SearchLook> Next(const std::function<bool(const FlyTo&)>& may_fly = Always) const {
    return NextLook(Ground(), here, may_fly);
  }
  FlyTo here;
  GroundView view{Rig()};
  SeenGround seen;
  std::optional<FlyArea> area;
};

TEST(SeenGround, IsLookedAtAfterSoManyMapsWithItInView) {
  Search search({{0, 0, -15}, 0});
  const auto ahead = search.seen.squares.CellFromPoint(15, 1);
  for (int map = 0; map < SeenGround::kMapsOfALook; ++map) {
    EXPECT_FALSE(search.seen.IsLookedAt(*ahead));
    AddLook(search.seen, search.view, search.here);
  }
  EXPECT_TRUE(search.seen.IsLookedAt(*ahead));
  EXPECT_FALSE(search.seen.IsLookedAt(*search.seen.squares.CellFromPoint(-15, 1))) << "behind";
}

TEST(SeenGround, AStripIsLookedAtWhereEverySquareUnderItIs) {
  Search search({{0, 0, -15}, 0});
  search.Look();
  EXPECT_TRUE(IsLookedAt(search.seen, {12, 0}, {18, 0}, 1.5));
  EXPECT_TRUE(IsLookedAt(search.seen, {15, -2}, {15, 2}, 1.5)) << "across";
  EXPECT_FALSE(IsLookedAt(search.seen, {15, 0}, {0, 0}, 1.5)) << "under the vehicle";
  EXPECT_FALSE(IsLookedAt(search.seen, {15, 0}, {15, -20}, 1.5)) << "beside the view";
  EXPECT_FALSE(IsLookedAt(search.seen, {12, 0}, {18, 0}, 20)) << "too wide";
  EXPECT_FALSE(IsLookedAt(search.seen, {15, 0}, {500, 0}, 1.5)) << "beyond the squares";
}

TEST(SeenGround, TheSquaresOfAHeadingAreThoseOfTheView) {
  const GroundView view(Rig());
  for (const double heading_rad : {0.0, 0.7, 2.5, -1.9}) {
    int shown = 0;
    for (const Cell& step : SquaresInView(view, heading_rad, 15)) {
      const double north_m = -2.0 * step.row, east_m = 2.0 * step.col;
      const double along = north_m * std::cos(heading_rad) + east_m * std::sin(heading_rad);
      EXPECT_GT(along, 0) << heading_rad;
      ++shown;
    }
    EXPECT_NEAR(shown, 107, 6) << "as many squares whichever way it looks";
  }
}

TEST(SearchPlan, ATurnComesBeforeAWayAndALookIsNotProposedTwice) {
  Search search({{0, 0, -15}, Rad(30)});
  search.Look();
  const double before_m2 = LeftToSee_m2(search.Ground());
  const auto look = search.Next();
  ASSERT_TRUE(look.has_value());
  EXPECT_EQ(look->to.p_WB, search.here.p_WB) << "a turn takes the least time";
  EXPECT_GT(look->new_m2, 100);
  search.here = look->to;
  search.Look();
  EXPECT_NEAR(before_m2 - LeftToSee_m2(search.Ground()), look->new_m2, 1e-6)
      << "it showed what it promised";
  const auto next = search.Next();
  ASSERT_TRUE(next.has_value());
  EXPECT_FALSE(next->to.p_WB == look->to.p_WB && next->to.heading_rad == look->to.heading_rad);
}

// A hover's heading wavers, and with it which of two equal turns shows a little more.
TEST(SearchPlan, WhatWasProposedStaysUntilAnotherIsClearlyBetter) {
  Search search({{0, 0, -15}, 0});
  search.Look();
  const auto first = search.Next();
  ASSERT_TRUE(first.has_value());
  int left = 0, right = 0, changed = 0;
  FlyTo before = first->to;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> waver(-Rad(4), Rad(4));
  for (int plan = 0; plan < 40; ++plan) {
    search.here.heading_rad = waver(random);
    const auto fresh = search.Next();
    const auto kept = NextLook(search.Ground(), search.here, Always, &before);
    ASSERT_TRUE(fresh && kept);
    (WrapAngle(fresh->to.heading_rad - search.here.heading_rad) > 0 ? right : left) += 1;
    changed += std::abs(WrapAngle(kept->to.heading_rad - before.heading_rad)) > Rad(20);
    before = kept->to;
  }
  EXPECT_GT(left, 0) << "without it the proposal flips";
  EXPECT_GT(right, 0);
  EXPECT_EQ(changed, 0);
  // Once that ground was looked at, it is not kept.
  search.here.heading_rad = before.heading_rad;
  search.Look();
  const auto next = NextLook(search.Ground(), search.here, Always, &before);
  ASSERT_TRUE(next.has_value());
  EXPECT_GT(std::abs(WrapAngle(next->to.heading_rad - before.heading_rad)), Rad(20));
}

TEST(SearchPlan, EndsOnlyWhenTheAreaWasLookedAt) {
  std::mt19937_64 random(20261128);
  std::cout << "seed 20261128\n";
  std::uniform_real_distribution<double> turn(-3, 3), size(15, 40);
  for (int trial = 0; trial < 10; ++trial) {
    Search search({{1, -2, -15}, turn(random)});
    const double half_m = size(random);
    search.area =
        FlyArea{{{-half_m, -half_m}, {half_m, -half_m}, {half_m, half_m}, {-half_m, half_m}}, 50};
    const auto inside = [&](const FlyTo& to) {
      return LeavesBy_m(*search.area, search.here.p_WB.head<2>(), to.p_WB.head<2>()) == 0;
    };
    search.Look();
    int looks = 0;
    while (const auto look = search.Next(inside)) {
      ASSERT_TRUE(IsInside(*search.area, look->to.p_WB.head<2>()));
      ASSERT_GE(look->new_m2, kLeastNew_m2);
      search.here = look->to;
      search.Look();
      ASSERT_LT(++looks, 100);
    }
    const double left = LeftToSee_m2(search.Ground()) / AreaOf_m2(*search.area);
    EXPECT_LT(left, 0.1) << "half " << half_m << " m, " << looks << " looks";
  }
}

TEST(SearchPlan, WaysThatMayNotBeFlownAreLeftOut) {
  Search search({{0, 0, -15}, 0});
  search.Look();
  const auto turns_only = [&](const FlyTo& to) { return to.p_WB == search.here.p_WB; };
  int looks = 0;
  while (const auto look = search.Next(turns_only)) {
    EXPECT_EQ(look->to.p_WB, search.here.p_WB);
    search.here = look->to;
    search.Look();
    ASSERT_LT(++looks, 9) << "a full turn shows all that turns can show";
  }
  EXPECT_GT(looks, 3);
  EXPECT_TRUE(search.Next().has_value()) << "farther on there is more";
}

}  // namespace
}  // namespace palace
