// How many things may hide under a touchdown, against the closed form of one cell.
#include "engine/slad/hazards/hidden_things.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "engine/model/cell_explanation.h"
#include "engine/model/site_standing.h"
#include "engine/slad/hazards/hazard_maps.h"
#include "engine/slad/sites/none_reason.h"
#include "tests/slad/worlds.h"

namespace palace {
namespace {

using testing::Flat;
using testing::MakeMap;
using testing::ThatShow;

constexpr double kLimit_m = 0.10, kRadius_m = 2.3;
constexpr Cell kMiddle{20, 20};

ElevationMap MapThatShows(double shown_m, double sigma_m, double share) {
  ElevationMap map = MakeMap(41, 41, 0.15, Flat());
  map.narrow = ThatShow(map.geometry, shown_m, sigma_m, share);
  return map;
}

/// One place of the middle cell shows that much.
ElevationMap Marked(ElevationMap map, double shown_m) {
  map.narrow.prominence_m.at(2 * kMiddle.row, 2 * kMiddle.col + 1) = static_cast<float>(shown_m);
  return map;
}

NarrowView ViewOf(const ElevationMap& map) { return {map.narrow, 0.15, kLimit_m}; }

double Hidden(const ElevationMap& map, Cell cell = kMiddle, double radius_m = kRadius_m) {
  return static_cast<double>(HiddenThings(ViewOf(map), radius_m).at(cell));
}

TEST(HiddenThings, OneCellIsTheClosedForm) {
  // A radius below a cell's side leaves the middle alone: four places.
  for (const double shown_m : {0.0, 0.01, -0.02, 0.03, 0.036, -0.05}) {
    const double sigma_m = 0.01, share = 0.3, r = 1.2 * kLimit_m * share;
    const double prior = kThingsPer_m2 / 2 * 0.15 * 0.15 / 4;
    double expected = 0;
    for (const double p : {shown_m, -shown_m}) {
      const auto ratio = [&](double size) {
        return std::exp((2 * size * r * p - size * size * r * r) / (2 * sigma_m * sigma_m));
      };
      const double larger = 0.57 * ratio(1) + 0.29 * ratio(1.5) + 0.14 * ratio(2.5);
      const double smaller = 0.57 * ratio(0.25) + 0.29 * ratio(0.5) + 0.14 * ratio(0.75);
      expected += 4 * prior * larger / (1 + prior * (larger + smaller));
    }
    EXPECT_NEAR(Hidden(MapThatShows(shown_m, sigma_m, share), kMiddle, 0.1), expected,
                1e-4 * expected);
  }
}

TEST(HiddenThings, NoiseAloneHidesOnAverageWhatThePriorSays) {
  // The mean of a likelihood ratio over bare ground is 1, however little or much a thing would
  // show.
  for (const double sigmas : {0.3, 1.0, 1.7}) {
    const double share = 0.4, sigma_m = 1.2 * kLimit_m * share / sigmas;
    ElevationMap map = MapThatShows(0, sigma_m, share);
    RandomStream random(11, "noise");
    for (float& shown_m : map.narrow.prominence_m.cells()) {
      shown_m = static_cast<float>(sigma_m * random.Normal());
    }
    const double prior = kThingsPer_m2 * M_PI * kRadius_m * kRadius_m;
    EXPECT_NEAR(Hidden(map), prior, 0.5 * prior) << sigmas;
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
  EXPECT_GT(Hidden(Marked(MapThatShows(0, 0.003, 0.35), 0.038)), kMostHidden)
      << "one place is enough";
}

TEST(HiddenThings, ALowThingSeenWellIsALowThing) {
  // Half as high as the limit's, from near by: six sigmas above the ground, six below the limit.
  const double share = 0.6, r = 1.2 * kLimit_m * share;
  const ElevationMap bare = MapThatShows(0, r / 12, share);
  EXPECT_LT(Hidden(Marked(bare, r / 2)), 1e-3);
  EXPECT_GT(Hidden(Marked(bare, r)), 0.5);
  EXPECT_NEAR(Hidden(Marked(bare, 1.5 * r)), 1, 0.01);
}

// A post's top lies over several places of the cell: it is one thing all the same.
TEST(MarkedThings, AreThingsAsOftenAsOneSoHighReachesTheLimit) {
  ElevationMap map = MapThatShows(0, 0.003, 0.35);
  map.narrow.mark = map.narrow.mark_from_m = GridF(82, 82, 0.0F);
  const auto marked = [&](double chance, double from_m, const GridF* safe_distance_m = nullptr) {
    for (const int aside : {0, 1}) {
      map.narrow.mark.at(2 * kMiddle.row, 2 * kMiddle.col + aside) = static_cast<float>(chance);
      map.narrow.mark_from_m.at(2 * kMiddle.row, 2 * kMiddle.col + aside) =
          static_cast<float>(from_m);
    }
    const NarrowView view{map.narrow, 0.15, kLimit_m, safe_distance_m};
    return static_cast<double>(MarkedThings(view, kRadius_m).at(kMiddle));
  };
  EXPECT_NEAR(marked(0.9, 0.4), 0.9, 1e-6);
  EXPECT_NEAR(marked(0.9, 1.2 * kLimit_m / 2), 0.9 / 4, 1e-6) << "seen from near";
  EXPECT_NEAR(marked(0, 0.4), 0, 1e-6);
  const GridF near_m(41, 41, 0.5F);
  EXPECT_NEAR(marked(1, 0.4, &near_m), 0, 1e-6) << "the hazard's own";
}

TEST(MarkedThings, ThatAreLessThanAThingTakeANearerLookAndNoGroundAway) {
  ElevationMap map = MapThatShows(0, 0.003, 0.35);
  map.narrow.mark = map.narrow.mark_from_m = GridF(82, 82, 0.0F);
  const HazardMaps bare = EvaluateHazards(map, SladSettings{});
  map.narrow.mark.at(2 * kMiddle.row, 2 * kMiddle.col) = 0.4F;
  map.narrow.mark_from_m.at(2 * kMiddle.row, 2 * kMiddle.col) = 1;
  const HazardMaps marked = EvaluateHazards(map, SladSettings{});
  const auto hidden = [](const HazardMaps& maps) {
    return static_cast<double>(maps.hidden_things.at(kMiddle));
  };
  // As far as the ground is seen it is as safe as before.
  const auto as_seen = [&](const HazardMaps& maps) {
    return static_cast<double>(maps.safe_probability.at(kMiddle)) / ForgivenHidden(hidden(maps));
  };
  EXPECT_NEAR(hidden(marked), -std::log(kOffered), 1e-6);
  EXPECT_EQ(marked.flags.at(kMiddle), kFlagUnexplained);
  EXPECT_EQ(std::count(marked.flags.cells().begin(), marked.flags.cells().end(), kFlagNone),
            41 * 41 - 1);
  EXPECT_EQ(bare.flags.at(kMiddle), kFlagNone);
  EXPECT_GT(hidden(marked), kMostHiddenProvisional) << "one to look at first";
  EXPECT_NEAR(as_seen(marked), as_seen(bare), 1e-6);
  map.narrow.mark.at(2 * kMiddle.row, 2 * kMiddle.col) = 0.1F;
  EXPECT_NEAR(hidden(EvaluateHazards(map, SladSettings{})) - hidden(bare), 0.1, 1e-6);
}

TEST(MarkedThings, ThatRatherAreAThingAreHazards) {
  ElevationMap map = MapThatShows(0, 0.003, 0.35);
  map.narrow.mark = map.narrow.mark_from_m = GridF(82, 82, 0.0F);
  map.narrow.mark.at(2 * kMiddle.row, 2 * kMiddle.col) = 0.6F;
  float& from_m = map.narrow.mark_from_m.at(2 * kMiddle.row, 2 * kMiddle.col);
  from_m = 1;
  const SladSettings settings;
  const HazardMaps marked = EvaluateHazards(map, settings);
  EXPECT_EQ(marked.reasons.at(kMiddle), kHazardFlagged);
  EXPECT_EQ(marked.flags.at(kMiddle), kFlagUnexplained);
  EXPECT_EQ(marked.safe_distance_m.at(kMiddle), 0);
  EXPECT_EQ(marked.ground.at(kMiddle), GroundClass::kHazard);
  const Cell beside{kMiddle.row, kMiddle.col + 4};
  EXPECT_LT(marked.safe_distance_m.at(beside), 4 * map.geometry.cell_m);
  EXPECT_LT(static_cast<double>(marked.hidden_things.at(beside)), kMostHiddenProvisional)
      << "what is a hazard hides no more";
  from_m = static_cast<float>(1.2 * kLimit_m / 2);  // a quarter of such things reach the limit
  EXPECT_EQ(EvaluateHazards(map, settings).reasons.at(kMiddle), kHazardNone);
}

TEST(MarkedThings, ThatRefuseNothingAreNotNamedAsWhatDoes) {
  ElevationMap map = MapThatShows(0, 0.003, 0.35);
  map.flags = Grid<std::uint8_t>(41, 41, kFlagNone);
  map.flags.at(5, 5) = kFlagNoTexture;
  map.narrow.mark = map.narrow.mark_from_m = GridF(82, 82, 0.0F);
  for (const int row : {40, 50, 60}) {
    map.narrow.mark.at(row, 40) = 0.4F;
    map.narrow.mark_from_m.at(row, 40) = 1;
  }
  const SladSettings settings;
  const std::string faint = NoneReason(map, EvaluateHazards(map, settings), settings);
  EXPECT_NE(faint.find("flagged (no texture)"), std::string::npos) << faint;
  for (const int row : {40, 50, 60}) {
    map.narrow.mark.at(row, 40) = 0.6F;
  }
  const std::string sure = NoneReason(map, EvaluateHazards(map, settings), settings);
  EXPECT_NE(sure.find("flagged (unexplained mark)"), std::string::npos) << sure;
}

TEST(HiddenThings, AFigureThatIsNotWholeIsUnknownGround) {
  const double unknown = Hidden(MapThatShows(NAN, NAN, NAN));
  EXPECT_EQ(Hidden(MapThatShows(0, NAN, 0.3)), unknown);
  EXPECT_EQ(Hidden(MapThatShows(0, 0, 0.3)), unknown);
  EXPECT_EQ(Hidden(MapThatShows(0, 0.01, NAN)), unknown);
}

TEST(HiddenThings, BesideAHazardWhatItsFootShowsIsNothing) {
  // A thousand sigmas, and a hazard half a metre away.
  ElevationMap map = MapThatShows(0.2, 0.0002, 0.4);
  const GridF near_m(41, 41, 0.5F);
  const NarrowView view{map.narrow, 0.15, kLimit_m, &near_m};
  const GridF hides = HiddenThings(view, kRadius_m);
  for (const float hidden : hides.cells()) {
    ASSERT_GE(hidden, -1e-6) << "and a number";
    ASSERT_LT(hidden, 0.2);
  }
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
  // As a thing of the limit's size would show.
  EXPECT_NE(EvaluateHazards(Marked(clear, 0.042), settings).ground.at(kMiddle),
            GroundClass::kLandable)
      << "not offered";
  EXPECT_TRUE(EvaluateHazards(MakeMap(41, 41, 0.15, Flat()), settings).hidden_things.empty())
      << "a survey";
}

TEST(HiddenThings, FromNearerAreThoseOfBareGroundWithLessNoise) {
  const auto from = [](const ElevationMap& map, double nearer) {
    return HiddenFromNearer(ViewOf(map), kMiddle, kRadius_m, nearer);
  };
  const double sigma_m = 0.04, share = 0.4;
  ElevationMap noise = MapThatShows(0, sigma_m, share), rough = noise;
  rough.narrow.noise_m = GridF(82, 82, static_cast<float>(sigma_m / std::sqrt(2)));
  for (const double nearer : {1.0, 0.7, 0.5}) {
    SCOPED_TRACE(nearer);
    // q of bare ground, both sides: a thing of the limit's size shows nothing of itself.
    const auto of = [&](double then_m) {
      const double r = 1.2 * kLimit_m * share;
      const double places = M_PI * std::pow(kRadius_m / 0.15, 2) * 4;
      return places * kThingsPer_m2 * 0.15 * 0.15 / 4 * std::exp(-r * r / (2 * then_m * then_m));
    };
    const double then_m = nearer * nearer * sigma_m;
    EXPECT_NEAR(from(noise, nearer), of(then_m), 0.02 * of(then_m));
    // Half of its variance is the ground's own.
    const double rough_m = std::sqrt((sigma_m * sigma_m + then_m * then_m) / 2);
    EXPECT_NEAR(from(rough, nearer), of(rough_m), 0.02 * of(rough_m));
  }
  // What shows now says nothing of then; what is unknown is as the rest.
  const double bare = from(noise, 0.5);
  ElevationMap marked = Marked(noise, 0.03);
  EXPECT_DOUBLE_EQ(from(marked, 0.5), bare);
  for (int row = 0; row < 2 * kMiddle.row; ++row) {
    for (int col = 0; col < 82; ++col) {
      marked.narrow.prominence_m.at(row, col) = std::nanf("");
    }
  }
  EXPECT_NEAR(from(marked, 0.5) / bare, 1, 1e-6);
  EXPECT_TRUE(std::isinf(from(MapThatShows(NAN, NAN, NAN), 0.5)));
}

}  // namespace
}  // namespace palace
