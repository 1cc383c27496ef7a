// Courses by wind, sun and the wanted heading: scores in closed form, what is unknown, vetoes. The
// whole curve against a slow reference: tests/experiments/heading_reference_test.cpp.
#include "engine/flight/approach_heading.h"

#include <cmath>
#include <functional>
#include <utility>

#include <gtest/gtest.h>

namespace palace {
namespace {

/// 0.08 and 0.92: the centroids of the outer output terms.
constexpr double kWorst = 0.25 / 3, kBest = 1 - 0.25 / 3;

const HeadingScore& At(const HeadingCurve& curve, int heading_deg) {
  return curve.headings.at(static_cast<std::size_t>(heading_deg / 5));
}

int BestDeg(const HeadingCurve& curve) { return curve.best ? *curve.best * 5 : -1; }

/// A low sun ahead of a strong wind, which is not wanted.
HeadingConditions AllKnown() {
  HeadingConditions conditions;
  conditions.wind_mps = 12;
  conditions.wind_from_rad = Rad(270);
  conditions.sun_azimuth_rad = Rad(270);
  conditions.sun_elevation_rad = Rad(12);
  conditions.wanted_rad = Rad(90);
  return conditions;
}

TEST(ApproachHeading, ScoresInClosedForm) {
  HeadingConditions conditions;
  conditions.wind_from_rad = 0;
  struct Row {
    const char* name;
    double wind_mps;
    int heading_deg;
    double wind;
  };
  for (const Row& row : {
           Row{"calm, any course", 1, 180, kBest},
           Row{"moderate, head", 5, 20, kBest},
           Row{"moderate, cross", 5, 90, 0.5},
           Row{"moderate, tail", 5, 130, 0.25},
           Row{"strong, head", 12, 0, kBest},
           Row{"strong, cross", 12, 270, 0.25},
           Row{"strong, tail", 12, 180, kWorst},
       }) {
    conditions.wind_mps = row.wind_mps;
    EXPECT_NEAR(At(ScoreHeadings(conditions), row.heading_deg).wind, row.wind, 1e-9) << row.name;
  }
  conditions = {};
  conditions.wanted_rad = Rad(90);
  const HeadingCurve turned = ScoreHeadings(conditions);
  EXPECT_NEAR(At(turned, 100).orientation, kBest, 1e-9);
  EXPECT_NEAR(At(turned, 30).orientation, 0.5, 1e-9);
  EXPECT_NEAR(At(turned, 270).orientation, 0.25, 1e-9);
  // Sun in the south at 45, seen along 45 down: its glint on a course to the south, the own shadow
  // on one to the north, 100 degrees and more from it beside that.
  conditions = {};
  conditions.sun_azimuth_rad = Rad(180);
  conditions.sun_elevation_rad = Rad(45);
  const HeadingCurve sunny = ScoreHeadings(conditions);
  EXPECT_NEAR(At(sunny, 180).sun, 0.25, 1e-9);
  EXPECT_NEAR(At(sunny, 0).sun, 0.5, 1e-9);
  EXPECT_GT(At(sunny, 90).sun, 0.75);
  conditions.sun_elevation_rad = Rad(-7);
  EXPECT_NEAR(At(ScoreHeadings(conditions), 180).sun, kBest, 1e-9) << "night";
  conditions.sun_elevation_rad = Rad(5);
  conditions.depression_rad = Rad(10);
  EXPECT_NEAR(At(ScoreHeadings(conditions), 180).sun, kWorst, 1e-9) << "into the sun";
}

TEST(ApproachHeading, CombinesByTheExponentsOfTheWind) {
  for (const auto& [wind_mps, a] : {std::pair{2.9, 0.5}, {3.0, 1.5}, {8.0, 1.5}, {8.1, 3.0}}) {
    HeadingConditions conditions = AllKnown();
    conditions.wind_mps = wind_mps;
    for (const HeadingScore& score : ScoreHeadings(conditions).headings) {
      const double logarithm =
          (a * std::log(score.wind) + std::log(score.sun) + 0.7 * std::log(score.orientation)) /
          (a + 1.7);
      ASSERT_NEAR(std::log(score.combined), logarithm, 1e-12) << wind_mps;
    }
  }
}

TEST(ApproachHeading, UnknownIsLeftOut) {
  const HeadingConditions known = AllKnown();
  struct Row {
    const char* name;
    std::function<void(HeadingConditions&)> forget;
    bool wind, sun, orientation;  // left out
  };
  using C = HeadingConditions;
  for (const Row& row : {
           Row{"speed", [](C& c) { c.wind_mps = NAN; }, true, false, false},
           Row{"negative speed", [](C& c) { c.wind_mps = -1; }, true, false, false},
           Row{"infinite speed", [](C& c) { c.wind_mps = INFINITY; }, true, false, false},
           Row{"bearing", [](C& c) { c.wind_from_rad = NAN; }, true, false, false},
           Row{"azimuth", [](C& c) { c.sun_azimuth_rad = NAN; }, false, true, false},
           Row{"elevation", [](C& c) { c.sun_elevation_rad = NAN; }, false, true, false},
           Row{"depression", [](C& c) { c.depression_rad = NAN; }, false, true, false},
           Row{"wanted", [](C& c) { c.wanted_rad = NAN; }, false, false, true},
           Row{"all", [](C& c) { c = {}; }, true, true, true},
       }) {
    SCOPED_TRACE(row.name);
    HeadingConditions conditions = known;
    row.forget(conditions);
    const HeadingCurve curve = ScoreHeadings(conditions), full = ScoreHeadings(known);
    EXPECT_TRUE(curve.best);
    for (std::size_t k = 0; k < curve.headings.size(); ++k) {
      const HeadingScore &score = curve.headings[k], &all = full.headings[k];
      ASSERT_EQ(score.wind, row.wind ? 1 : all.wind);
      ASSERT_EQ(score.sun, row.sun ? 1 : all.sun);
      ASSERT_EQ(score.orientation, row.orientation ? 1 : all.orientation);
      ASSERT_EQ(std::isnan(score.tailwind_mps), row.wind);
      ASSERT_EQ(score.IsVetoed(), !row.wind && all.is_downwind);
      const double a = row.wind ? 0 : 3, b = row.sun ? 0 : 1, c = row.orientation ? 0 : 0.7;
      const double product =
          std::pow(score.wind, a) * std::pow(score.sun, b) * std::pow(score.orientation, c);
      ASSERT_NEAR(score.combined, a + b + c > 0 ? std::pow(product, 1 / (a + b + c)) : 1, 1e-12);
    }
  }
  EXPECT_EQ(ScoreHeadings({}).best, 0) << "of 72 equals the first";
}

TEST(ApproachHeading, VetoesAreNamed) {
  HeadingConditions conditions;
  conditions.wind_from_rad = 0;
  conditions.wind_mps = 5;
  conditions.max_tailwind_mps = 2.6;  // 5 m/s from 121.3 degrees and more beside the course
  conditions.blocked.set(0);
  conditions.blocked.set(36);
  const HeadingCurve curve = ScoreHeadings(conditions);
  EXPECT_TRUE(At(curve, 0).is_blocked && !At(curve, 0).is_downwind && At(curve, 0).IsVetoed());
  EXPECT_TRUE(At(curve, 180).is_blocked && At(curve, 180).is_downwind);
  EXPECT_TRUE(!At(curve, 125).is_blocked && At(curve, 125).is_downwind);
  EXPECT_FALSE(At(curve, 120).IsVetoed());
  EXPECT_NEAR(At(curve, 120).tailwind_mps, 2.5, 1e-9);
  EXPECT_NEAR(At(curve, 0).tailwind_mps, -5, 1e-9);
  EXPECT_EQ(BestDeg(curve), 5) << "of 340 to 020 without 000, none wanted: the first";

  conditions.blocked.set();
  EXPECT_FALSE(ScoreHeadings(conditions).best);
  conditions.blocked.reset();
  conditions.max_tailwind_mps = -6;
  EXPECT_FALSE(ScoreHeadings(conditions).best) << "no course has that much headwind";
  conditions.max_tailwind_mps = NAN;
  EXPECT_FALSE(ScoreHeadings(conditions).best);
  conditions.max_tailwind_mps = INFINITY;
  EXPECT_TRUE(ScoreHeadings(conditions).best);
}

TEST(ApproachHeading, TheRulesLeaveNoGap) {
  HeadingConditions conditions;
  conditions.wind_from_rad = 0.01;
  conditions.sun_azimuth_rad = 0.02;
  conditions.wanted_rad = 0.03;
  for (double elevation_deg = -90; elevation_deg <= 90; elevation_deg += 2) {
    for (double depression_deg = 5; depression_deg <= 90; depression_deg += 17) {
      conditions.sun_elevation_rad = Rad(elevation_deg);
      conditions.depression_rad = Rad(depression_deg);
      conditions.wind_mps = (elevation_deg + 90) / 8;
      for (const HeadingScore& score : ScoreHeadings(conditions).headings) {
        for (const double one : {score.wind, score.sun, score.orientation, score.combined}) {
          ASSERT_TRUE(one >= kWorst - 1e-9 && one <= kBest + 1e-9)
              << elevation_deg << ", " << depression_deg << ", " << Deg(score.heading_rad);
        }
      }
    }
  }
}

}  // namespace
}  // namespace palace
