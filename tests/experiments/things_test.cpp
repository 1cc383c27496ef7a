// Fields of things, and pictures that are kept: that the field holds what it says it holds.
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>

#include <CLI/CLI.hpp>
#include <gtest/gtest.h>

#include "engine/experiments/evaluate_things.h"
#include "engine/experiments/kept_pictures.h"
#include "engine/experiments/thing_field.h"
#include "engine/world/ground_truth.h"
#include "tests/support/own_path.h"

namespace palace {
namespace {

TEST(ThingField, EveryThingIsThereAndAsHighOrDeepAsSaid) {
  const struct {
    ThingKind kind;
    double low_m, high_m;  ///< of the largest deviation from the ground around
  } cases[] = {{ThingKind::kHole, -0.21, -0.18}, {ThingKind::kRock, 0.12, 0.19},
               {ThingKind::kKerb, 0.13, 0.17},   {ThingKind::kPost, 0.75, 1.25},
               {ThingKind::kBush, 0.2, 0.6},     {ThingKind::kSlab, 0.13, 0.17}};
  for (const auto& each : cases) {
    SCOPED_TRACE(NameOf(each.kind));
    const ThingField field = MakeThingField(each.kind, 1, 3);
    ASSERT_GT(field.places_m.size(), 100U);
    for (std::size_t i = 0; i < field.places_m.size(); i += 17) {
      const Eigen::Vector2d& p = field.places_m[i];
      const double reach_m = field.reach_m + 0.3;
      const GroundTruth truth = TruthOf(field.world, {.north_min_m = p.x() - reach_m,
                                                      .north_max_m = p.x() + reach_m,
                                                      .east_min_m = p.y() - reach_m,
                                                      .east_max_m = p.y() + reach_m});
      const double ground_m = double(truth.height_m.at(0, 0));
      double off_m = 0;
      for (int r = 0; r < truth.geometry.rows; ++r) {
        for (int c = 0; c < truth.geometry.cols; ++c) {
          const double h = double(truth.height_m.at(r, c)) - ground_m;
          off_m = std::abs(h) > std::abs(off_m) ? h : off_m;
          const double away_m =
              std::hypot(truth.geometry.NorthOfRow(r) - p.x(), truth.geometry.EastOfCol(c) - p.y());
          ASSERT_TRUE(std::abs(h) < 0.07 || away_m < field.reach_m + 0.04) << away_m << ' ' << h;
        }
      }
      EXPECT_GT(off_m, each.low_m);
      EXPECT_LT(off_m, each.high_m);
    }
  }
}

TEST(ThingField, BareGroundHoldsNothing) {
  const ThingField field = MakeThingField(ThingKind::kNone, 1, 3);
  EXPECT_TRUE(field.places_m.empty());
  EXPECT_TRUE(field.world.solids.empty());
}

TEST(Things, AKindIsChosenByItsNameAndToldWithTheResults) {
  const Experiment things = ThingsExperiment();
  CLI::App verb;
  things.add_options(verb);
  const std::string of_all = things.setup();
  verb.parse("--kind rock --kind none");
  EXPECT_EQ(things.setup(), of_all + ", only rock, none");
  try {
    verb.parse("--kind boulder");
    FAIL() << "there is no such kind";
  } catch (const CLI::ValidationError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("no kind is called \"boulder\"; known: none, "));
  }
}

TEST(KeptPictures, AreDrawnOnceAndOnlyOfTheirSize) {
  const std::filesystem::path dir = OwnPath();
  int drawn = 0;
  const auto draw = [&] {
    ++drawn;
    return ImageU8(8, 6, static_cast<std::uint8_t>(40 + drawn));
  };
  for (int run = 0; run < 2; ++run) {
    KeptPictures kept(dir, "rocks-1-8m");
    for (const int level : {41, 42}) {
      const Result<ImageU8> picture = kept.Next(8, 6, draw);
      ASSERT_TRUE(picture.ok()) << picture.error().message;
      EXPECT_EQ(picture->at(3, 3), level);
    }
  }
  EXPECT_EQ(drawn, 2);
  const Result<ImageU8> other = KeptPictures(dir, "rocks-1-8m").Next(9, 6, draw);
  ASSERT_FALSE(other.ok());
  EXPECT_NE(other.error().message.find("8x6 pixels, the field has 9x6"), std::string::npos);
  std::ofstream(dir / "rocks-1-8m" / "000.png") << "no picture";
  EXPECT_FALSE(KeptPictures(dir, "rocks-1-8m").Next(8, 6, draw).ok());
  EXPECT_EQ(drawn, 2);
}

}  // namespace
}  // namespace palace
