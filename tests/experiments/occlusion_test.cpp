// What comes between camera and point, what is said of a track that it struck, and that shards
// join.
#include <gmock/gmock.h>

#include <cmath>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <gtest/gtest.h>

#include "engine/experiments/evaluate_occlusion.h"
#include "engine/experiments/film_ground.h"
#include "engine/experiments/occluder.h"
#include "engine/experiments/point_film.h"
#include "engine/experiments/point_methods.h"
#include "tests/experiments/short_films.h"
#include "tests/support/experiment_run.h"

namespace palace {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

/// 100 pictures, right and told as good; struck from 20 to 29.
FollowedFilm Struck() { return {std::vector<double>(100, 1), std::vector<bool>(100, true)}; }
constexpr int kFirst = 20, kClear = 30;
constexpr int kShadowFrom = 78;
constexpr int kFewestPictures = 77;  // one before, 1.5 s of shadow, one clear and a second after it

TEST(Occlusion, OfATrackThatSawItAndFoundThePointAgain) {
  FollowedFilm film = Struck();
  for (std::size_t i = 22; i < 35; ++i) {
    film.error_px[i] = 80;
    film.followed[i] = false;
  }
  const Occlusion told = JudgeOcclusion(film, kFirst, kClear);
  EXPECT_TRUE(told.right_before);
  EXPECT_EQ(told.told_after, 2);
  EXPECT_EQ(told.wrong_as_good, 0);
  EXPECT_EQ(told.worst_as_good_px, 1);
  EXPECT_EQ(told.found_after, 5);
  EXPECT_EQ(told.error_after_px, 1);
  EXPECT_TRUE(told.good_after);
  EXPECT_EQ(told.longest_told_lost, 13);
}

TEST(Occlusion, OfATrackThatWentAwayWithTheBird) {
  FollowedFilm film = Struck();
  for (std::size_t i = 22; i < 100; ++i) {
    film.error_px[i] = 40;
  }
  const Occlusion told = JudgeOcclusion(film, kFirst, kClear);
  EXPECT_EQ(told.told_after, -1);
  EXPECT_EQ(told.wrong_as_good, 78);
  EXPECT_EQ(told.worst_as_good_px, 40);
  EXPECT_EQ(told.found_after, -1);
  EXPECT_EQ(told.longest_told_lost, 0);
}

TEST(Occlusion, WhatWasWrongBeforeIsSaidToBe) {
  FollowedFilm film = Struck();
  film.error_px[19] = 6;
  EXPECT_FALSE(JudgeOcclusion(film, kFirst, kClear).right_before);
  film.error_px[19] = 4;
  film.followed[19] = false;
  EXPECT_FALSE(JudgeOcclusion(film, kFirst, kClear).right_before);
}

TEST(Occluder, CoversThePointHalfWay) {
  const Eigen::Vector2d pixel(300, 220);
  const struct {
    OccluderKind kind;
    double low, high;  ///< grey at the point, of 200
  } table[] = {{OccluderKind::kNone, 200, 200},
               {OccluderKind::kBird, 15, 45},
               {OccluderKind::kHand, 110, 185},
               {OccluderKind::kShadow, 99, 101},
               {OccluderKind::kBlack, 0, 20}};
  for (const auto& row : table) {
    for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
      ImageF grey(640, 480, 200);
      const Occluder occluder(row.kind, seed);
      occluder.Paint(occluder.pictures() / 2, pixel, grey);
      EXPECT_GE(grey.at(300, 220), row.low) << NameOf(row.kind);
      EXPECT_LE(grey.at(300, 220), row.high) << NameOf(row.kind);
    }
  }
}

TEST(Occluder, ABirdAndAShadowComeFromBesideThePoint) {
  const Eigen::Vector2d pixel(300, 220);
  for (const OccluderKind kind : {OccluderKind::kBird, OccluderKind::kShadow}) {
    for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
      const Occluder occluder(kind, seed);
      for (const int picture : {0, occluder.pictures() - 1}) {
        ImageF grey(640, 480, 200);
        occluder.Paint(picture, pixel, grey);
        EXPECT_EQ(grey.at(300, 220), 200) << NameOf(kind);
      }
    }
  }
}

/// Half of the light goes for 1.5 s: keyframes that are cut meanwhile hold on to the shadow's edge.
/// With the newest keyframe alone the ground was not found again on this film.
TEST(PlaneTracker, FindsTheGroundAgainByAnEarlierKeyframeWhenAShadowHasPassed) {
  constexpr std::uint64_t kSeed = 3;
  FilmGroundOptions options;
  options.materials = {"asphalt"};
  const Result<FilmGround> ground = GroundOfTrial(options, 0, kSeed);
  ASSERT_TRUE(ground) << ground.error().message;
  FilmOptions hover = ground->film;
  hover.flight = FilmFlight::kHover;
  const PointFilm film(ground->ground, hover, kSeed);
  const Occluder shadow(OccluderKind::kShadow, kSeed);
  const int last = kShadowFrom + shadow.pictures() + 15;
  ImageF grey = film.Grey(0);
  const FollowPoint follow =
      StartFollowing(PointMethod::kPlane, film, Exposed(grey, film.Noise(0)));
  PointReading reading;
  int lost = 0;
  for (int i = 1; i <= last; ++i) {
    grey = film.Grey(i);
    if (i >= kShadowFrom && i < kShadowFrom + shadow.pictures()) {
      shadow.Paint(i - kShadowFrom, film.Truth(i), grey);
    }
    reading = follow(Exposed(grey, film.Noise(i)), i);
    lost += reading.followed ? 0 : 1;
    if (reading.followed) {
      EXPECT_LT((reading.pixel - film.Truth(i)).norm(), 5) << i;
    }
  }
  EXPECT_GT(lost, 0) << "nothing was to be found again";
  EXPECT_TRUE(reading.followed);
}

TEST(OcclusionExperiment, ShardsJoinToTheByte) {
  ExpectShardsMerge(OcclusionExperiment(ShortAndSmall(kFewestPictures)), 7, 2, 2);
}

TEST(OcclusionExperiment, FilmsTooShortForTheLongestAreRefusedAtOnce) {
  const Experiment experiment = OcclusionExperiment();
  for (const int pictures : {kFewestPictures, kFewestPictures - 1}) {
    CLI::App verb;
    experiment.add_options(verb);
    const std::string line = "--pictures " + std::to_string(pictures);
    if (pictures == kFewestPictures) {
      EXPECT_NO_THROW(verb.parse(line));
    } else {
      EXPECT_THROW(verb.parse(line), CLI::ValidationError);
    }
  }
}

/// Films of one flight, each with every occluder, all followed as is asked.
TrialTable GoodFilms(const Experiment& experiment, int films) {
  TrialTable table = EmptyTable(experiment);
  for (int trial = 0; trial < films; ++trial) {
    for (const OccluderKind kind : kAllOccluders) {
      std::vector<std::string>& row = table.rows.emplace_back(table.columns.size(), "0");
      const auto set = [&](const char* column, const std::string& text) {
        row[table.Index(column)] = text;
      };
      set("trial", std::to_string(trial));
      set("ground", "grass");
      set("flight", "hover");
      set("occluder", NameOf(kind));
      set("method", "plane");
      set("right_before", "1");
      set("good_after", "1");
      set("error_after_px", "5");
    }
  }
  return table;
}

TEST(OcclusionReport, EveryPromiseCanBeBrokenByOneTrack) {
  const Experiment experiment = OcclusionExperiment();
  const TrialTable good = GoodFilms(experiment, 3);
  EXPECT_TRUE(experiment.report(good).passed);
  const struct {
    const char *occluder, *column, *text, *told;
  } table[] = {
      {"shadow", "good_after", "0",
       "FAILED: plane: found again within 1 s and 5 px after all of "
       "them in 2 of 3"},
      {"hand", "error_after_px", "5.1", "after all of them in 2 of 3"},
      {"bird", "wrong_as_good", "1",
       "FAILED: plane: a wrong place told as good after any of them "
       "in 1 of 3"},
      {"black", "right_before", "0",
       "FAILED: plane: told as good and right when it began, for all "
       "of bird, hand, shadow, black, in 2 of 3"},
      {"none", "right_before", "0",
       "FAILED: plane, where nothing came: right and told as good in "
       "2 of 3"},
      {"none", "wrong_as_good", "1", "FAILED: plane, where nothing came"},
  };
  for (const auto& broken : table) {
    TrialTable changed = good;
    for (auto& row : changed.rows) {
      if (row[changed.Index("trial")] == "1" && row[changed.Index("occluder")] == broken.occluder) {
        row[changed.Index(broken.column)] = broken.text;
      }
    }
    const ExperimentReport report = experiment.report(changed);
    EXPECT_FALSE(report.passed) << broken.column;
    EXPECT_THAT(report.lines, Contains(HasSubstr(broken.told)));
  }
}

/// A film that nothing struck says nothing of what strikes.
TEST(OcclusionReport, TheVerdictStandsWithoutFilmsThatNothingStruck) {
  const Experiment experiment = OcclusionExperiment();
  TrialTable table = GoodFilms(experiment, 5);
  const char* found =
      "passed: plane: found again within 1 s and 5 px after all of them in 5 of 5 (";
  EXPECT_THAT(experiment.report(table).lines, Contains(HasSubstr(found)));
  const ExperimentReport struck = experiment.report(table.WhereNot("occluder", "none"));
  EXPECT_TRUE(struck.passed);
  EXPECT_THAT(struck.lines, Contains(HasSubstr(found)));
  EXPECT_FALSE(experiment.report(table.Where("occluder", "none")).passed);
}

TEST(OcclusionReport, ADescentAndAHoverAreTwoFilms) {
  const Experiment experiment = OcclusionExperiment();
  TrialTable table = GoodFilms(experiment, 2);
  for (std::vector<std::string> row : GoodFilms(experiment, 2).rows) {
    row[table.Index("flight")] = "descent";
    table.rows.push_back(row);
  }
  EXPECT_THAT(experiment.report(table).lines, Contains(HasSubstr("after all of them in 4 of 4 (")));
}

}  // namespace
}  // namespace palace
