// The experiment on approach headings: what it judges, that it can fail, and that shards merge.
#include <gtest/gtest.h>

#include "engine/experiments/evaluate_heading.h"
#include "engine/experiments/heading_case.h"
#include "engine/experiments/heading_reference.h"
#include "tests/support/experiment_run.h"

namespace palace {
namespace {

TEST(EvaluateHeading, TheReferenceInClosedForm) {
  constexpr double kWorst = 0.25 / 3, kBest = 1 - 0.25 / 3;
  HeadingConditions now;
  now.wind_from_rad = 0;
  const struct {
    double wind_mps, heading_deg, wind;
  } table[] = {{1, 180, kBest}, {5, 90, 0.5}, {5, 180, 0.25}, {12, 0, kBest}, {12, 180, kWorst}};
  for (const auto& row : table) {
    now.wind_mps = row.wind_mps;
    EXPECT_NEAR(ScoreByReference(now, Rad(row.heading_deg)).wind, row.wind, kReferenceTolerance);
  }
  EXPECT_EQ(ScoreByReference({}, 1).combined, 1) << "nothing is known";
}

TEST(EvaluateHeading, DrawnCasesKeepWhatIsPromised) {
  int flown = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    const HeadingCase drawn = DrawnHeadingCase(seed, 2.5);
    EXPECT_FALSE(drawn.flies_blocked);
    EXPECT_TRUE(drawn.agrees);
    EXPECT_LE(drawn.curve_error, kReferenceTolerance);
    if (std::isfinite(drawn.over_limit_mps)) {
      EXPECT_LE(drawn.over_limit_mps, kTailwindOfNearest * drawn.conditions.wind_mps);
      ++flown;
    }
  }
  EXPECT_GT(flown, 30);
}

TEST(EvaluateHeading, TheSevenListedCasesComeOut) {
  const std::vector<HeadingCase> listed = ListedHeadingCases();
  ASSERT_EQ(listed.size(), 7u);
  for (const HeadingCase& one : listed) {
    EXPECT_TRUE(one.agrees) << one.name << ", " << Deg(one.heading_rad);
  }
}

TEST(EvaluateHeading, TheReportFailsForEachPromiseThatIsBroken) {
  const Experiment experiment = HeadingExperiment();
  const TrialFile file = RunExperimentTrials(experiment, 1, 8);
  EXPECT_TRUE(experiment.report(file.table).passed);
  const struct {
    const char *column, *text;
  } table[] = {
      {"flies_blocked", "1"}, {"over_limit_mps", "2"}, {"curve_error", "0.01"}, {"agrees", "0"}};
  for (const auto& broken : table) {
    TrialTable changed = file.table;
    changed.rows[0][changed.Index(broken.column)] = broken.text;
    EXPECT_FALSE(experiment.report(changed).passed) << broken.column;
  }
}

TEST(EvaluateHeading, ShardsMergeToTheByte) { ExpectShardsMerge(HeadingExperiment(), 7, 5, 3); }

}  // namespace
}  // namespace palace
