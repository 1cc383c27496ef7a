// The curve of approach courses against a slow reference, over drawn conditions of which some are
// unknown, and against the seven cases of simulation.md 3.3.
#include "engine/experiments/heading_reference.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "engine/core/frames.h"
#include "engine/core/random.h"
#include "engine/experiments/heading_case.h"
#include "engine/flight/approach_heading.h"

namespace palace {
namespace {

const HeadingScore& At(const HeadingCurve& curve, int heading_deg) {
  return curve.headings.at(static_cast<std::size_t>(heading_deg / 5));
}

double OffDeg(double a_deg, double b_deg) { return std::abs(std::remainder(a_deg - b_deg, 360)); }

/// Of a case of the list, without a present heading: a turn costs nothing.
HeadingConditions Unturned(const HeadingCase& listed) {
  HeadingConditions conditions = listed.conditions;
  conditions.present_rad = NAN;
  return conditions;
}

TEST(HeadingReference, InClosedForm) {
  constexpr double kWorst = 0.25 / 3, kBest = 1 - 0.25 / 3;
  HeadingConditions now;
  now.wind_from_rad = 0;
  const struct {
    double wind_mps, heading_deg, wind;
  } table[] = {{1, 180, kBest}, {5, 90, 0.5}, {5, 180, 0.25}, {12, 0, kBest}, {12, 180, kWorst}};
  for (const auto& row : table) {
    now.wind_mps = row.wind_mps;
    EXPECT_NEAR(ScoreByReference(now, Rad(row.heading_deg)).wind, row.wind, kReferenceTolerance);
  }
  EXPECT_EQ(ScoreByReference({}, 1).combined, 1) << "nothing is known";
}

// It does not say what a turn is counted from: from a present heading of 000 all seven come out to
// the degree, each at the edge of a plateau.
TEST(HeadingReference, TheSevenListedCasesComeOut) {
  const std::vector<HeadingCase> listed = ListedHeadingCases();
  ASSERT_EQ(listed.size(), 7u);
  for (const HeadingCase& one : listed) {
    EXPECT_TRUE(one.agrees) << one.name << ", " << Deg(one.heading_rad);
  }
}

// Without a present heading the listed result is one of the equals, and the choice among them is
// the one that turns least from the wanted heading.
TEST(HeadingReference, ListedResultsAreAmongTheEquals) {
  const std::vector<std::vector<int>> equals_deg = {
      {260, 265, 270, 275, 280},
      {250, 255, 260, 265, 270, 275, 280, 285, 290},
      {55, 60, 65, 70, 75, 80, 85, 185, 190, 195, 200, 205, 210, 215},
      {280},
      {160, 165, 170, 175, 180, 185, 190, 195, 200},
      {110, 115, 120, 125, 130},
      {40, 45, 50, 55, 60}};
  const std::vector<HeadingCase> listed = ListedHeadingCases();
  ASSERT_EQ(listed.size(), equals_deg.size());
  for (std::size_t i = 0; i < listed.size(); ++i) {
    SCOPED_TRACE(listed[i].name);
    const HeadingConditions conditions = Unturned(listed[i]);
    const HeadingCurve curve = ScoreHeadings(conditions);
    double most = 0;
    for (const HeadingScore& score : curve.headings) {
      most = std::max(most, score.combined);
    }
    std::vector<int> equals;
    for (int deg = 0; deg < 360; deg += 5) {
      if (At(curve, deg).combined >= most - kEqualScores) {
        equals.push_back(deg);
      }
    }
    EXPECT_EQ(equals, equals_deg[i]);
    const auto turn_deg = [&](int deg) { return OffDeg(deg, Deg(conditions.wanted_rad)); };
    const int nearest_deg = *std::min_element(equals.begin(), equals.end(), [&](int a, int b) {
      return turn_deg(a) < turn_deg(b) - 1e-6;
    });
    EXPECT_EQ(curve.best.value() * 5, nearest_deg);
  }
}

// The world turned turns the curve with it, and the choice: a plateau stays one, however it rounds.
TEST(HeadingReference, ListedCasesTurnWithTheWorld) {
  for (const HeadingCase& listed : ListedHeadingCases()) {
    const HeadingConditions conditions = Unturned(listed);
    const HeadingCurve before = ScoreHeadings(conditions);
    for (int turn_deg = 5; turn_deg < 360; turn_deg += 5) {
      SCOPED_TRACE(testing::Message() << listed.name << ", turned by " << turn_deg);
      HeadingConditions turned = conditions;
      for (double* rad : {&turned.sun_azimuth_rad, &turned.wind_from_rad, &turned.wanted_rad}) {
        *rad += Rad(turn_deg);
      }
      const HeadingCurve after = ScoreHeadings(turned);
      for (int deg = 0; deg < 360; deg += 5) {
        ASSERT_NEAR(At(after, (deg + turn_deg) % 360).combined, At(before, deg).combined, 1e-9);
      }
      // Of two mirrored ones the first from north is chosen: the turn is the same, not its side.
      ASSERT_NEAR(OffDeg(5.0 * after.best.value(), Deg(turned.wanted_rad)),
                  OffDeg(5.0 * before.best.value(), Deg(conditions.wanted_rad)), 1e-9);
    }
  }
}

/// Every fifth angle is unknown.
HeadingConditions Draw(RandomStream& random) {
  const auto angle_rad = [&random] {
    const double rad = Rad(random.Uniform(-180, 360));
    return random.Index(5) == 0 ? NAN : rad;
  };
  HeadingConditions now;
  now.wind_mps = random.Uniform(0, 15);
  now.wind_from_rad = angle_rad();
  now.sun_azimuth_rad = angle_rad();
  now.wanted_rad = angle_rad();
  now.present_rad = angle_rad();
  now.sun_elevation_rad = Rad(random.Uniform(-20, 90));
  now.depression_rad = Rad(random.Uniform(10, 80));
  now.max_tailwind_mps = random.Uniform(-2, 6);
  const double blocked_share = random.Uniform(0, 1.1);
  for (std::size_t k = 0; k < kApproachHeadings; ++k) {
    now.blocked.set(k, random.Uniform() < blocked_share);
  }
  return now;
}

/// The best by the words of the header, of the curve's own scores: its plateaus are level, those
/// of slices nearly.
void ExpectBest(const HeadingCurve& curve, const HeadingConditions& now) {
  const auto off = [](int k, double rad) {
    return std::isnan(rad) ? 0 : OffDeg(5.0 * k, Deg(rad));
  };
  const auto worth = [&](int k) {
    return At(curve, 5 * k).combined * (1 - 0.02 * off(k, now.present_rad) / 180);
  };
  const auto turn = [&](int k) { return off(k, now.wanted_rad); };
  const int best = curve.best.value();
  for (int k = 0; k < kApproachHeadings; ++k) {
    if (At(curve, 5 * k).IsVetoed()) {
      continue;
    }
    ASSERT_GE(worth(best), worth(k) - 1e-9) << 5 * k;
    if (worth(k) >= worth(best) - 1e-12) {
      ASSERT_LT(turn(best), turn(k) + 1e-6) << 5 * k;
      ASSERT_TRUE(k >= best || turn(best) < turn(k) - 1e-9) << 5 * k;
    }
  }
}

TEST(HeadingReference, TheCurveIsItsAndNoVetoIsOverruled) {
  constexpr std::uint64_t kSeed = 72;
  RandomStream random(kSeed);
  int chosen = 0, refused = 0;
  for (int trial = 0; trial < 120; ++trial) {
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", trial " << trial);
    const HeadingConditions now = Draw(random);
    const HeadingCurve curve = ScoreHeadings(now);
    bool any_allowed = false;
    for (int k = 0; k < kApproachHeadings; ++k) {
      const HeadingScore& score = At(curve, 5 * k);
      const ReferenceScore slow = ScoreByReference(now, Rad(5 * k));
      const double tailwind_mps = -now.wind_mps * std::cos(Rad(5 * k) - now.wind_from_rad);
      const bool is_blocked = now.blocked.test(static_cast<std::size_t>(k));
      const bool is_downwind = tailwind_mps > now.max_tailwind_mps;
      any_allowed = any_allowed || (!is_blocked && !is_downwind);
      ASSERT_NEAR(Deg(score.heading_rad), 5 * k, 1e-9);
      ASSERT_NEAR(score.wind, slow.wind, kReferenceTolerance) << 5 * k;
      ASSERT_NEAR(score.sun, slow.sun, kReferenceTolerance) << 5 * k;
      ASSERT_NEAR(score.orientation, slow.orientation, kReferenceTolerance) << 5 * k;
      ASSERT_NEAR(score.combined, slow.combined, kReferenceTolerance) << 5 * k;
      ASSERT_EQ(score.is_blocked, is_blocked) << 5 * k;
      ASSERT_EQ(score.is_downwind, is_downwind) << 5 * k;
      ASSERT_FALSE(curve.best == k && (is_blocked || is_downwind));
    }
    ASSERT_EQ(curve.best.has_value(), any_allowed);
    if (any_allowed) {
      ++chosen;
      ASSERT_NO_FATAL_FAILURE(ExpectBest(curve, now));
    } else {
      ++refused;
    }
  }
  EXPECT_GT(chosen, 70) << "seed " << kSeed;
  EXPECT_GT(refused, 5) << "seed " << kSeed;
}

}  // namespace
}  // namespace palace
