// Plots and pages are text: what a reader must find in them, and that nothing not finite gets in.
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "engine/core/random.h"
#include "engine/report/html_page.h"
#include "engine/report/statistics.h"
#include "engine/report/svg_axes.h"
#include "engine/report/svg_plot.h"

namespace palace {
namespace {

const double kNan = std::numeric_limits<double>::quiet_NaN();

int Count(const std::string& text, const std::string& part) {
  int count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

// Figures from Wilson's formula worked by hand for 10 of 10 and 9 of 10 (z = 1.959964).
TEST(Statistics, WilsonIntervalKnowsSmallSamples) {
  EXPECT_NEAR(WilsonInterval(10, 10).low, 0.72246, 1e-5);
  EXPECT_DOUBLE_EQ(WilsonInterval(10, 10).high, 1);
  EXPECT_NEAR(WilsonInterval(9, 10).low, 0.59585, 1e-5);
  EXPECT_NEAR(WilsonInterval(9, 10).high, 0.98212, 1e-5);
  EXPECT_NEAR(WilsonInterval(0, 1000).high, 0.0038268, 1e-6);
  EXPECT_TRUE(std::isnan(WilsonInterval(0, 0).low));
}

TEST(Statistics, NothingIsNanAndNanDoesNotCount) {
  EXPECT_TRUE(std::isnan(SpreadOf({}).mean));
  EXPECT_TRUE(std::isnan(Percentile({}, 0.5)));
  const std::vector<double> values = {kNan, 1, 3, 2, kNan, 4};
  const Spread spread = SpreadOf(values);
  EXPECT_EQ(spread.count, 4);
  EXPECT_DOUBLE_EQ(spread.mean, 2.5);
  EXPECT_DOUBLE_EQ(spread.sd, std::sqrt(5.0 / 3));
  EXPECT_DOUBLE_EQ(spread.rms, std::sqrt(7.5));
  EXPECT_DOUBLE_EQ(Percentile(values, 0), 1);
  EXPECT_DOUBLE_EQ(Percentile(values, 0.5), 2.5);
  EXPECT_DOUBLE_EQ(Percentile(values, 1), 4);
}

TEST(Statistics, MeanIntervalHoldsTheTruthNineteenTimesInTwenty) {
  RandomStream random(7);
  int inside = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    std::vector<double> values;
    for (int i = 0; i < 100; ++i) {
      values.push_back(3 + 2 * random.Normal());
    }
    const Interval interval = MeanInterval(values);
    inside += interval.low <= 3 && 3 <= interval.high ? 1 : 0;
  }
  EXPECT_GT(inside, 925) << "seed 7";
  EXPECT_LT(inside, 975) << "seed 7";
}

TEST(Statistics, MeanIntervalOfFewIsWideByStudent) {
  // Tables of t: 12.706, 4.3027, 2.5706, 2.2622, 2.0930 for 1, 2, 5, 9, 19 degrees of freedom.
  const struct {
    int count;
    double t;
  } table[] = {{2, 12.7062}, {3, 4.3027}, {6, 2.5706}, {10, 2.2622}, {20, 2.0930}};
  for (const auto& row : table) {
    std::vector<double> values;
    for (int i = 0; i < row.count; ++i) {
      values.push_back(i * i);
    }
    const Spread spread = SpreadOf(values);
    const Interval interval = MeanInterval(values);
    const double error = spread.sd / std::sqrt(row.count);
    EXPECT_NEAR((interval.high - spread.mean) / error, row.t, 5e-4) << row.count;
    EXPECT_NEAR((spread.mean - interval.low) / error, row.t, 5e-4) << row.count;
  }
  EXPECT_TRUE(std::isnan(MeanInterval(std::vector<double>{1}).low));
}

TEST(Axes, TicksAreRoundAndInside) {
  EXPECT_EQ(RoundTicks(0, 1, false, 5), (std::vector<double>{0, 0.2, 0.4, 0.2 * 3, 0.8, 1}));
  EXPECT_EQ(RoundTicks(-7, 13, false, 4).front(), -5);
  EXPECT_EQ(RoundTicks(1, 100, true, 5), (std::vector<double>{1, 2, 5, 10, 20, 50, 100}));
  EXPECT_EQ(RoundTicks(0, 2, false, 8, /*whole=*/true), (std::vector<double>{0, 1, 2}));
  EXPECT_TRUE(RoundTicks(0, 10, true, 5).empty());
  EXPECT_TRUE(RoundTicks(1, 1, false, 5).empty());
  EXPECT_TRUE(RoundTicks(0, kNan, false, 5).empty());
}

TEST(LinePlot, NanBreaksTheLineAndNeverReachesTheText) {
  LinePlot plot{
      "Height", "range, ft", "error, cm", {{"ours", {1, 2, 3, 4, 5}, {1, 2, kNan, 2, 1}}}};
  const std::string svg = LinePlotSvg(plot);
  EXPECT_EQ(Count(svg, "<polyline"), 2);
  EXPECT_EQ(Count(svg, "<circle"), 4);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
  for (const char* text : {"Height", "range, ft", "error, cm", "ours"}) {
    EXPECT_NE(svg.find(text), std::string::npos) << text;
  }
}

TEST(LinePlot, NothingToDrawIsSaid) {
  EXPECT_NE(LinePlotSvg({"Empty", "x", "y", {}}).find("no data to draw"), std::string::npos);
  EXPECT_NE(LinePlotSvg({"Empty", "x", "y", {{"s", {1}, {kNan}}}}).find("no data to draw"),
            std::string::npos);
  EXPECT_NE(
      HeatMapSvg({"Empty", "x", "y", "v", GridF(2, 2, kUnknownValue)}).find("no data to draw"),
      std::string::npos);
}

TEST(LinePlot, AConstantSeriesStillHasAnAxis) {
  const std::string svg = LinePlotSvg({"Flat", "x", "y", {{"s", {1, 2}, {5, 5}}}});
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(Count(svg, "<circle"), 2);
}

TEST(HeatMap, UnknownCellsAreHatchedNotColoured) {
  GridF cells(2, 3, 1.0F);
  cells.at(0, 1) = kUnknownValue;
  cells.at(1, 2) = 4;
  const std::string svg = HeatMapSvg({"Coverage", "column", "row", "dots", cells});
  EXPECT_EQ(Count(svg, "<path class=\"g\""), 1);
  EXPECT_EQ(Count(svg, ">1.00<"), 4);
  EXPECT_EQ(Count(svg, ">4.00<"), 1);
}

TEST(VectorPlot, EveryFiniteArrowIsDrawnBesideAScale) {
  VectorPlot plot;
  plot.title = "Residuals";
  plot.arrows = {{10, 10, 0.1, 0.2}, {600, 400, kNan, 0}};
  EXPECT_EQ(Count(VectorPlotSvg(plot), "<path"), 2);  // one arrow and the scale
}

TEST(HtmlPage, TextsAreEscaped) {
  HtmlPage page("a<b");
  page.Heading("x & y").Table({"value"}, {{"<script>"}}).Verdict(false, "row error 0.3 px");
  const std::string text = page.Text();
  EXPECT_EQ(text.find("<script>"), std::string::npos);
  EXPECT_NE(text.find("a&lt;b"), std::string::npos);
  EXPECT_NE(text.find("x &amp; y"), std::string::npos);
  EXPECT_NE(text.find("not met"), std::string::npos);
}

}  // namespace
}  // namespace palace
