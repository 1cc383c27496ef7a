#include <gmock/gmock.h>

#include <gtest/gtest.h>

#include "engine/experiments/evaluate_families.h"
#include "engine/experiments/landing_truth.h"
#include "engine/report/trial_table.h"

namespace palace {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

constexpr TruthLimits kLimits{.slope_deg = 10, .deviation_m = 0.10, .step_m = 0.15};

DiscTruth Ground(double slope_deg, double deviation_m, double step_m, double water_share = 0,
                 double moving_share = 0) {
  return {.known = true,
          .slope_deg = slope_deg,
          .deviation_m = deviation_m,
          .step_m = step_m,
          .water_share = water_share,
          .moving_share = moving_share};
}

TEST(MissionOutcomes, ALandingIsJudgedByTheGroundUnderIt) {
  const struct {
    const char* what;
    std::optional<DiscTruth> under;
    MissionOutcome outcome;
  } table[] = {
      {"flat", Ground(0, 0, 0), MissionOutcome::kLandedRight},
      {"on every limit", Ground(10, 0.10, 0.15), MissionOutcome::kLandedRight},
      {"within a fifth more", Ground(11.9, 0.119, 0.179), MissionOutcome::kLandedRight},
      {"too steep", Ground(12.1, 0, 0), MissionOutcome::kLandedOnHazard},
      {"too rough", Ground(0, 0.121, 0), MissionOutcome::kLandedOnHazard},
      {"a kerb", Ground(0, 0, 0.181), MissionOutcome::kLandedOnHazard},
      {"a drop of water", Ground(0, 0, 0, 0.001), MissionOutcome::kLandedOnHazard},
      {"somebody's foot", Ground(0, 0, 0, 0, 0.001), MissionOutcome::kLandedOnHazard},
      {"off the grid", DiscTruth{}, MissionOutcome::kLandedOnHazard},
      {"nobody knows", std::nullopt, MissionOutcome::kLandedOnHazard},
  };
  for (const auto& row : table) {
    EXPECT_EQ(OutcomeOf(MissionState::kLanded, true, row.under, kLimits), row.outcome) << row.what;
  }
}

TEST(MissionOutcomes, WithoutALandingTheLastStateTells) {
  const auto outcome = [](MissionState last, bool approved) {
    return OutcomeOf(last, approved, std::nullopt, kLimits);
  };
  EXPECT_EQ(outcome(MissionState::kHold, true), MissionOutcome::kHeld);
  EXPECT_EQ(outcome(MissionState::kAborting, true), MissionOutcome::kAborted);
  EXPECT_EQ(outcome(MissionState::kSearch, false), MissionOutcome::kRefused);
  EXPECT_EQ(outcome(MissionState::kProposed, false), MissionOutcome::kRefused);
  EXPECT_EQ(outcome(MissionState::kArmed, false), MissionOutcome::kRefused);
  EXPECT_EQ(outcome(MissionState::kDescending, true), MissionOutcome::kUnfinished);
  EXPECT_EQ(outcome(MissionState::kProposed, true), MissionOutcome::kHeld);
  EXPECT_EQ(outcome(MissionState::kArmed, true), MissionOutcome::kHeld);
}

TEST(MissionOutcomes, AVehicleThatStruckSomethingDidWhateverTheStationSays) {
  for (const MissionState last :
       {MissionState::kSearch, MissionState::kDescending, MissionState::kHold}) {
    EXPECT_EQ(OutcomeOf(last, true, Ground(0, 0, 6.4), kLimits), MissionOutcome::kLandedOnHazard);
    EXPECT_NE(OutcomeOf(last, true, Ground(0, 0, 0), kLimits), MissionOutcome::kLandedOnHazard);
  }
}

TEST(FamiliesReport, CountsByFamilyAndFailsOnAHazard) {
  const Experiment experiment = FamiliesExperiment(nullptr);
  TrialTable table{.columns = {"trial", "seed"}, .rows = {}};
  table.columns.insert(table.columns.end(), experiment.columns.begin(), experiment.columns.end());
  const auto add = [&](const std::string& family, MissionOutcome outcome, const std::string& site) {
    std::vector<std::string> row(table.columns.size(), "nan");
    row[table.Index("family")] = family;
    row[table.Index("outcome")] = MissionOutcomeName(outcome);
    row[table.Index("site_truth")] = site;
    table.rows.push_back(row);
  };
  for (int i = 0; i < 7; ++i) {
    add("rocks", MissionOutcome::kLandedRight, "within");
  }
  add("rocks", MissionOutcome::kRefused, "none");
  EXPECT_TRUE(experiment.report(table).passed);
  add("kerbs", MissionOutcome::kLandedOnHazard, "far_over");
  const ExperimentReport report = experiment.report(table);
  EXPECT_FALSE(report.passed);
  EXPECT_THAT(report.lines, Contains("rocks: landed_right 7 refused 1"));
  EXPECT_THAT(report.lines, Contains("kerbs: landed_on_hazard 1"));
  // Wilson, 95 %: 1 of 8.
  EXPECT_THAT(report.lines, Contains(HasSubstr("all landings: 1 of 8 (2 to 47 %)")));
  EXPECT_THAT(report.page.Text(), HasSubstr("7 of 8 (53 to 98 %)"));
}

}  // namespace
}  // namespace palace
