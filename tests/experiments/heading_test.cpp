// The experiment on approach headings: what it judges, that it can fail, and that shards merge.
#include <gmock/gmock.h>

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "engine/experiments/evaluate_heading.h"
#include "engine/experiments/heading_case.h"
#include "engine/experiments/heading_reference.h"
#include "tests/support/experiment_run.h"

namespace palace {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;

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

// A share is of the cases in which what is promised can be broken.
TEST(EvaluateHeading, SharesCountWhatCouldHaveGoneWrong) {
  const Experiment experiment = HeadingExperiment();
  TrialTable table = RunExperimentTrials(experiment, 1, 40).table;
  const TrialTable drawn = table.Where("case", kDrawnCase);
  const std::vector<double> over = drawn.Numbers("over_limit_mps");
  const auto keepable = std::count_if(over.begin(), over.end(), [](double v) { return v == v; });
  const auto flown = drawn.WhereNot("reason", kCourseRefused).rows.size();
  ASSERT_LT(keepable, 40);
  ASSERT_LT(flown, 40u) << "no seed was refused";
  const auto of = [](auto count) { return "0 of " + std::to_string(count) + " ("; };
  ExperimentReport report = experiment.report(table);
  EXPECT_THAT(report.lines, Contains(AllOf(HasSubstr("blocked side"), HasSubstr(of(flown)))));
  EXPECT_THAT(report.lines,
              Contains(AllOf(HasSubstr("the reference leads to"), HasSubstr(of(flown)))));
  EXPECT_THAT(report.lines,
              Contains(AllOf(HasSubstr("Never more tailwind"), HasSubstr(of(keepable)))));
  EXPECT_THAT(report.lines, Contains(HasSubstr("others: 0 of 7")));
  table = table.Where("case", kDrawnCase);
  EXPECT_THAT(experiment.report(table).lines, Contains(HasSubstr("others: 0 of 0")));
}

TEST(EvaluateHeading, ShardsMergeToTheByte) { ExpectShardsMerge(HeadingExperiment(), 7, 5, 3); }

}  // namespace
}  // namespace palace
