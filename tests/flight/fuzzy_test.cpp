// The inference against centroids known in closed form and against a sum over many slices.
#include "engine/flight/fuzzy.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "engine/core/random.h"

namespace palace {
namespace {

constexpr FuzzyTerm kAny{-1, -1, 2, 2};

FuzzyRule Always(const FuzzyTerm& then) { return {{}, then}; }

std::optional<double> Centroid(const std::vector<FuzzyRule>& rules) { return Infer(rules, {}); }

TEST(Fuzzy, MembershipOfTrapezoidsTrianglesAndShoulders) {
  struct Row {
    const char* name;
    FuzzyTerm term;
    double x, membership;
  };
  constexpr FuzzyTerm kTrapezoid{1, 2, 4, 8};
  for (const Row& row : {
           Row{"before", kTrapezoid, 0.5, 0},
           Row{"foot", kTrapezoid, 1, 0},
           Row{"rising", kTrapezoid, 1.25, 0.25},
           Row{"top", kTrapezoid, 3, 1},
           Row{"falling", kTrapezoid, 5, 0.75},
           Row{"after", kTrapezoid, 9, 0},
           Row{"triangle's top", {0, 1, 1, 2}, 1, 1},
           Row{"triangle's side", {0, 1, 1, 2}, 1.5, 0.5},
           Row{"upright side, on it", {1, 1, 2, 2}, 1, 1},
           Row{"upright side, before it", {1, 1, 2, 2}, 0.999, 0},
           Row{"below, far", FuzzyBelow(1, 3), -1e300, 1},
           Row{"below, side", FuzzyBelow(1, 3), 2.5, 0.25},
           Row{"below, out", FuzzyBelow(1, 3), 4, 0},
           Row{"below, infinite", FuzzyBelow(1, 3), -INFINITY, 1},
           Row{"above, side", FuzzyAbove(1, 3), 2.5, 0.75},
           Row{"above, infinite", FuzzyAbove(1, 3), INFINITY, 1},
       }) {
    EXPECT_DOUBLE_EQ(Membership(row.term, row.x), row.membership) << row.name;
  }
  EXPECT_TRUE(std::isnan(Membership(kTrapezoid, NAN)));
}

TEST(Fuzzy, CentroidsInClosedForm) {
  // A triangle: the mean of its corners. A trapezoid of sides a (below), b (above), from a left
  // upright side: (a^2 + a b + b^2) / (3 (a + b)).
  EXPECT_NEAR(*Centroid({Always({0.1, 0.2, 0.2, 0.9})}), 0.4, 1e-12);
  EXPECT_NEAR(*Centroid({Always({0.2, 0.2, 0.5, 0.8})}), 0.2 + (0.36 + 0.18 + 0.09) / 2.7, 1e-12);
  EXPECT_NEAR(*Centroid({Always({0.3, 0.3, 0.7, 0.7})}), 0.5, 1e-12);
  // What overhangs does not count.
  EXPECT_NEAR(*Centroid({Always({-0.25, 0, 0, 0.25})}), 0.25 / 3, 1e-12);
  EXPECT_NEAR(*Centroid({Always(kAny)}), 0.5, 1e-12);
  // Two apart: weighted by their areas, which are 0.1 and 0.2.
  EXPECT_NEAR(*Centroid({Always({0, 0.1, 0.1, 0.2}), Always({0.5, 0.7, 0.7, 0.9})}),
              (0.1 * 0.1 + 0.2 * 0.7) / 0.3, 1e-12);
  // Triangles about 0.5 and 0.75 that cross at 0.625, half way up: their sum of areas without the
  // triangle below the crossing, which both have.
  const double area = 0.25 + 0.25 - 0.25 * 0.5 / 2;
  const double moment = 0.25 * 0.5 + 0.25 * 0.75 - 0.25 * 0.5 / 2 * 0.625;
  EXPECT_NEAR(*Centroid({Always({0.25, 0.5, 0.5, 0.75}), Always({0.5, 0.75, 0.75, 1})}),
              moment / area, 1e-12);
}

TEST(Fuzzy, OneRuleAnswersWithItsOwnCentroidWhateverItsWeight) {
  const std::vector<FuzzyRule> rules = {
      {{{0, FuzzyBelow(0, 10)}}, {0.5, 0.75, 0.75, 1}},
      {{{0, FuzzyAbove(20, 30)}}, {0, 0.25, 0.25, 0.5}},
  };
  for (const double x : {-5.0, 5.0, 9.999}) {
    EXPECT_NEAR(Infer(rules, {{x}}).value(), 0.75, 1e-9) << x;
  }
  EXPECT_NEAR(Infer(rules, {{21.0}}).value(), 0.25, 1e-12);
}

TEST(Fuzzy, NothingWhereNoRuleFires) {
  const std::vector<FuzzyRule> rules = {{{{0, FuzzyBelow(0, 10)}}, kAny},
                                        {{{0, FuzzyAbove(20, 30)}}, {1.5, 2, 2, 3}}};
  EXPECT_FALSE(Infer(rules, {{15.0}})) << "between the terms";
  EXPECT_FALSE(Infer(rules, {{10.0}})) << "on the foot";
  EXPECT_FALSE(Infer(rules, {{40.0}})) << "all of the output beyond 1";
  EXPECT_FALSE(Infer(rules, {{NAN}}));
  EXPECT_FALSE(Infer({}, {{1.0}}));
}

TEST(Fuzzy, AndIsTheLeastAndNotTurnsRound) {
  constexpr FuzzyTerm kLow{0, 0.1, 0.1, 0.2}, kHigh{0.8, 0.9, 0.9, 1};
  const std::vector<FuzzyRule> rules = {
      {{{0, FuzzyAbove(0, 1)}, {1, FuzzyAbove(0, 1)}}, kHigh},
      {{{0, FuzzyAbove(0, 1), true}}, kLow},
  };
  const auto answer = [&](double x, double y) { return Infer(rules, {{x, y}}).value(); };
  // The terms are alike and apart: their weights weigh their places.
  EXPECT_NEAR(answer(0.75, 0.5), (0.5 * 0.9 + 0.25 * 0.1) / 0.75, 1e-12);
  EXPECT_NEAR(answer(0.75, 2), (0.75 * 0.9 + 0.25 * 0.1) / 1, 1e-12);
  EXPECT_NEAR(answer(1, 0.3), 0.9, 1e-12);
  EXPECT_NEAR(answer(0.5, 0), 0.1, 1e-12);
}

TEST(Fuzzy, OfTwoRulesOfOneTermTheStrongerCounts) {
  constexpr FuzzyTerm kTerm{0.2, 0.3, 0.3, 0.6}, kOther{0.6, 0.8, 0.8, 1};
  const FuzzyClause strong{0, FuzzyAbove(0, 1)}, weak{1, FuzzyAbove(0, 1)};
  const std::vector<FuzzyRule> both = {{{strong}, kTerm}, {{weak}, kTerm}, Always(kOther)};
  const std::vector<FuzzyRule> one = {{{strong}, kTerm}, Always(kOther)};
  EXPECT_NEAR(Infer(both, {{0.6, 0.4}}).value(), Infer(one, {{0.6, 0.4}}).value(), 1e-12);
}

TEST(Fuzzy, AClauseWithoutItsInputIsTheProgrammersError) {
  const std::vector<FuzzyRule> rules = {{{{1, FuzzyBelow(0, 10)}}, kAny}};
  EXPECT_DEATH((void)Infer(rules, {{1.0}}), "clause.input");
}

/// The same by the middles of 20000 slices.
double BySlices(const std::vector<FuzzyRule>& rules, const std::vector<double>& inputs) {
  constexpr int kSlices = 20000;
  std::vector<double> weights;
  for (const FuzzyRule& rule : rules) {
    double weight = 1;
    for (const FuzzyClause& clause : rule.all_of) {
      const double m = Membership(clause.term, inputs.at(static_cast<std::size_t>(clause.input)));
      weight = std::min(weight, clause.is_not ? 1 - m : m);
    }
    weights.push_back(weight);
  }
  double area = 0, moment = 0;
  for (int k = 0; k < kSlices; ++k) {
    const double y = (k + 0.5) / kSlices;
    double f = 0;
    for (std::size_t r = 0; r < rules.size(); ++r) {
      f = std::max(f, weights[r] * Membership(rules[r].then, y));
    }
    area += f;
    moment += f * y;
  }
  return area > 0 ? moment / area : NAN;
}

TEST(Fuzzy, EqualsASumOverManySlices) {
  constexpr std::uint64_t kSeed = 1975;
  RandomStream random(kSeed);
  const auto term = [&](double low, double high) {
    std::vector<double> x(4);
    for (double& corner : x) {
      corner = random.Uniform(low, high);
    }
    std::sort(x.begin(), x.end());
    // Every third has a point, an upright side or both.
    x[1] = random.Index(3) == 0 ? x[2] : x[1];
    x[0] = random.Index(3) == 0 ? x[1] : x[0];
    return FuzzyTerm{x[0], x[1], x[2], x[3]};
  };
  int fired = 0;
  for (int trial = 0; trial < 300; ++trial) {
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", trial " << trial);
    std::vector<FuzzyRule> rules;
    for (int r = random.Index(6); r >= 0; --r) {
      FuzzyRule rule{{}, term(-0.3, 1.3)};
      for (int c = random.Index(3); c > 0; --c) {
        rule.all_of.push_back({random.Index(2), term(-1, 2), random.Index(3) == 0});
      }
      rules.push_back(rule);
    }
    const std::vector<double> inputs = {random.Uniform(), random.Uniform()};
    const std::optional<double> answer = Infer(rules, inputs);
    const double slow = BySlices(rules, inputs);
    if (!answer) {
      ASSERT_TRUE(std::isnan(slow)) << slow;
      continue;
    }
    ++fired;
    ASSERT_NEAR(*answer, slow, 2e-4);
  }
  EXPECT_GT(fired, 200) << "seed " << kSeed;
}

}  // namespace
}  // namespace palace
