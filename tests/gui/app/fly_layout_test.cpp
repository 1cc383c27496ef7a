#include <vector>

#include <gtest/gtest.h>

#include "gui/app/layout.h"

namespace palace {
namespace {

struct SizeRow {
  const char* name;
  double width, height, scale;
  double right_w, left_w, map_side, map_row, picture_row;
  double left_w_px, left_h_px, right_cam_w, vehicle_h, view_w;
  double approve_h, evidence_h;
  int site_rows, site_row_units;
};

class FlyLayoutTable : public testing::TestWithParam<SizeRow> {};

TEST_P(FlyLayoutTable, MatchesTheTableOfTheLook) {
  const SizeRow& row = GetParam();
  const FlyLayout fly = ComputeFlyLayout(row.width, row.height, row.scale, false);
  const double k = row.scale;
  EXPECT_NEAR(fly.sites.w, row.right_w * k, 1);
  EXPECT_NEAR(fly.view_3d.right() - fly.left_camera.x, row.left_w * k, 1);
  EXPECT_NEAR(fly.map_side, row.map_side * k, 1);
  EXPECT_NEAR(fly.maps[0].h, row.map_row * k, 1);
  EXPECT_NEAR(fly.left_camera.h, row.picture_row * k, 1);
  EXPECT_NEAR(fly.left_camera.w, row.left_w_px * k, 1);
  EXPECT_NEAR(fly.left_camera.h - 28 * k, row.left_h_px * k, 1);
  EXPECT_NEAR(fly.right_camera.w, row.right_cam_w * k, 1);
  EXPECT_NEAR(fly.vehicle.h, row.vehicle_h * k, 1);
  EXPECT_NEAR(fly.view_3d.w, row.view_w * k, 1);
  EXPECT_NEAR(fly.approve.h, row.approve_h * k, 1);
  EXPECT_NEAR(fly.evidence.h, row.evidence_h * k, 1);
  EXPECT_EQ(fly.site_rows, row.site_rows);
  EXPECT_EQ(fly.site_row_units, row.site_row_units);
}

INSTANTIATE_TEST_SUITE_P(Sizes, FlyLayoutTable,
                         testing::Values(SizeRow{"w1920", 1920, 1080, 1, 416, 1480, 288, 360, 508,
                                                 640, 480, 408, 166, 416, 292, 324, 4, 72},
                                         SizeRow{"w1280", 1280, 720, 1, 344, 912, 176, 248, 340,
                                                 416, 312, 208, 148, 272, 174, 196, 4, 44},
                                         SizeRow{"w3840at2", 3840, 2160, 2, 416, 1480, 288, 360,
                                                 508, 640, 480, 408, 166, 416, 292, 324, 4, 72}),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(FlyLayout, ALargeWindowAtFullScaleKeepsMapsAt480AndTextUnstretched) {
  const FlyLayout fly = ComputeFlyLayout(3840, 2160, 1, false);
  EXPECT_EQ(fly.sites.w, 480);
  EXPECT_EQ(fly.map_side, 480);
  EXPECT_EQ(fly.site_rows, 8);
  EXPECT_EQ(fly.channels.h, 72);
  EXPECT_EQ(fly.left_camera.w, fly.right_camera.w);
}

TEST(FlyLayout, FrameBandsAreFixed) {
  const FrameLayout frame = ComputeFrameLayout(1920, 1080, 1);
  EXPECT_EQ(frame.top_bar.h, 48);
  EXPECT_EQ(frame.alarm_strip.y, 48);
  EXPECT_EQ(frame.alarm_strip.h, 32);
  EXPECT_EQ(frame.alarm_strip.right(), frame.wave_off.x);
  EXPECT_EQ(frame.wave_off.w, 216);
  EXPECT_EQ(frame.wave_off.h, 80);
  EXPECT_EQ(frame.wave_off.right(), 1920);
  EXPECT_EQ(frame.wave_off.y, 0);
  EXPECT_EQ(frame.body.y, 88);
  EXPECT_EQ(frame.body.h, 956);
  EXPECT_EQ(frame.status_bar.y, 1052);
  EXPECT_EQ(ComputeFrameLayout(1280, 720, 1).wave_off.w, 200);
}

std::vector<Rect> Panels(const FlyLayout& fly) {
  std::vector<Rect> panels = {fly.left_camera, fly.right_camera, fly.vehicle, fly.view_3d};
  if (fly.descent) {
    panels.push_back(fly.plot_tabs);
    panels.insert(panels.end(), fly.plots.begin(), fly.plots.end());
    panels.insert(panels.end(), {fly.recheck, fly.limits, fly.tracker, fly.landing});
  } else {
    panels.insert(panels.end(), fly.maps.begin(), fly.maps.end());
    panels.insert(panels.end(), {fly.channels, fly.sites, fly.evidence, fly.approve});
  }
  return panels;
}

bool Overlap(const Rect& a, const Rect& b) {
  return a.x < b.right() && b.x < a.right() && a.y < b.bottom() && b.y < a.bottom();
}

TEST(FlyLayout, PanelsStayInTheBodyAndNeverOverlapAtAnySizeAndScale) {
  for (const double scale : {0.75, 1.0, 1.25, 1.5, 2.0, 2.5}) {
    for (double width = 1280; width <= 3840; width += 160) {
      for (double height = 720; height <= 2160; height += 120) {
        for (const bool descent : {false, true}) {
          const FlyLayout fly = ComputeFlyLayout(width * scale, height * scale, scale, descent);
          const std::vector<Rect> panels = Panels(fly);
          for (std::size_t i = 0; i < panels.size(); ++i) {
            const Rect& p = panels[i];
            if (p.w == 0 && p.h == 0) {
              continue;
            }
            ASSERT_GT(p.w, 0) << i << " at " << width << "x" << height << " scale " << scale;
            ASSERT_GT(p.h, 0) << i << " at " << width << "x" << height << " scale " << scale;
            ASSERT_GE(p.x, fly.frame.body.x - 1) << i;
            ASSERT_LE(p.right(), fly.frame.body.right() + 1)
                << i << " at " << width << "x" << height << " scale " << scale;
            ASSERT_LE(p.bottom(), fly.frame.body.bottom() + 1)
                << i << " at " << width << "x" << height << " scale " << scale;
            for (std::size_t j = 0; j < i; ++j) {
              ASSERT_FALSE(Overlap(p, panels[j]))
                  << i << " and " << j << " at " << width << "x" << height << " scale " << scale;
            }
          }
        }
      }
    }
  }
}

TEST(FlyLayout, OfANarrowWindowTheLastPanelStandsWhereApproveDoes) {
  for (const double scale : {1.0, 1.25, 2.0}) {
    for (const double height : {720.0, 768.0, 800.0, 880.0}) {
      const FlyLayout fly = ComputeFlyLayout(1280 * scale, height * scale, scale, true);
      ASSERT_TRUE(fly.narrow);
      EXPECT_NEAR(fly.landing.y, fly.approve.y, 1) << height << " at " << scale;
      EXPECT_NEAR(fly.landing.bottom(), fly.approve.bottom(), 1) << height << " at " << scale;
      EXPECT_GE(fly.recheck.h, 196 * scale - 1) << height << " at " << scale;
    }
  }
}

// A window that is narrow and high: what is left beside the tracker is Landing's, and enough.
TEST(FlyLayout, WhatTheTrackerTakesOfATallNarrowWindowItShows) {
  for (const double scale : {1.0, 2.0}) {
    for (double height = 720; height <= 2400; height += 40) {
      SCOPED_TRACE(testing::Message() << height << " at " << scale);
      const FlyLayout fly = ComputeFlyLayout(1280 * scale, height * scale, scale, true);
      const double gap = 8 * scale;
      const bool shown = fly.tracker.h > 0;
      EXPECT_NEAR(fly.landing.y, (shown ? fly.tracker : fly.limits).bottom() + gap, 1);
      EXPECT_NEAR(fly.landing.bottom(), fly.frame.body.bottom(), 1);
      EXPECT_GE(fly.landing.h, 174 * scale - 1);
      EXPECT_EQ(shown, fly.approve.h >= (174 + 8 + 160) * scale - 1);
      EXPECT_TRUE(!shown || fly.tracker.h >= 160 * scale - 1);
    }
  }
}

// After a hold the ways elsewhere stand in the head of Landing, and then of Approve.
TEST(FlyLayout, OnHoldTheLastPanelHasApprovesPlaceAtEverySize) {
  for (double width = 1280; width <= 3840; width += 320) {
    for (double height = 720; height <= 2160; height += 60) {
      SCOPED_TRACE(testing::Message() << width << " x " << height);
      const FlyLayout fly = ComputeFlyLayout(width, height, 1, true);
      EXPECT_EQ(fly.held_recheck.y, fly.frame.body.y);
      EXPECT_GE(fly.held_recheck.h, 195);
      EXPECT_NEAR(fly.held_limits.y, fly.held_recheck.bottom() + 8, 1);
      EXPECT_GE(fly.held_limits.h, 160);
      EXPECT_NEAR(fly.held_limits.bottom() + 8, fly.approve.y, 1);
    }
  }
}

TEST(FlyLayout, ScaleDropsByStepsUntilTheSmallestWindowFits) {
  EXPECT_EQ(FittingScale(1920, 1080, 1.0), 1.0);
  EXPECT_EQ(FittingScale(1920, 1080, 2.0), 1.5);
  EXPECT_EQ(FittingScale(1200, 720, 1.0), 0.75);
  EXPECT_EQ(FittingScale(3840, 2160, 2.0), 2.0);
}

}  // namespace
}  // namespace palace
