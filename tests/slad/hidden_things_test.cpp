// How many things may hide under a touchdown, against the closed form of one cell.
#include "engine/slad/hazards/hidden_things.h"

#include <cmath>

#include <gtest/gtest.h>

#include "engine/model/site_standing.h"
#include "engine/slad/hazards/hazard_maps.h"
#include "tests/slad/worlds.h"

namespace palace {
namespace {

using testing::Flat;
using testing::MakeMap;

constexpr double kLimit_m = 0.10, kRadius_m = 2.3;
constexpr Cell kMiddle{20, 20};

/// Every cell shows `shown_m` with that sigma, where a thing would show `share` of its height.
ElevationMap MapThatShows(double shown_m, double sigma_m, double share) {
  ElevationMap map = MakeMap(41, 41, 0.15, Flat());
  const auto layer = [](double value) { return GridF(41, 41, static_cast<float>(value)); };
  map.narrow = {layer(shown_m), layer(sigma_m), layer(share)};
  return map;
}

NarrowView ViewOf(const ElevationMap& map) { return {map.narrow, 0.15, kLimit_m}; }

double Hidden(const ElevationMap& map, Cell cell = kMiddle, double radius_m = kRadius_m) {
  return static_cast<double>(HiddenThings(ViewOf(map), radius_m).at(cell));
}

TEST(HiddenThings, OneCellIsTheClosedForm) {
  // A radius below a cell's side leaves the middle alone.
  for (const double shown_m : {0.0, 0.01, -0.02, 0.03, 0.036, -0.05}) {
    const double sigma_m = 0.01, share = 0.3, r = 1.2 * kLimit_m * share;
    const double prior = kThingsPer_m2 / 2 * 0.15 * 0.15;
    double expected = 0;
    for (const double p : {shown_m, -shown_m}) {
      const double s2 = 2 * sigma_m * sigma_m;
      const double limit = std::exp((2 * r * p - r * r) / s2);
      const double best = p > 0 ? std::exp(p * p / s2) : 1;
      const double larger = p < r ? limit : best, smaller = p < r ? best : limit;
      expected += prior * larger / (1 + prior * (larger + smaller));
    }
    EXPECT_NEAR(Hidden(MapThatShows(shown_m, sigma_m, share), kMiddle, 0.1), expected,
                1e-4 * expected);
  }
}

TEST(HiddenThings, BlindGroundHidesWhatThePriorSaysAndClearGroundNothing) {
  const double prior = kThingsPer_m2 * M_PI * kRadius_m * kRadius_m;
  EXPECT_NEAR(Hidden(MapThatShows(0, 1, 0.01)), prior, 0.03 * prior);
  EXPECT_LT(Hidden(MapThatShows(0, 0.003, 0.35)), 1e-9);
  ElevationMap unknown = MapThatShows(NAN, NAN, NAN);
  EXPECT_NEAR(Hidden(unknown), prior, 0.03 * prior);
  EXPECT_NEAR(Hidden(MapThatShows(0, 0.003, 0.35), {0, 0}), 0.75 * prior, 0.1 * prior)
      << "three quarters of a disc at the map's corner are not known";
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

TEST(HiddenThings, ALowThingSeenWellIsALowThing) {
  // Half as high as the limit's, from near by: six sigmas above the ground, six below the limit.
  const double share = 0.6, r = 1.2 * kLimit_m * share;
  ElevationMap map = MapThatShows(0, r / 12, share);
  map.narrow.prominence_m.at(kMiddle) = static_cast<float>(r / 2);
  EXPECT_LT(Hidden(map), 1e-3);
  map.narrow.prominence_m.at(kMiddle) = static_cast<float>(r);
  EXPECT_NEAR(Hidden(map), 0.5, 0.01);
  map.narrow.prominence_m.at(kMiddle) = static_cast<float>(1.5 * r);
  EXPECT_NEAR(Hidden(map), 1, 0.01);
}

TEST(HiddenThings, DiscsAreTheSumsOfTheirCells) {
  // The fast sums along rows against the plain ones over every cell.
  ElevationMap map = MapThatShows(0, 0.01, 0.3);
  RandomStream random(7, "what shows");
  for (float& shown_m : map.narrow.prominence_m.cells()) {
    shown_m = static_cast<float>(0.01 * random.Normal());
  }
  for (const double radius_m : {0.1, 0.5, 2.3, 30.0}) {
    const GridF cells = HiddenThings(ViewOf(map), 0.1);  // each alone
    const GridF discs = HiddenThings(ViewOf(map), radius_m);
    for (const Cell centre : {Cell{20, 20}, Cell{0, 3}, Cell{40, 40}}) {
      const double r2 = std::pow(std::min(radius_m / 0.15, 41.0), 2);
      double sum = 0;
      for (int r = -100; r <= 140; ++r) {
        for (int c = -100; c <= 140; ++c) {
          const bool inside = map.geometry.Contains({r, c});
          if (std::pow(r - centre.row, 2) + std::pow(c - centre.col, 2) <= r2) {
            sum += inside ? static_cast<double>(cells.at(r, c)) : kThingsPer_m2 * 0.15 * 0.15;
          }
        }
      }
      EXPECT_NEAR(static_cast<double>(discs.at(centre)), sum, 1e-3 * sum + 1e-6) << radius_m;
    }
  }
}

TEST(HiddenThings, ArePartOfTheProbabilityOfASafeTouchdown) {
  const SladSettings settings;
  const ElevationMap clear = MapThatShows(0, 0.003, 0.35);
  const HazardMaps seen = EvaluateHazards(clear, settings);
  const HazardMaps blind = EvaluateHazards(MapThatShows(0, 1, 0.01), settings);
  const double gear = static_cast<double>(seen.safe_probability.at(kMiddle));
  const double hidden = static_cast<double>(blind.hidden_things.at(kMiddle));
  EXPECT_NEAR(static_cast<double>(blind.safe_probability.at(kMiddle)), gear * std::exp(-hidden),
              1e-5);
  EXPECT_EQ(blind.ground.at(kMiddle), GroundClass::kLandable) << "offered, to be looked at";
  ElevationMap marked = clear;
  marked.narrow.prominence_m.at(kMiddle) = 0.042F;  // as a thing of the limit's size would show
  EXPECT_NE(EvaluateHazards(marked, settings).ground.at(kMiddle), GroundClass::kLandable)
      << "not offered";
  EXPECT_TRUE(EvaluateHazards(MakeMap(41, 41, 0.15, Flat()), settings).hidden_things.empty())
      << "a survey";
}

TEST(HiddenThings, GroundIsSeenWhereAThingIsRuledOutFiftyToOne) {
  // At r / sigma = k a cell that shows nothing has the ratio exp(-k^2 / 2): 1/50 at 2.797.
  const double share = 0.3, r = 1.2 * kLimit_m * share;
  for (const double k : {2.75, 2.85}) {
    const ElevationMap map = MapThatShows(0, r / k, share);
    EXPECT_EQ(IsSeen(ViewOf(map), kMiddle), k > 2.8) << k;
  }
  const auto seen = [&](const ElevationMap& map) { return IsSeen(ViewOf(map), kMiddle); };
  EXPECT_FALSE(seen(MapThatShows(0.7 * r, r / 4, share)));
  EXPECT_FALSE(seen(MapThatShows(-0.7 * r, r / 4, share)));
  EXPECT_FALSE(seen(MapThatShows(NAN, NAN, NAN)));
  EXPECT_LT(Hidden(MapThatShows(0, r / 2.85, share)), kMostHidden) << "then confirmed";
}

/// The share that a window of `window_m` leaves (narrow_relief.h), of a cell of 15 cm.
double ShareOf(double window_m) {
  return 0.8 / (1 + (window_m * window_m + 0.15 * 0.15) / (0.18 * 0.18));
}

TEST(HiddenThings, FromNearerAreThoseOfBareGroundWithLessNoiseAndANarrowerWindow) {
  const auto from = [](const ElevationMap& map, double nearer) {
    return HiddenFromNearer(ViewOf(map), map.variance_m2, kMiddle, kRadius_m, nearer);
  };
  const auto with_noise = [](double sigma_m, double share, double stereo_m) {
    ElevationMap map = MapThatShows(0, sigma_m, share);
    map.variance_m2 = GridF(41, 41, static_cast<float>(stereo_m * stereo_m));
    return map;
  };
  const double sigma_m = 0.04;
  for (const double nearer : {1.0, 0.7, 0.5}) {
    SCOPED_TRACE(nearer);
    const double then_m = nearer * nearer * sigma_m;
    const double all = from(with_noise(sigma_m, ShareOf(0.3), sigma_m), nearer);
    const double expected = Hidden(MapThatShows(0, then_m, ShareOf(nearer * 0.3)));
    EXPECT_NEAR(all, expected, 2e-3 * expected);
    // Half of its variance is the ground's own.
    const double half_m = sigma_m / std::sqrt(2 * 1.5);
    const double rough_m = std::sqrt((sigma_m * sigma_m + then_m * then_m) / 2);
    const double rough = Hidden(MapThatShows(0, rough_m, ShareOf(nearer * 0.3)));
    EXPECT_NEAR(from(with_noise(sigma_m, ShareOf(0.3), half_m), nearer), rough, 4e-3 * rough);
  }
  // What shows now says nothing of then; what is unknown is as the rest.
  ElevationMap marked = with_noise(sigma_m, ShareOf(0.3), sigma_m);
  const double bare = from(marked, 0.5);
  marked.narrow.prominence_m.at(kMiddle) = 0.03F;
  EXPECT_DOUBLE_EQ(from(marked, 0.5), bare);
  for (int row = 0; row < kMiddle.row; ++row) {
    for (int col = 0; col < 41; ++col) {
      marked.narrow.prominence_m.at(row, col) = std::nanf("");
    }
  }
  EXPECT_NEAR(from(marked, 0.5) / bare, 1, 1e-6);
  EXPECT_TRUE(std::isinf(from(MapThatShows(NAN, NAN, NAN), 0.5)));
}

}  // namespace
}  // namespace palace
