// What `evaluate ground` counts: a site's truth on surfaces in closed form, what is in view, and
// how the table is read. It does not prove that SLAD is right; the experiment asks that.
#include <gmock/gmock.h>

#include <cmath>

#include <gtest/gtest.h>

#include "engine/core/units.h"
#include "engine/experiments/evaluate_ground.h"
#include "engine/experiments/ground_field.h"
#include "engine/experiments/ground_report.h"
#include "engine/report/trial_table.h"

namespace palace {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using Verdict = SiteTruth::Verdict;

constexpr TruthLimits kLimits{.slope_deg = 10, .deviation_m = 0.10, .step_m = 0.15};

World Sloped(double slope_deg) {
  World world;
  world.ground.rise_north = std::tan(Rad(slope_deg));
  return world;
}

TEST(SiteTruth, IsTheWorstTouchdownWithinTheNavigationError) {
  const Lander lander;  // radius 1.8 m, navigation error 0.5 m
  for (const double slope_deg : {0.0, 9.9, 11.9, 14.9, 15.2}) {
    const SiteTruth truth = TruthOfSite(Sloped(slope_deg), {3, 1}, lander, kLimits, 0);
    EXPECT_NEAR(truth.worst_of_limit, slope_deg / 10, 0.01);
    EXPECT_EQ(truth.verdict(), slope_deg < 10   ? Verdict::kWithin
                               : slope_deg < 12 ? Verdict::kOver
                               : slope_deg < 15 ? Verdict::kUnsafe
                                                : Verdict::kGrosslyUnsafe);
  }
  const struct {
    double away_m, height_m;
    Verdict verdict;
  } boxes[] = {{1.0, 0.3, Verdict::kGrosslyUnsafe},
               {2.2, 0.3, Verdict::kGrosslyUnsafe},  // only a touchdown off the middle meets it
               {2.6, 0.3, Verdict::kWithin},
               {2.0, 0.11, Verdict::kOver},
               {2.0, 0.08, Verdict::kWithin}};
  for (const auto& box : boxes) {
    SCOPED_TRACE(box.away_m);
    World world;
    world.solids = {MakeBox(3 + box.away_m, 1, 0.2, 0.2, box.height_m)};
    EXPECT_EQ(TruthOfSite(world, {3, 1}, lander, kLimits, 0).verdict(), box.verdict);
  }
}

TEST(SeesSafeDisc, AsksForOneThatIsWholeInBothPictures) {
  ViewPlan plan;
  plan.height_m = 15;
  plan.tilt_rad = -Rad(90);
  plan.camera = {640, 480, 554, 554, 319.5, 239.5};  // shows 17 by 13 m of ground
  EXPECT_TRUE(SeesSafeDisc(Sloped(0), plan, 2.6, kLimits, 1));
  EXPECT_TRUE(SeesSafeDisc(Sloped(8), plan, 2.6, kLimits, 1));
  EXPECT_FALSE(SeesSafeDisc(Sloped(8), plan, 2.6, kLimits, 0.6)) << "not an easy one";
  EXPECT_FALSE(SeesSafeDisc(Sloped(0), plan, 6.6, kLimits, 1)) << "wider than the picture is high";
  plan.height_m = 5;
  EXPECT_FALSE(SeesSafeDisc(Sloped(0), plan, 2.6, kLimits, 1));
}

TEST(GroundReport, CountsConfirmedAndProvisionalApartAndFailsOnAGrossOne) {
  const Experiment experiment = GroundExperiment();
  TrialTable table{.columns = {"trial", "seed"}, .rows = {}};
  table.columns.insert(table.columns.end(), experiment.columns.begin(), experiment.columns.end());
  const auto add = [&](const char* family, const char* rank, const char* kind, const char* verdict,
                       const char* by = kByPalace) {
    std::vector<std::string> row(table.columns.size(), "nan");
    row[table.Index("by")] = by;
    row[table.Index("family")] = family;
    row[table.Index("height_m")] = "15";
    row[table.Index("safe_in_view")] = row[table.Index("easy_in_view")] = "1";
    row[table.Index("rank")] = rank;
    row[table.Index("kind")] = kind;
    row[table.Index("verdict")] = verdict;
    table.rows.push_back(row);
  };
  add("rocks", "1", "confirmed", "within");
  add("rocks", "2", "confirmed", "over");
  add("rocks", "3", "confirmed", "unsafe");
  add("rocks", "4", "provisional", "gross");
  add("rocks", "5", "look", "gross");
  add("rocks", "6", "look", "within");
  add("rocks", "1", "place", "gross", "raster");
  add("dunes", "0", "none", "none");
  add("dunes", "1", "place", "within", "raster");
  ExperimentReport report = experiment.report(table);
  EXPECT_TRUE(report.passed);
  EXPECT_THAT(report.lines, Contains(HasSubstr("over a limit: 2 of 3")));
  EXPECT_THAT(report.lines, Contains(HasSubstr("(unsafe): 1 of 3")));
  EXPECT_THAT(report.lines, Contains(HasSubstr("(grossly unsafe): 0 of 3")));
  EXPECT_THAT(report.lines,
              Contains(HasSubstr("Provisional sites over 1.2 times a limit: 1 of 1")));
  EXPECT_THAT(report.lines,
              Contains(HasSubstr("Places to look at first over 1.2 times a limit: 1 of 2")));
  EXPECT_THAT(report.lines,
              Contains(HasSubstr("safe disc in view that are offered a site: 1 of 2")));
  EXPECT_THAT(report.lines,
              Contains(HasSubstr("Best place by raster: over 1.2 times a limit 1 of 2")))
      << "a place of others' counts for nobody else";
  EXPECT_THAT(report.lines,
              Contains(HasSubstr("Best place by palace: over 1.2 times a limit 0 of 1")));
  add("rocks", "1", "confirmed", "gross");
  EXPECT_FALSE(experiment.report(table).passed);
  table.rows.pop_back();
  for (const char* kind : {"confirmed", "provisional", "look"}) {
    add("nowhere", "1", kind, "within");
    EXPECT_FALSE(experiment.report(table).passed) << kind;
    table.rows.pop_back();
  }
  EXPECT_TRUE(experiment.report(table).passed);
}

}  // namespace
}  // namespace palace
