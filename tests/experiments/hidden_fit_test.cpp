// The density of hidden things fitted to judged sites, against draws of a known one.
#include "engine/experiments/hidden_fit.h"

#include <cmath>

#include <gtest/gtest.h>

#include "engine/core/random.h"

namespace palace {
namespace {

/// Ground of which `blind_m2` could not be seen.
JudgedSite Blind(const std::string& family, double blind_m2, bool unsafe) {
  JudgedSite site{family, {}, unsafe};
  for (const double density : kHiddenDensities) {
    site.hidden.push_back(density * blind_m2);
  }
  return site;
}

std::vector<JudgedSite> Drawn(const std::string& family, double density, int count,
                              RandomStream& random) {
  std::vector<JudgedSite> sites;
  for (int i = 0; i < count; ++i) {
    const double blind_m2 = random.Uniform(0.1, 17);
    sites.push_back(
        Blind(family, blind_m2, random.Uniform(0, 1) < 1 - std::exp(-density * blind_m2)));
  }
  return sites;
}

TEST(HiddenFit, BetweenDensitiesHiddenThingsRunStraightInLogarithms) {
  const JudgedSite site = Blind("rocks", 17, false);
  for (const double density : {0.001, 0.002, 0.01, 0.05, 0.7, 1.0}) {
    EXPECT_NEAR(HiddenAt(site, density), 17 * density, 1e-9 * density);
  }
  EXPECT_NEAR(HiddenAt(site, 1e-6), 0.017, 1e-9) << "held at the ends";
  EXPECT_NEAR(HiddenAt(site, 50), 17, 1e-9);
}

TEST(HiddenFit, FindsTheDensityThatSitesWereDrawnWith) {
  constexpr std::uint64_t kSeed = 41;
  for (const double density : {0.004, 0.02, 0.1}) {
    RandomStream random(kSeed, "judged sites");
    const std::vector<JudgedSite> sites = Drawn("rocks", density, 4000, random);
    EXPECT_NEAR(std::log(FitDensity(sites) / density), 0, 0.2) << "seed " << kSeed;
  }
  EXPECT_TRUE(std::isnan(FitDensity({})));
}

TEST(HiddenFit, NoFamilyJudgesItself) {
  RandomStream random(42, "judged sites");
  std::vector<JudgedSite> sites = Drawn("lawns", 0.002, 3000, random);
  const std::vector<JudgedSite> rocks = Drawn("rocks", 0.05, 3000, random);
  sites.insert(sites.end(), rocks.begin(), rocks.end());
  const std::vector<LeftOut> left_out = LeaveOneOut(sites);
  ASSERT_EQ(left_out.size(), 2U);
  EXPECT_EQ(left_out[0].family, "lawns");
  EXPECT_NEAR(left_out[0].things_per_m2, 0.05, 0.01) << "fitted on the rocks alone";
  EXPECT_NEAR(left_out[1].things_per_m2, 0.002, 0.0006);
  EXPECT_GT(left_out[0].said_unsafe, 10.0 * left_out[0].unsafe / left_out[0].sites);
  EXPECT_LT(left_out[1].said_unsafe, 0.1 * left_out[1].unsafe / left_out[1].sites);
  EXPECT_TRUE(LeaveOneOut(rocks).empty()) << "one family leaves no other to fit on";
}

}  // namespace
}  // namespace palace
