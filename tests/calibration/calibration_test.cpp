// From observations to cameras: exactness, honest covariance, robustness, refusals. No pictures.
#include <gmock/gmock.h>

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "engine/calibration/calibration_quality.h"
#include "engine/calibration/tsai_start.h"
#include "engine/camera/cahvor.h"
#include "engine/core/units.h"
#include "tests/calibration/calibration_world.h"

namespace palace {
namespace {

using calibration_world::CountInside;
using calibration_world::Observe;
using calibration_world::Options;
using calibration_world::TruthOf;
using testing::HasSubstr;

constexpr int kViews = 12;

TEST(TsaiStartTest, IsCloseOnAnUndistortedCamera) {
  CalibrationSession session = MakeCalibrationSession(3, kViews);
  RigEstimate truth = TruthOf(session);
  truth.lens[0] << 800, 319.5, 800, 239.5, 0, 0, 0, 0;
  std::vector<TargetObservation> seen;
  for (const TargetView& view : Observe(session.target, truth, 0, 1)) {
    seen.push_back(view.left);
  }
  const auto start = StartFromRadialAlignment(session.target, seen, 640, 480);
  ASSERT_TRUE(start);
  EXPECT_NEAR(start->focal_px, 800, 2);
  for (std::size_t v = 0; v < seen.size(); ++v) {
    ASSERT_TRUE(start->X_CT[v]) << v;
    EXPECT_LT((start->X_CT[v]->p - truth.X_C0T[v].p).norm(), 0.02 * truth.X_C0T[v].p.norm()) << v;
  }
}

TEST(CalibrationTest, ExactObservationsGiveTheExactRig) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const CalibrationSession session = MakeCalibrationSession(seed, kViews);
    const RigEstimate truth = TruthOf(session);
    CalibrationOptions options = Options();
    options.prior = {1e3, 1e3, 1e3};  // even a weak prior moves an exact answer
    const auto result = Calibrate(session.target, Observe(session.target, truth, 0, seed), options);
    ASSERT_TRUE(result.ok()) << result.error().message;
    const CameraVector error = RigDifference(result->estimate, truth);
    EXPECT_LT(error.head<kRightRotation>().cwiseAbs().maxCoeff(), 1e-4) << "seed " << seed;
    EXPECT_LT(error.tail<6>().cwiseAbs().maxCoeff(), 1e-6) << "seed " << seed;
    EXPECT_LT(CheckEpipolar(*result).max_px, 1e-4) << "seed " << seed;
  }
}

/// The covariance against what happens: 20 calibrations, 22 parameters each.
TEST(CalibrationTest, TruthLiesInsideTheStatedSigmas) {
  constexpr int kTrials = 20;
  int inside_3 = 0, inside_1 = 0;
  double square_sum = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const auto seed = static_cast<std::uint64_t>(100 + trial);
    const CalibrationSession session = MakeCalibrationSession(seed, kViews);
    const RigEstimate truth = TruthOf(session);
    const auto result =
        Calibrate(session.target, Observe(session.target, truth, 0.03, seed), Options());
    ASSERT_TRUE(result.ok()) << seed << ": " << result.error().message;
    EXPECT_NEAR(result->sigma_px, 0.03, 0.002) << "seed " << seed;
    const CameraVector error = RigDifference(result->estimate, truth);
    inside_3 += CountInside(error, result->covariance, 3);
    inside_1 += CountInside(error, result->covariance, 1);
    square_sum += error.dot(result->covariance.ldlt().solve(error));
  }
  const int parameters = kTrials * kCameraSize;
  EXPECT_GE(inside_3, 0.95 * parameters) << "seeds 100 to 119";
  EXPECT_GT(inside_1, 0.58 * parameters) << "normal: 68 %";
  EXPECT_LT(inside_1, 0.78 * parameters);
  // Sum of squares of 440 standard normal values: 440 +- 30.
  EXPECT_NEAR(square_sum, parameters, 120);
}

TEST(CalibrationTest, OutliersMoveTheResultByLessThanItsSigma) {
  const CalibrationSession session = MakeCalibrationSession(7, kViews);
  const RigEstimate truth = TruthOf(session);
  const auto clean_views = Observe(session.target, truth, 0.03, 7);
  const auto clean = Calibrate(session.target, clean_views, Options());
  ASSERT_TRUE(clean.ok()) << clean.error().message;
  auto dirty_views = clean_views;
  RandomStream random(7, "outliers");
  int moved = 0;
  for (TargetView& view : dirty_views) {
    for (TargetObservation* side : {&view.left, &view.right}) {
      for (TargetPoint& point : *side) {
        if (random.Uniform() < 0.05) {
          const double angle = random.Uniform(0, 6.2831853);
          point.pixel += 5 * Eigen::Vector2d(std::cos(angle), std::sin(angle));
          ++moved;
        }
      }
    }
  }
  const auto dirty = Calibrate(session.target, dirty_views, Options());
  ASSERT_TRUE(dirty.ok()) << dirty.error().message;
  EXPECT_NEAR(dirty->outliers, moved, 3) << "of " << dirty->points;
  EXPECT_NEAR(dirty->sigma_px, clean->sigma_px, 0.002);
  const CameraVector shift = RigDifference(dirty->estimate, clean->estimate);
  for (int i = 0; i < kCameraSize; ++i) {
    EXPECT_LT(std::abs(shift[i]), std::sqrt(dirty->covariance(i, i))) << "parameter " << i;
  }
}

TEST(CalibrationTest, MissedDotsAndOneSidedViewsAreTaken) {
  const CalibrationSession session = MakeCalibrationSession(8, kViews);
  const RigEstimate truth = TruthOf(session);
  auto views = Observe(session.target, truth, 0.03, 8);
  RandomStream random(8, "missed");
  for (TargetView& view : views) {
    std::erase_if(view.left, [&](const TargetPoint&) { return random.Uniform() < 0.3; });
    std::erase_if(view.right, [&](const TargetPoint&) { return random.Uniform() < 0.3; });
  }
  views[2].right.clear();
  views[5].left.clear();
  views[6].left.clear();
  views[6].right.resize(5);  // too few to count: the view is left out
  const auto result = Calibrate(session.target, views, Options());
  ASSERT_TRUE(result.ok()) << result.error().message;
  EXPECT_EQ(result->views.size(), views.size() - 1);
  EXPECT_GE(CountInside(RigDifference(result->estimate, truth), result->covariance, 3.5), 21);
}

TEST(CalibrationTest, ThePitchScalesTheBaselineAndNothingElse) {
  const CalibrationSession session = MakeCalibrationSession(9, kViews);
  const auto views = Observe(session.target, TruthOf(session), 0.03, 9);
  CalibrationTarget larger = session.target;
  larger.pitch_m *= 1.1;
  larger.dot_diameter_m *= 1.1;
  const auto a = Calibrate(session.target, views, Options());
  const auto b = Calibrate(larger, views, Options());
  ASSERT_TRUE(a.ok() && b.ok());
  EXPECT_NEAR(b->baseline_m() / a->baseline_m(), 1.1, 1e-7);
  EXPECT_NEAR(b->baseline_sigma_m() / a->baseline_sigma_m(), 1.1, 1e-3);
  for (const int side : {0, 1}) {
    const auto at = static_cast<std::size_t>(side);
    EXPECT_LT((a->estimate.lens[at] - b->estimate.lens[at]).norm(), 1e-4);
  }
  EXPECT_LT((a->estimate.X_C0C1.R - b->estimate.X_C0C1.R).norm(), 1e-8);
}

TEST(CalibrationTest, HeldOutViewsFitCamerasThatNeverSawThem) {
  const CalibrationSession session = MakeCalibrationSession(10, 16);
  const auto result =
      Calibrate(session.target, Observe(session.target, TruthOf(session), 0.05, 10), Options());
  ASSERT_TRUE(result.ok());
  int held_out = 0;
  for (const ViewResult& view : result->views) {
    held_out += view.held_out ? 1 : 0;
    EXPECT_EQ(view.held_out, std::isfinite(view.held_out_rms_px));
  }
  EXPECT_EQ(held_out, 4);
  EXPECT_NEAR(result->held_out_rms_px, 0.05 * std::sqrt(2.0), 0.005);
  EXPECT_NEAR(CheckEpipolar(*result).held_out_rms_px, 0.05 * std::sqrt(2.0), 0.01);
}

struct Refusal {
  const char* name;
  void (*spoil)(CalibrationSession&, RigEstimate&);
  void (*spoil_views)(std::vector<TargetView>&);
  const char* says;
};

class RefusedSet : public testing::TestWithParam<Refusal> {};

TEST_P(RefusedSet, IsRefusedWithTheReason) {
  const Refusal& refusal = GetParam();
  CalibrationSession session = MakeCalibrationSession(11, kViews);
  RigEstimate truth = TruthOf(session);
  refusal.spoil(session, truth);
  auto views = Observe(session.target, truth, 0.02, 11);
  refusal.spoil_views(views);
  const auto result = Calibrate(session.target, views, Options());
  ASSERT_FALSE(result.ok());
  EXPECT_THAT(result.error().message, HasSubstr(refusal.says));
}

void KeepSession(CalibrationSession&, RigEstimate&) {}
void KeepViews(std::vector<TargetView>&) {}

/// All boards turned alike; distances and places as they were.
void MakeParallel(CalibrationSession& session, RigEstimate& truth, double tilt_rad) {
  const Eigen::Vector3d middle =
      (session.target.p_TQ(0) + session.target.p_TQ(session.target.point_count() - 1)) / 2;
  for (RigidTransform& X : truth.X_C0T) {
    const Eigen::Vector3d at = X * middle;
    X.R = Eigen::AngleAxisd(tilt_rad, Eigen::Vector3d::UnitY()).toRotationMatrix();
    X.p = at - X.R * middle;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Rows, RefusedSet,
    testing::Values(
        Refusal{"FewViews", KeepSession, [](std::vector<TargetView>& v) { v.resize(3); },
                "in 3 of 3 views, 4 are the least"},
        Refusal{"NoViews", KeepSession, [](std::vector<TargetView>& v) { v.clear(); },
                "in 0 of 0 views"},
        Refusal{"NothingSeen", KeepSession,
                [](std::vector<TargetView>& v) {
                  for (TargetView& view : v) {
                    view.left.clear();
                  }
                },
                "in 0 of 12 views"},
        Refusal{"FrontoParallel",
                [](CalibrationSession& s, RigEstimate& rig) { MakeParallel(s, rig, 0); }, KeepViews,
                "tilted by 20 to 45 degrees"},
        Refusal{"ParallelToEachOther",
                [](CalibrationSession& s, RigEstimate& rig) { MakeParallel(s, rig, Rad(25)); },
                KeepViews, "parallel to itself"},
        Refusal{"OneTiltOnly",
                [](CalibrationSession& s, RigEstimate& rig) {
                  const RigidTransform tilted = rig.X_C0T[1];
                  MakeParallel(s, rig, 0);
                  rig.X_C0T[1] = tilted;
                },
                KeepViews, "1 of 12 views are tilted"},
        Refusal{"Swapped", KeepSession,
                [](std::vector<TargetView>& v) {
                  for (TargetView& view : v) {
                    std::swap(view.left, view.right);
                  }
                },
                "swapped"},
        Refusal{"SamePicturesTwice", KeepSession,
                [](std::vector<TargetView>& v) {
                  for (TargetView& view : v) {
                    view.right = view.left;
                  }
                },
                "both lists hold the same camera's pictures"},
        Refusal{"WrongOrder", KeepSession,
                [](std::vector<TargetView>& v) {
                  for (std::size_t i = 0; i + 1 < v.size(); ++i) {
                    std::swap(v[i].right, v[i + 1].right);
                  }
                },
                "same order"},
        Refusal{"AnotherTarget", [](CalibrationSession&, RigEstimate&) {},
                [](std::vector<TargetView>& v) {  // rows squeezed: a board of another shape
                  for (TargetView& view : v) {
                    for (TargetObservation* side : {&view.left, &view.right}) {
                      for (TargetPoint& point : *side) {
                        const double row = point.index / 13;
                        point.pixel.y() += 1.5 * row * row;
                      }
                    }
                  }
                },
                "px of error"}),
    [](const auto& row) { return row.param.name; });

/// Two views exchanged on one side are thrown out whole by the robust fit, which then looks good.
TEST(ContradictionsTest, NamesTheExchangedPicturesAndNoOthers) {
  for (const std::size_t exchanged : {0u, 2u, 3u}) {
    const CalibrationSession session = MakeCalibrationSession(16, kViews);
    auto views = Observe(session.target, TruthOf(session), 0.03, 16);
    for (std::size_t v = 0; v < views.size(); ++v) {
      views[v].name = "left" + std::to_string(v);
      views[v].right_name = "right" + std::to_string(v);
    }
    if (exchanged > 0) {  // a ring of 2 or 3 views from view 4 on
      const auto first = views.begin() + 4;
      for (std::size_t i = 0; i + 1 < exchanged; ++i) {
        std::swap(first[static_cast<std::ptrdiff_t>(i)].right,
                  first[static_cast<std::ptrdiff_t>(i) + 1].right);
        std::swap(first[static_cast<std::ptrdiff_t>(i)].right_name,
                  first[static_cast<std::ptrdiff_t>(i) + 1].right_name);
      }
    }
    const auto result = Calibrate(session.target, views, Options());
    ASSERT_TRUE(result.ok()) << result.error().message;
    const std::vector<std::string> sentences = Contradictions(*result);
    ASSERT_EQ(sentences.size(), exchanged);
    for (std::size_t i = 0; i < exchanged; ++i) {
      EXPECT_THAT(sentences[i], HasSubstr(views[4 + i].name + " and " + views[4 + i].right_name +
                                          " do not show"));
    }
  }
}

TEST(CalibrationQualityTest, UncertaintyIsLeastWhereTheBoardWas) {
  const CalibrationSession session = MakeCalibrationSession(12, kViews);
  const auto result =
      Calibrate(session.target, Observe(session.target, TruthOf(session), 0.03, 12), Options());
  ASSERT_TRUE(result.ok());
  const GridF coverage = CoverageMap(*result, 0, 6, 8);
  const GridF sigma = UncertaintyMap(*result, 0, 6, 8);
  double total = 0, weighted = 0, corner = 0;
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 8; ++column) {
      ASSERT_TRUE(std::isfinite(sigma.at(row, column)));
      total += coverage.at(row, column);
      weighted += coverage.at(row, column) * sigma.at(row, column);
    }
  }
  corner = (sigma.at(0, 0) + sigma.at(0, 7) + sigma.at(5, 0) + sigma.at(5, 7)) / 4;
  EXPECT_EQ(total, kViews * 130 - static_cast<int>(std::count_if(
                                      result->rejected.begin(), result->rejected.end(),
                                      [](const PointResidual& r) { return r.side == 0; })));
  EXPECT_LT(weighted / total, 0.5 * corner);
}

/// The depth map against what triangulation with wrong cameras really does.
TEST(CalibrationQualityTest, DepthSigmaIsTheSpreadOfDepthOverCalibrations) {
  constexpr int kTrials = 30;
  constexpr double kDepth_m = 15;
  const CalibrationSession session = MakeCalibrationSession(13, 8);
  const RigEstimate truth = TruthOf(session);
  // The point at the left picture's middle cell, as both true cameras see it.
  const auto ray = RayFromPixelCahvor(session.left, {319.5, 239.5});
  ASSERT_TRUE(ray);
  const Eigen::Vector3d p_F =
      ray->origin + ray->direction * (kDepth_m / ray->direction.dot(session.left.A));
  const Eigen::Vector2d left_px = *ProjectCahvor(session.left, p_F);
  const Eigen::Vector2d right_px = *ProjectCahvor(session.right, p_F);
  double square_sum = 0, stated = 0;
  CalibrationOptions options = Options();
  options.hold_out_every = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const auto result =
        Calibrate(session.target,
                  Observe(session.target, truth, 0.05, static_cast<std::uint64_t>(trial)), options);
    ASSERT_TRUE(result.ok());
    const auto a = RayFromPixelCahvor(result->LeftModel(), left_px);
    const auto b = RayFromPixelCahvor(result->RightModel(), right_px);
    // Nearest point of the two rays, on the left one.
    const Eigen::Vector3d w = b->origin - a->origin;
    const double ab = a->direction.dot(b->direction);
    const double along = (w.dot(a->direction) - ab * w.dot(b->direction)) / (1 - ab * ab);
    const double depth_m = along * a->direction.z();
    square_sum += (depth_m - kDepth_m) * (depth_m - kDepth_m);
    stated = DepthSigmaMap(*result, kDepth_m, 1, 1).at(0, 0);
  }
  const double spread = std::sqrt(square_sum / kTrials);
  EXPECT_GT(stated, 0.65 * spread) << "30 trials know a spread to 13 %";
  EXPECT_LT(stated, 1.5 * spread);
}

TEST(NextViewTest, SaysWhatLacks) {
  const CalibrationSession session = MakeCalibrationSession(14, 6);
  const auto result =
      Calibrate(session.target, Observe(session.target, TruthOf(session), 0.03, 14), Options());
  ASSERT_TRUE(result.ok());
  EXPECT_THAT(NextView(*result), HasSubstr("Next view: hold the board in the"));
  // Its figure is the map's at the cell it names.
  const std::string text = NextView(*result);
  double sigma_px = 0, column = 0, row = 0;
  ASSERT_EQ(std::sscanf(text.substr(text.find("; ") + 2).c_str(),
                        "%lf px 1 sigma round column %lf, row %lf", &sigma_px, &column, &row),
            3)
      << text;
  const int side = text.find("left picture") != std::string::npos ? 0 : 1;
  const GridF map = UncertaintyMap(*result, side, kMapRows, kMapColumns);
  EXPECT_NEAR(map.at(static_cast<int>((row + 0.5) * kMapRows / result->height),
                     static_cast<int>((column + 0.5) * kMapColumns / result->width)),
              sigma_px, 0.0006)
      << text;
  // The left edge of the left picture is never in the right one's view of a near board.
  EXPECT_THAT(
      NextView(*result),
      testing::ContainsRegex(
          "left (edge|corner)|upper left|lower left|right (edge|corner)|upper right|lower right"));
}

}  // namespace
}  // namespace palace
