// What frames repeat, from answers drawn with known variance.
#include "engine/slad/terrain/repeated_noise.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "engine/core/random.h"

namespace palace {
namespace {

using P = FinePlace;

constexpr int kSide = 96;
constexpr float kKnown = 1e5F;  // 1/m^2: 3 mm

/// Places of level ground whose sums have `times(row, col)` times the variance that they state.
Grid<FinePlace> Drawn(const auto& times) {
  Grid<FinePlace> places(kSide, kSide);
  RandomStream random(5, "answers");
  for (int r = 0; r < kSide; ++r) {
    for (int c = 0; c < kSide; ++c) {
      const double sigma = std::sqrt(times(r, c) * static_cast<double>(kKnown));
      auto& of = places.at(r, c).of;
      of[P::kNet] = of[P::kGross] = of[P::kOtherGross] = kKnown;
      of[P::kOff] = static_cast<float>(sigma * random.Normal());
      of[P::kOther] = static_cast<float>(sigma * random.Normal());
    }
  }
  return places;
}

TEST(RepeatedNoise, TheVarianceIsSoManyTimesTheStatedOne) {
  for (const double times : {1.0, 3.0, 20.0}) {
    const GridF said = VarianceTimes(Drawn([&](int, int) { return times; }));
    double sum = 0;
    for (const float t : said.cells()) {
      EXPECT_GT(t, 0.75 * times);
      EXPECT_LT(t, 2.1 * times);
      sum += static_cast<double>(t);
    }
    // Three sigmas of what chance makes of 256 answers are 44 %.
    EXPECT_NEAR(sum / (kSide * kSide) / times, 1.44, 0.14);
  }
}

TEST(RepeatedNoise, NoSumIsKnownBetterThanItStates) {
  const GridF said = VarianceTimes(Drawn([](int, int) { return 0.1; }));
  for (const float t : said.cells()) {
    EXPECT_EQ(t, 1);
  }
}

TEST(RepeatedNoise, OneHalfOfTheGroundDoesNotSpeakForTheOther) {
  const GridF said = VarianceTimes(Drawn([](int, int c) { return c < kSide / 2 ? 1 : 25; }));
  EXPECT_LT(said.at(40, 20), 2.3);
  EXPECT_GT(said.at(40, 76), 18);
  for (int c = 24; c < 72; ++c) {
    EXPECT_LT(std::abs(said.at(40, c) - said.at(40, c - 1)), 3) << "bilinear between blocks";
  }
}

TEST(RepeatedNoise, AHeightIsNotTakenForNoise) {
  Grid<FinePlace> places = Drawn([](int, int) { return 1; });
  const GridF level = VarianceTimes(places);
  constexpr float kHeight_m = 0.05F;
  for (FinePlace& place : places.cells()) {
    // The other gradients are like its own by a third: they answer a third of what it answers.
    place.of[P::kShared] = kKnown / 3;
    place.of[P::kOff] = kHeight_m * kKnown;
    place.of[P::kOther] += kHeight_m * kKnown / 3;
  }
  const GridF raised = VarianceTimes(places);
  const Grid<FineKnown> known = WithRepeatedNoise(places);
  for (std::size_t i = 0; i < raised.cells().size(); ++i) {
    EXPECT_NEAR(raised.cells()[i], level.cells()[i], 0.5);
    EXPECT_NEAR(known.cells()[i].gross, kKnown * raised.cells()[i], 0.01 * kKnown)
        << "the height alone is 25 times as much";
  }
}

TEST(RepeatedNoise, ThingsOnAThirdOfTheGroundDoNotMakeItAllNoise) {
  Grid<FinePlace> places = Drawn([](int, int) { return 1; });
  for (std::size_t i = 0; i < places.cells().size(); i += 3) {
    places.cells()[i].of[P::kOther] *= 50;
  }
  const GridF said = VarianceTimes(places);
  for (const float t : said.cells()) {
    EXPECT_LT(t, 7) << "the median of two thirds is 2.9 times that of all";
  }
}

TEST(RepeatedNoise, GroundThatDoesNotAnswerIsAsTheRest) {
  Grid<FinePlace> places = Drawn([](int, int) { return 16; });
  for (int r = 0; r < kSide; ++r) {
    for (int c = 0; c < kSide / 2; ++c) {
      places.at(r, c) = {};
    }
  }
  EXPECT_GT(VarianceTimes(places).at(10, 10), 10);
  EXPECT_EQ(VarianceTimes(Grid<FinePlace>(kSide, kSide)).at(10, 10), 1);
  EXPECT_EQ(WithRepeatedNoise(Grid<FinePlace>(5, 3)).at(4, 2).gross, 0);
}

TEST(RepeatedNoise, GradientsThatAreTheHeightsOwnAnswerNothing) {
  // A texture that comes again every 8 rows: nothing is left to be asked, and nothing is claimed.
  Grid<FinePlace> places = Drawn([](int, int) { return 1; });
  for (FinePlace& place : places.cells()) {
    place.of[P::kShared] = kKnown;
    place.of[P::kOther] = place.of[P::kOff];
  }
  const GridF said = VarianceTimes(places);
  for (const float t : said.cells()) {
    EXPECT_EQ(t, 1);
  }
}

}  // namespace
}  // namespace palace
