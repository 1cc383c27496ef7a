// What an experiment says of its shares and of what was asked of it.
#include "engine/report/experiment_report.h"

#include <gmock/gmock.h>

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "engine/report/figure_text.h"

namespace palace {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// Wilson's formula worked by hand for 9 of 10: 0.59585 to 0.98212.
TEST(FigureText, AShareHasItsInterval) {
  EXPECT_EQ(ShareText(9, 10), "9 of 10 (60 to 98 %)");
  EXPECT_EQ(ShareText(9, 10, 1), "9 of 10 (59.6 to 98.2 %)");
  EXPECT_EQ(ShareText(0, 0), "-");
}

TEST(FigureText, TheMedianAndTheWorstOfWhatIsKnown) {
  EXPECT_EQ(MedianAndWorst(std::vector<double>{3, NAN, 1, 2.25}, 1), "2.2 / 3.0");
  EXPECT_EQ(MedianAndWorst(std::vector<double>{NAN}, 1), "- / -");
}

TEST(ExperimentReport, OneThingNotMetFailsItAndIsTold) {
  ExperimentReport report{HtmlPage("page")};
  report.Judge(true, "first");
  EXPECT_TRUE(report.passed);
  report.Judge(false, "second");
  report.Judge(true, "third");
  EXPECT_FALSE(report.passed);
  EXPECT_THAT(report.lines, ElementsAre("passed: first", "FAILED: second", "passed: third"));
  EXPECT_THAT(report.page.Text(), HasSubstr("<p class=\"fail\">second (not met)</p>"));
  EXPECT_THAT(report.page.Text(), HasSubstr("<p class=\"pass\">third</p>"));
}

}  // namespace
}  // namespace palace
