// Films with a known point, what is said of a track down one, and that shards join.
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "engine/experiments/evaluate_trackers.h"
#include "engine/experiments/film_ground.h"
#include "engine/experiments/point_film.h"
#include "engine/experiments/point_methods.h"
#include "tests/experiments/short_films.h"
#include "tests/support/experiment_run.h"
#include "tests/support/own_path.h"

namespace palace {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

TEST(GroundPyramid, AStraightSlopeOfGreyIsTheSameAtEveryLevel) {
  const GroundPyramid ground(
      [](double north_m, double east_m) { return 100 + 2 * north_m - 3 * east_m; }, kCoarse);
  for (const float texel_m : {0.04F, 0.05F, 0.11F, 0.3F}) {
    for (const float place_m : {-9.0F, -0.01F, 3.3F}) {
      EXPECT_NEAR(ground.Grey(place_m, 2, texel_m), 94 + 2 * place_m, 2e-3) << texel_m;
    }
  }
  EXPECT_FLOAT_EQ(ground.Grey(1000, 0, 0.04F), 128);
}

TEST(GroundPyramid, CoarserTexelsAreTheMeanOfFinerOnes) {
  const GroundPyramid ground(
      [](double north_m, double east_m) {
        return std::fmod(std::abs(std::floor(north_m / 0.04) + std::floor(east_m / 0.04)), 2) > 0
                   ? 200
                   : 50;
      },
      kCoarse);
  EXPECT_NEAR(ground.Grey(0.02F, 0.02F, 0.04F), 50, 1e-2);
  EXPECT_NEAR(ground.Grey(0.02F, 0.06F, 0.04F), 200, 1e-2);
  EXPECT_NEAR(ground.Grey(0.04F, 0.04F, 0.08F), 125, 1e-2);
}

TEST(PointFilm, ThePointLooksTheSameWhereTheTruthPutsIt) {
  const GroundPyramid ground(
      [](double north_m, double east_m) { return 128 + 2 * north_m + 1.5 * east_m; }, kCoarse);
  for (const FilmFlight flight : {FilmFlight::kDescent, FilmFlight::kHover}) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      FilmOptions options;
      options.flight = flight;
      const PointFilm film(ground, options, seed);
      EXPECT_TRUE(film.selection_refused()) << "nothing there changes in two directions";
      EXPECT_GE(film.motion_px(), 1.9);
      EXPECT_LE(film.motion_px(), 5.1);
      for (const int i : {0, 60, 120, 180, 239}) {
        const Eigen::Vector2d pixel = film.Truth(i);
        const int x = static_cast<int>(std::lround(pixel.x()));
        const int y = static_cast<int>(std::lround(pixel.y()));
        ASSERT_TRUE(x > 40 && x < 600 && y > 40 && y < 440) << i << ": " << pixel.transpose();
        EXPECT_NEAR(film.Grey(i).at(x, y), 128, 0.3) << NameOf(flight) << ' ' << seed << ' ' << i;
      }
    }
  }
}

TEST(PointMethods, AllFollowTheFirstPictures) {
  FilmGroundOptions options = Short(8);
  options.extent.finest_m = 0.02;
  const Result<FilmGround> ground = GroundOfTrial(options, 0, 5);
  ASSERT_TRUE(ground.ok()) << ground.error().message;
  FilmOptions film_options = ground->film;
  film_options.end_m = 45;
  const PointFilm film(ground->ground, film_options, 5);
  std::vector<ImageU8> pictures;
  for (int i = 0; i < film.pictures(); ++i) {
    pictures.push_back(Exposed(film.Grey(i), film.Noise(i)));
  }
  for (const PointMethod method : kAllPointMethods) {
    const FollowPoint follow = StartFollowing(method, film, pictures.front());
    for (int i = 1; i < film.pictures(); ++i) {
      const PointReading reading = follow(pictures[static_cast<std::size_t>(i)], i);
      EXPECT_TRUE(reading.followed) << NameOf(method) << ' ' << i;
      EXPECT_LT((reading.pixel - film.Truth(i)).norm(), 3) << NameOf(method) << ' ' << i;
    }
  }
}

TEST(FilmGround, NamesTheMaterialsThatThereAre) {
  FilmGroundOptions options = Short(2);
  options.materials = {"lava"};
  const Result<FilmGround> ground = GroundOfTrial(options, 0, 1);
  ASSERT_FALSE(ground.ok());
  EXPECT_EQ(ground.error().code, ErrorCode::kUsage);
  EXPECT_THAT(ground.error().message, HasSubstr("'lava'"));
  EXPECT_THAT(ground.error().message, HasSubstr("gravel"));
}

/// Nearer than that its pixels show, and the reports say so.
TEST(FilmGround, ADescentOverAPhotographEndsHigher) {
  const std::filesystem::path file = OwnPath(".png");
  ASSERT_TRUE(cv::imwrite(file.string(), cv::Mat(40, 60, CV_8UC1, cv::Scalar(90))));
  FilmGroundOptions options = Short(2);
  EXPECT_EQ(GroundOfTrial(options, 0, 1)->film.end_m, 4);
  options.photographs = {file.string()};
  const Result<FilmGround> ground = GroundOfTrial(options, 0, 1);
  ASSERT_TRUE(ground) << ground.error().message;
  EXPECT_EQ(ground->film.end_m, 11);
  EXPECT_EQ(DescentText(), "from 45.7 m to 4 m (over photographs to 11 m)");
}

TEST(FollowedFilm, IsLostBeyond15PixelsAndUnseenWhereToldAsGood) {
  const struct {
    std::vector<double> error_px;
    std::vector<bool> followed;
    int first_lost;
    int unseen;
  } table[] = {{{0, 15}, {true, true}, -1, 0},
               {{0, 15.01, 3}, {true, true, true}, 1, 1},
               {{0, 16, 20}, {true, false, true}, 1, 1},
               {{0, 2, 20}, {true, false, false}, 2, 0},
               {{0, NAN}, {true, true}, 1, 1}};
  for (const auto& row : table) {
    const FollowedFilm film{row.error_px, row.followed};
    EXPECT_EQ(FirstLost(film), row.first_lost);
    EXPECT_EQ(UnseenLosses(film), row.unseen);
  }
}

TEST(TrackersExperiment, ShardsJoinToTheByte) {
  ExpectShardsMerge(TrackersExperiment(ShortAndSmall(4)), 7, 2, 2);
}

/// A row of `trackers` that says only what is judged.
void AddTrack(TrialTable& table, const char* method, const char* end_px, const char* lost) {
  std::vector<std::string> row(table.columns.size(), "0");
  row[table.Index("ground")] = "grass";
  row[table.Index("method")] = method;
  row[table.Index("error_end_px")] = end_px;
  row[table.Index("lost_picture")] = lost;
  row[table.Index("told_lost_picture")] = "nan";
  table.rows.push_back(row);
}

TEST(TrackersReport, OnlyOursIsJudged) {
  const Experiment experiment = TrackersExperiment();
  TrialTable table = EmptyTable(experiment);
  for (int i = 0; i < 8; ++i) {
    AddTrack(table, "plane", "4.9", "nan");
    AddTrack(table, "CSRT", "80", "200");
  }
  ExperimentReport report = experiment.report(table);
  EXPECT_TRUE(report.passed);
  // Wilson, 95 %: 0 and 8 of 8.
  EXPECT_THAT(report.lines, Contains(HasSubstr("lost in 0 of 8 (0 to 32 %)")));
  EXPECT_THAT(report.lines, Contains(HasSubstr("CSRT: ")));
  AddTrack(table, "plane", "5.1", "nan");
  report = experiment.report(table);
  EXPECT_FALSE(report.passed);
  EXPECT_THAT(report.lines.back(), HasSubstr("FAILED"));
}

TEST(TrackerCostExperiment, TimesThePlaneAloneAndTheSet) {
  const Experiment experiment = TrackerCostExperiment(ShortAndSmall(3));
  const TrialTable table = RunExperimentTrials(experiment, 7, 1).table;
  for (const char* method : {"plane alone", "set"}) {
    const TrialTable rows = table.Where("method", method);
    ASSERT_EQ(rows.rows.size(), 1u) << method;
    EXPECT_GE(rows.Numbers("median_ms").front(), 0) << method;
  }
}

/// Milliseconds of one film each; the other methods cost what they cost.
TrialTable CostTable(const Experiment& experiment, double plane_ms, double set_ms) {
  TrialTable table = EmptyTable(experiment);
  const auto add = [&table](const char* method, double median_ms) {
    table.rows.push_back({"0", "7", "grass", method, CsvNumber(median_ms), "9", "99"});
  };
  add("plane alone", 1);
  add("plane alone", plane_ms);
  add("set", set_ms);
  add("CSRT", 50);
  return table;
}

TEST(TrackerCostReport, PlaneAndSetAreJudgedByTheirBudgets) {
  const Experiment experiment = TrackerCostExperiment();
  const struct {
    double plane_ms, set_ms;
    bool plane, set;
  } table[] = {{2, 4, true, true}, {2.01, 4, false, true}, {2, 4.01, true, false}};
  for (const auto& row : table) {
    const ExperimentReport report =
        experiment.report(CostTable(experiment, row.plane_ms, row.set_ms));
    EXPECT_EQ(report.passed, row.plane && row.set);
    const auto told = [](bool met) { return std::string(met ? "passed: " : "FAILED: "); };
    EXPECT_THAT(report.lines, Contains(HasSubstr(told(row.plane) + "plane alone: ")));
    EXPECT_THAT(report.lines, Contains(HasSubstr(told(row.set) + "set: ")));
  }
  EXPECT_FALSE(experiment.report(EmptyTable(experiment)).passed) << "nothing was timed";
}

}  // namespace
}  // namespace palace
