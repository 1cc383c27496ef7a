// How many things may hide under a touchdown, against the closed form of one cell.
#include "engine/slad/sites/hidden_things.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/slad/worlds.h"

namespace palace {
namespace {

using testing::Flat;
using testing::MakeMap;

constexpr double kLimit_m = 0.10, kRadius_m = 2.3, kThingsPer_m2 = 0.04;
constexpr Cell kMiddle{20, 20};

/// Every cell shows `shown_m` with that sigma, where a thing would show `share` of its height.
ElevationMap MapThatShows(double shown_m, double sigma_m, double share) {
  ElevationMap map = MakeMap(41, 41, 0.15, Flat());
  const auto layer = [](double value) { return GridF(41, 41, static_cast<float>(value)); };
  map.narrow = {layer(shown_m), layer(sigma_m), layer(share)};
  return map;
}

double Hidden(const ElevationMap& map) { return HiddenThings(map, kLimit_m, kMiddle, kRadius_m); }

TEST(HiddenThings, OneCellIsTheClosedForm) {
  // A radius below a cell's side leaves the middle alone.
  for (const double shown_m : {0.0, 0.01, -0.02, 0.03}) {
    const double sigma_m = 0.01, share = 0.3, r = 1.2 * kLimit_m * share;
    const double prior = kThingsPer_m2 / 2 * 0.15 * 0.15;
    double expected = 0;
    for (const double p : {shown_m, -shown_m}) {
      const double odds = prior * std::exp((2 * r * p - r * r) / (2 * sigma_m * sigma_m));
      expected += odds / (1 + odds);
    }
    EXPECT_NEAR(HiddenThings(MapThatShows(shown_m, sigma_m, share), kLimit_m, kMiddle, 0.1),
                expected, 1e-6 * expected);
  }
}

TEST(HiddenThings, BlindGroundHidesWhatThePriorSaysAndClearGroundNothing) {
  const double prior = kThingsPer_m2 * M_PI * kRadius_m * kRadius_m;
  EXPECT_NEAR(Hidden(MapThatShows(0, 1, 0.01)), prior, 0.03 * prior);
  EXPECT_LT(Hidden(MapThatShows(0, 0.003, 0.35)), 1e-9);
  ElevationMap unknown = MapThatShows(NAN, NAN, NAN);
  EXPECT_NEAR(Hidden(unknown), prior, 0.03 * prior);
  EXPECT_NEAR(HiddenThings(MapThatShows(0, 0.003, 0.35), kLimit_m, {0, 0}, kRadius_m), 0.75 * prior,
              0.1 * prior)
      << "three quarters of a disc at the map's corner are not known";
  EXPECT_EQ(Hidden(MakeMap(41, 41, 0.15, Flat())), 0) << "a survey";
}

TEST(HiddenThings, GrowsWithNoiseWithWhatShowsAndWithDistance) {
  const double base = Hidden(MapThatShows(0, 0.008, 0.3));
  EXPECT_GT(Hidden(MapThatShows(0, 0.010, 0.3)), base);
  EXPECT_GT(Hidden(MapThatShows(0, 0.008, 0.25)), base);
  EXPECT_GT(Hidden(MapThatShows(0.01, 0.008, 0.3)), base);
  EXPECT_DOUBLE_EQ(Hidden(MapThatShows(-0.01, 0.008, 0.3)), Hidden(MapThatShows(0.01, 0.008, 0.3)))
      << "a hole counts as a rock does";
  ElevationMap one = MapThatShows(0, 0.003, 0.35);
  one.narrow.prominence_m.at(kMiddle) = 0.035F;
  EXPECT_GT(Hidden(one), kMostHidden) << "one cell is enough";
}

TEST(HiddenThings, GroundIsSeenWhereAThingIsRuledOutFiftyToOne) {
  // At r / sigma = k a cell that shows nothing has the ratio exp(-k^2 / 2): 1/50 at 2.797.
  const double share = 0.3, r = 1.2 * kLimit_m * share;
  for (const double k : {2.75, 2.85}) {
    const ElevationMap map = MapThatShows(0, r / k, share);
    EXPECT_EQ(IsSeen(map, kLimit_m, kMiddle), k > 2.8) << k;
  }
  EXPECT_FALSE(IsSeen(MapThatShows(0.7 * r, r / 4, share), kLimit_m, kMiddle));
  EXPECT_FALSE(IsSeen(MapThatShows(-0.7 * r, r / 4, share), kLimit_m, kMiddle));
  EXPECT_FALSE(IsSeen(MapThatShows(NAN, NAN, NAN), kLimit_m, kMiddle));
  EXPECT_TRUE(IsSeen(MakeMap(41, 41, 0.15, Flat()), kLimit_m, kMiddle)) << "a survey";
  // A disc seen everywhere is confirmed.
  EXPECT_LT(Hidden(MapThatShows(0, r / 2.85, share)), kMostHidden + 0.005);
}

}  // namespace
}  // namespace palace
