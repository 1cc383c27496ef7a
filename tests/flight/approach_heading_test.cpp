// Courses by wind, sun and the wanted heading: the listed results, and that no veto is overruled.
#include "engine/flight/approach_heading.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "engine/core/frames.h"
#include "engine/core/random.h"

namespace palace {
namespace {

/// 0.08 and 0.92: the centroids of the outer output terms.
constexpr double kWorst = 0.25 / 3, kBest = 1 - 0.25 / 3;

const HeadingScore& At(const HeadingCurve& curve, int heading_deg) {
  return curve.headings.at(static_cast<std::size_t>(heading_deg / 5));
}

int BestDeg(const HeadingCurve& curve) { return curve.best ? *curve.best * 5 : -1; }

struct Listed {
  const char* name;
  double sun_azimuth_deg, sun_elevation_deg;
  double wind_from_deg, wind_mps;
  double wanted_deg;
  int heading_deg;
  std::vector<int> equals_deg;
};

// simulation.md 3.3. It does not say what a turn is counted from: from a present heading of 000 all
// seven come out to the degree, each at the edge of a plateau. It names no azimuth for the sun at
// noon; 180 is the northern half's.
const std::vector<Listed>& ListedCases() {
  static const std::vector<Listed> cases = {
      {"low sun, calm", 270, 12, 0, 0, 270, 280, {260, 265, 270, 275, 280}},
      {"low sun ahead of a strong wind",
       270,
       12,
       270,
       12,
       90,
       290,
       {250, 255, 260, 265, 270, 275, 280, 285, 290}},
      {"its glint",
       135,
       45,
       0,
       0,
       135,
       55,
       {55, 60, 65, 70, 75, 80, 85, 185, 190, 195, 200, 205, 210, 215}},
      {"sun behind, moderate wind", 135, 40, 300, 4, 300, 280, {280}},
      {"noon", 180, 75, 180, 5, 0, 160, {160, 165, 170, 175, 180, 185, 190, 195, 200}},
      {"night, calm", 0, -20, 0, 0, 120, 110, {110, 115, 120, 125, 130}},
      {"night, windy", 0, -20, 40, 10, 120, 40, {40, 45, 50, 55, 60}},
  };
  return cases;
}

HeadingConditions ConditionsOf(const Listed& listed) {
  HeadingConditions conditions;
  conditions.wind_mps = listed.wind_mps;
  conditions.wind_from_rad = Rad(listed.wind_from_deg);
  conditions.sun_azimuth_rad = Rad(listed.sun_azimuth_deg);
  conditions.sun_elevation_rad = Rad(listed.sun_elevation_deg);
  conditions.wanted_rad = Rad(listed.wanted_deg);
  return conditions;
}

TEST(ApproachHeading, ListedResultsFromAPresentHeadingOfNorth) {
  for (const Listed& listed : ListedCases()) {
    HeadingConditions conditions = ConditionsOf(listed);
    conditions.present_rad = 0;
    EXPECT_EQ(BestDeg(ScoreHeadings(conditions)), listed.heading_deg) << listed.name;
  }
}

// Without a present heading the listed result is one of the equals, and the choice among them is
// the one that turns least from the wanted heading.
TEST(ApproachHeading, ListedResultsAreAmongTheEquals) {
  for (const Listed& listed : ListedCases()) {
    SCOPED_TRACE(listed.name);
    const HeadingCurve curve = ScoreHeadings(ConditionsOf(listed));
    double most = 0;
    for (const HeadingScore& score : curve.headings) {
      most = std::max(most, score.combined);
    }
    std::vector<int> equals_deg;
    for (int deg = 0; deg < 360; deg += 5) {
      if (At(curve, deg).combined >= most - kEqualScores) {
        equals_deg.push_back(deg);
      }
    }
    EXPECT_EQ(equals_deg, listed.equals_deg);
    const auto turn_deg = [&](int deg) {
      return Deg(std::abs(WrapAngle(Rad(deg - listed.wanted_deg))));
    };
    const int nearest_deg =
        *std::min_element(equals_deg.begin(), equals_deg.end(),
                          [&](int a, int b) { return turn_deg(a) < turn_deg(b) - 1e-6; });
    EXPECT_EQ(BestDeg(curve), nearest_deg);
  }
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
    HeadingConditions conditions = ConditionsOf(ListedCases()[3]);
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
  const HeadingConditions known = ConditionsOf(ListedCases()[1]);
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

// --- a slow reference: degrees, terms as functions, centroids by slices ---------------------

double Fall(double x, double full, double none) {
  return std::clamp((none - x) / (none - full), 0.0, 1.0);
}
double Between(double x, double a, double b, double c, double d) {
  return std::min(1 - Fall(x, a, b), Fall(x, c, d));
}

/// `weights`: of very poor, poor, fair, good, very good.
double SlowCentroid(const std::array<double, 5>& weights) {
  constexpr int kSlices = 400;
  double area = 0, moment = 0;
  for (int s = 0; s < kSlices; ++s) {
    const double y = (s + 0.5) / kSlices;
    double f = 0;
    for (std::size_t k = 0; k < 5; ++k) {
      const double centre = 0.25 * static_cast<double>(k);
      f = std::max(f, weights[k] * std::max(0.0, 1 - std::abs(y - centre) / 0.25));
    }
    area += f;
    moment += f * y;
  }
  return moment / area;
}

double AngleDeg(double azimuth1, double elevation1, double azimuth2, double elevation2) {
  const double cosine =
      std::sin(Rad(elevation1)) * std::sin(Rad(elevation2)) +
      std::cos(Rad(elevation1)) * std::cos(Rad(elevation2)) * std::cos(Rad(azimuth1 - azimuth2));
  return Deg(std::acos(std::clamp(cosine, -1.0, 1.0)));
}

double SlowWind(double off, double v) {
  const double head = Fall(off, 20, 50), cross = Between(off, 20, 50, 100, 130);
  const double tail = 1 - Fall(off, 100, 130);
  const double calm = Fall(v, 1.5, 3.5), moderate = Between(v, 1.5, 3.5, 6, 9);
  const double strong = 1 - Fall(v, 6, 9);
  return SlowCentroid({std::min(strong, tail),
                       std::max(std::min(moderate, tail), std::min(strong, cross)),
                       std::min(moderate, cross), 0,
                       std::max({calm, std::min(moderate, head), std::min(strong, head)})});
}

double SlowSun(double heading, double depression, double azimuth, double elevation) {
  const double flare = AngleDeg(heading, -depression, azimuth, elevation);
  const double shadow = Fall(AngleDeg(heading, -depression, azimuth + 180, -elevation), 12, 28);
  const double glint = Fall(AngleDeg(heading, -depression, azimuth, -elevation), 12, 28);
  const double near = Fall(flare, 30, 55), mid = Between(flare, 30, 55, 75, 100);
  const double far = 1 - Fall(flare, 75, 100), night = Fall(elevation, -6, 2);
  const double clear = std::min({1 - night, 1 - shadow, 1 - glint});
  return SlowCentroid({std::min(1 - night, near), std::min(glint, 1 - near),
                       std::min(shadow, 1 - near), std::min(mid, clear),
                       std::max(night, std::min(far, clear))});
}

double SlowOrientation(double off) {
  return SlowCentroid(
      {0, 1 - Fall(off, 80, 110), Between(off, 10, 40, 80, 110), 0, Fall(off, 10, 40)});
}

double OffDeg(double a, double b) { return std::abs(std::remainder(a - b, 360)); }

/// Degrees; what is not there is unknown.
struct Drawn {
  double wind_mps;
  std::optional<double> wind_from, azimuth, wanted, present;
  double elevation, depression;

  double WindExponent() const {
    return !wind_from ? 0 : wind_mps < 3 ? 0.5 : wind_mps <= 8 ? 1.5 : 3;
  }
};

Drawn Draw(RandomStream& random) {
  const auto angle = [&] {
    const double deg = random.Uniform(-180, 360);
    return random.Index(5) == 0 ? std::nullopt : std::optional(deg);
  };
  Drawn drawn{};
  drawn.wind_mps = random.Uniform(0, 15);
  for (std::optional<double>* deg :
       {&drawn.wind_from, &drawn.azimuth, &drawn.wanted, &drawn.present}) {
    *deg = angle();
  }
  drawn.elevation = random.Uniform(-20, 90);
  drawn.depression = random.Uniform(10, 80);
  return drawn;
}

HeadingConditions ConditionsOf(const Drawn& drawn) {
  const auto rad = [](const std::optional<double>& deg) { return deg ? Rad(*deg) : NAN; };
  HeadingConditions conditions;
  conditions.wind_mps = drawn.wind_mps;
  conditions.wind_from_rad = rad(drawn.wind_from);
  conditions.sun_azimuth_rad = rad(drawn.azimuth);
  conditions.sun_elevation_rad = Rad(drawn.elevation);
  conditions.wanted_rad = rad(drawn.wanted);
  conditions.present_rad = rad(drawn.present);
  conditions.depression_rad = Rad(drawn.depression);
  return conditions;
}

HeadingScore SlowScore(const Drawn& drawn, double heading) {
  const double a = drawn.WindExponent(), b = drawn.azimuth ? 1 : 0, c = drawn.wanted ? 0.7 : 0;
  HeadingScore score;
  if (drawn.wind_from) {
    const double off = OffDeg(heading, *drawn.wind_from);
    score.wind = SlowWind(off, drawn.wind_mps);
    score.tailwind_mps = -drawn.wind_mps * std::cos(Rad(off));
  }
  score.sun =
      drawn.azimuth ? SlowSun(heading, drawn.depression, *drawn.azimuth, drawn.elevation) : 1;
  score.orientation = drawn.wanted ? SlowOrientation(OffDeg(heading, *drawn.wanted)) : 1;
  const double logarithm =
      a * std::log(score.wind) + b * std::log(score.sun) + c * std::log(score.orientation);
  score.combined = a + b + c > 0 ? std::exp(logarithm / (a + b + c)) : 1;
  return score;
}

/// The best by the words of the header, of the curve's own scores: its plateaus are level, those
/// of slices nearly.
void ExpectBest(const HeadingCurve& curve, const Drawn& drawn) {
  const auto worth = [&](int k) {
    const double turn = drawn.present ? OffDeg(5.0 * k, *drawn.present) / 180 : 0;
    return At(curve, 5 * k).combined * (1 - 0.02 * turn);
  };
  const auto turn = [&](int k) { return drawn.wanted ? OffDeg(5.0 * k, *drawn.wanted) : 0; };
  for (int k = 0; k < kApproachHeadings; ++k) {
    if (At(curve, 5 * k).IsVetoed()) {
      continue;
    }
    const int best = curve.best.value();
    ASSERT_GE(worth(best), worth(k) - 1e-9) << 5 * k;
    if (worth(k) >= worth(best) - 1e-12) {
      ASSERT_LT(turn(best), turn(k) + 1e-6) << 5 * k;
      ASSERT_TRUE(k >= best || turn(best) < turn(k) - 1e-9) << 5 * k;
    }
  }
}

TEST(ApproachHeading, NoVetoIsOverruledAndTheCurveIsThatOfASlowReference) {
  constexpr std::uint64_t kSeed = 72;
  RandomStream random(kSeed);
  int chosen = 0, refused = 0;
  for (int trial = 0; trial < 500; ++trial) {
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", trial " << trial);
    const Drawn drawn = Draw(random);
    HeadingConditions conditions = ConditionsOf(drawn);
    conditions.max_tailwind_mps = random.Uniform(-2, 6);
    const double blocked_share = random.Uniform(0, 1.1);
    for (std::size_t k = 0; k < kApproachHeadings; ++k) {
      conditions.blocked.set(k, random.Uniform() < blocked_share);
    }
    const HeadingCurve curve = ScoreHeadings(conditions);
    bool any_allowed = false;
    for (int k = 0; k < kApproachHeadings; ++k) {
      const HeadingScore& score = At(curve, 5 * k);
      const HeadingScore slow = SlowScore(drawn, 5 * k);
      const bool is_blocked = conditions.blocked.test(static_cast<std::size_t>(k));
      const bool is_downwind = slow.tailwind_mps > conditions.max_tailwind_mps;
      any_allowed = any_allowed || (!is_blocked && !is_downwind);
      ASSERT_NEAR(Deg(score.heading_rad), 5 * k, 1e-9);
      ASSERT_NEAR(score.wind, slow.wind, 1e-4) << 5 * k;
      ASSERT_NEAR(score.sun, slow.sun, 1e-4) << 5 * k;
      ASSERT_NEAR(score.orientation, slow.orientation, 1e-4) << 5 * k;
      ASSERT_NEAR(score.combined, slow.combined, 1e-4) << 5 * k;
      ASSERT_EQ(score.is_blocked, is_blocked) << 5 * k;
      ASSERT_EQ(score.is_downwind, is_downwind) << 5 * k;
      ASSERT_FALSE(curve.best == k && (is_blocked || is_downwind));
    }
    ASSERT_EQ(curve.best.has_value(), any_allowed);
    (any_allowed ? chosen : refused) += 1;
    ASSERT_NO_FATAL_FAILURE(ExpectBest(curve, drawn));
  }
  EXPECT_GT(chosen, 300) << "seed " << kSeed;
  EXPECT_GT(refused, 10) << "seed " << kSeed;
}

// The world turned turns the curve with it, and the choice: a plateau stays one, however it rounds.
TEST(ApproachHeading, TurnsWithTheWorld) {
  for (const Listed& listed : ListedCases()) {
    const HeadingCurve before = ScoreHeadings(ConditionsOf(listed));
    for (int turn_deg = 5; turn_deg < 360; turn_deg += 5) {
      SCOPED_TRACE(testing::Message() << listed.name << ", turned by " << turn_deg);
      Listed turned = listed;
      for (double* deg : {&turned.sun_azimuth_deg, &turned.wind_from_deg, &turned.wanted_deg}) {
        *deg += turn_deg;
      }
      const HeadingCurve after = ScoreHeadings(ConditionsOf(turned));
      for (int deg = 0; deg < 360; deg += 5) {
        ASSERT_NEAR(At(after, (deg + turn_deg) % 360).combined, At(before, deg).combined, 1e-9);
      }
      // Of two mirrored ones the first from north is chosen: the turn is the same, not its side.
      ASSERT_NEAR(OffDeg(BestDeg(after), turned.wanted_deg),
                  OffDeg(BestDeg(before), listed.wanted_deg), 1e-9);
    }
  }
}

}  // namespace
}  // namespace palace
