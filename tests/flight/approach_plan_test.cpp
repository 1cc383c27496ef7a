// Which course an approach is flown on: a table of what is clear.
#include "engine/flight/approach_plan.h"

#include <bit>
#include <cmath>

#include <gtest/gtest.h>

#include "engine/core/frames.h"
#include "engine/core/random.h"
#include "engine/core/units.h"
#include "engine/flight/approach_heading.h"

namespace palace {
namespace {

enum Sector : unsigned { kN = 1, kNE = 2, kE = 4, kSE = 8, kS = 16, kSW = 32, kW = 64, kNW = 128 };

/// Without wind and sun.
ApproachCourse Choose(const LandingSite& site, double straight_rad,
                      HeadingConditions conditions = {}) {
  conditions.wanted_rad = straight_rad;
  conditions.blocked = BlockedHeadings(site, straight_rad);
  return ChooseCourse(site, straight_rad, ScoreHeadings(conditions));
}

struct Row {
  const char* name;
  bool straight_clear;
  unsigned clear;
  double straight_deg;
  double heading_deg;
  bool turned;
};

TEST(ChooseCourse, StraightWhereClearElseTheLeastTurn) {
  for (const Row& row : {
           Row{"straight is clear", true, 0, 31, 31, false},
           Row{"straight is clear, others too", true, 0xFF, 31, 31, false},
           Row{"nothing is clear", false, 0, 31, 31, false},
           Row{"from the south only", false, kS, 31, 0, true},
           Row{"from the north only, all the way round", false, kN, 0, 180, true},
           Row{"of two the nearer", false, kW | kNE, 31, 90, true},
           Row{"over the south", false, kE | kNE, 175, -135, true},
           Row{"the sector it is in", false, kS | kSW | kSE, 10, 0, true},
       }) {
    SCOPED_TRACE(row.name);
    LandingSite site;
    site.corridor_clear = row.straight_clear;
    site.clear_approaches = static_cast<std::uint8_t>(row.clear);
    const ApproachCourse course = Choose(site, Rad(row.straight_deg));
    EXPECT_NEAR(WrapAngle(course.heading_rad - Rad(row.heading_deg)), 0, 1e-9)
        << Deg(course.heading_rad);
    EXPECT_EQ(course.side != kStraightApproach, row.turned);
  }
}

// A vehicle that does not know where it is has no straight course.
TEST(ChooseCourse, OfAnUnknownStraightCourseAClearSectorIsTaken) {
  for (const double unknown_rad : {double{NAN}, double{INFINITY}, -double{INFINITY}}) {
    EXPECT_FALSE(NearestHeading(unknown_rad));
    EXPECT_TRUE(ScoreHeadings({}).At(unknown_rad).IsVetoed());
    LandingSite site;
    site.corridor_clear = true;
    site.clear_approaches = kE;
    EXPECT_EQ(BlockedHeadings(site, unknown_rad), BlockedHeadings(site, Rad(-90)));
    HeadingConditions from_behind;
    from_behind.wind_mps = 12;
    from_behind.wind_from_rad = Rad(90);
    for (const HeadingConditions& conditions : {HeadingConditions(), from_behind}) {
      EXPECT_NEAR(Choose(site, unknown_rad, conditions).heading_rad, Rad(-90), 1e-9);
    }
    site.clear_approaches = 0;
    EXPECT_TRUE(BlockedHeadings(site, unknown_rad).all());
  }
  EXPECT_EQ(NearestHeading(Rad(-2.4)), 0u);
  EXPECT_EQ(NearestHeading(Rad(-2.6)), 71u);
  EXPECT_EQ(NearestHeading(Rad(725.1)), 1u);
}

// Never from a blocked sector, never farther round than another that is clear.
TEST(ChooseCourse, NoBlockedSectorIsEverFlown) {
  constexpr std::uint64_t kSeed = 41;
  RandomStream random(kSeed);
  for (int trial = 0; trial < 2000; ++trial) {
    LandingSite site;
    site.corridor_clear = false;
    site.clear_approaches = static_cast<std::uint8_t>(random.Uniform(0, 256));
    const double straight_rad = random.Uniform(-3.14, 3.14);
    const ApproachCourse course = Choose(site, straight_rad);
    ASSERT_EQ(course.side != kStraightApproach, site.clear_approaches != 0)
        << "seed " << kSeed << ", " << trial;
    if (course.side == kStraightApproach) {
      continue;
    }
    const double from = WrapAngle(course.heading_rad + Rad(180)) / Rad(45);
    const unsigned sector = static_cast<unsigned>(std::lround(from) + 8) % 8;
    ASSERT_NEAR(from, std::lround(from), 1e-9);
    ASSERT_EQ(course.side, static_cast<int>(sector));
    ASSERT_NE(site.clear_approaches >> sector & 1U, 0u) << "seed " << kSeed << ", " << trial;
    if (std::popcount(site.clear_approaches) == 8) {
      ASSERT_LE(std::abs(WrapAngle(course.heading_rad - straight_rad)), Rad(22.5) + 1e-9);
    }
  }
}

TEST(ChooseCourse, TurnsIntoTheWindWhereItIsWorthIt) {
  struct Windy {
    const char* name;
    double wind_mps, from_deg, heading_deg;
    bool turned;
  };
  LandingSite open;
  open.corridor_clear = true;
  open.clear_approaches = 0xFF;
  for (const Windy& row : {Windy{"calm", 0.5, 180, 0, false}, Windy{"from ahead", 8, 0, 0, false},
                           Windy{"a light breeze from the side", 2, 90, 0, false},
                           Windy{"strong from behind", 9, 180, 180, true},
                           Windy{"strong from the right", 9, 90, 90, true}}) {
    SCOPED_TRACE(row.name);
    HeadingConditions wind;
    wind.wind_mps = row.wind_mps;
    wind.wind_from_rad = Rad(row.from_deg);
    const ApproachCourse course = Choose(open, 0, wind);
    EXPECT_EQ(course.side != kStraightApproach, row.turned) << Deg(course.heading_rad);
    // The same score holds some 20 degrees to either side of the wind's eye.
    EXPECT_LE(std::abs(Deg(WrapAngle(course.heading_rad - Rad(row.heading_deg)))), 45 + 1e-6);
  }
}

// In 500 drawn cases of wind and obstacles: never a blocked side, and never more tailwind than the
// limit where a clear side keeps it.
TEST(ChooseCourse, KeepsTheTailwindLimitWhereAClearSideDoes) {
  constexpr std::uint64_t kSeed = 500;
  RandomStream random(kSeed);
  for (int trial = 0; trial < 500; ++trial) {
    LandingSite site;
    site.corridor_clear = random.Uniform(0, 1) < 0.5;
    site.clear_approaches = static_cast<std::uint8_t>(random.Uniform(0, 256));
    HeadingConditions wind;
    wind.wind_mps = random.Uniform(0, 12);
    wind.wind_from_rad = random.Uniform(-3.14, 3.14);
    const double straight_rad = random.Uniform(-3.14, 3.14);
    const ApproachCourse course = Choose(site, straight_rad, wind);
    const auto tail = [&](double heading_rad) {
      return -wind.wind_mps * std::cos(heading_rad - wind.wind_from_rad);
    };
    if (course.side != kStraightApproach) {
      ASSERT_NE(site.clear_approaches >> course.side & 1U, 0u) << "seed " << kSeed << ", " << trial;
    }
    constexpr double kRounded_mps = 0.55;  // courses are scored by the nearest 5 degrees
    if (tail(course.heading_rad) > wind.max_tailwind_mps + kRounded_mps) {
      for (const ApproachCourse& other : ClearCourses(site, straight_rad, site.corridor_clear)) {
        ASSERT_GT(tail(other.heading_rad), wind.max_tailwind_mps - kRounded_mps)
            << "seed " << kSeed << ", " << trial;
      }
    }
  }
}

TEST(ClearCourses, GoRoundClockwiseAndHoldWhatIsClear) {
  LandingSite site;
  site.clear_approaches = kN | kE | kSW;
  const auto sides = [&](double straight_deg, bool straight_clear) {
    std::vector<int> found;
    for (const ApproachCourse& course : ClearCourses(site, Rad(straight_deg), straight_clear)) {
      found.push_back(course.side);
    }
    return found;
  };
  constexpr int kStraight = kStraightApproach;
  EXPECT_EQ(sides(31, false), (std::vector<int>{0, 2, 5}));
  EXPECT_EQ(sides(31, true), (std::vector<int>{0, 2, kStraight})) << "from 211, the south-west's";
  EXPECT_EQ(sides(22, true), (std::vector<int>{0, 2, kStraight, 5})) << "from 202, the south's";
  EXPECT_EQ(sides(-60, true), (std::vector<int>{0, 2, kStraight, 5})) << "from 120";
  EXPECT_EQ(sides(90, true), (std::vector<int>{0, 2, 5, kStraight})) << "from 270";
  EXPECT_EQ(sides(180, true), (std::vector<int>{kStraight, 2, 5})) << "the north once";
  EXPECT_EQ(sides(-180, true), (std::vector<int>{kStraight, 2, 5}));
  site.clear_approaches = 0;
  EXPECT_EQ(sides(10, true), std::vector<int>{kStraight});
  EXPECT_TRUE(sides(10, false).empty());
}

}  // namespace
}  // namespace palace
