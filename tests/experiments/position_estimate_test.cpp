// The approach that position estimates are judged on, and the figures they are judged by.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "engine/core/random.h"
#include "engine/core/units.h"
#include "engine/experiments/cone_approach.h"
#include "engine/experiments/position_pictures.h"
#include "engine/experiments/position_rows.h"
#include "engine/tracking/view_geometry.h"

namespace palace {
namespace {

TEST(ConeApproach, KeepsTheConeInTheMiddleDownTheSlope) {
  const VehicleDescription& vehicle = DefaultVehicle();
  Result<ConeApproach> made = ConeApproach::Make({.seed = 3, .render = false}, nullptr);
  ASSERT_TRUE(made) << made.error().message;
  ConeApproach& approach = *made;
  double first_m = NAN, last_m = NAN;
  while (true) {
    const auto next = approach.Next();
    ASSERT_TRUE(next) << next.error().message;
    if (!*next) {
      break;
    }
    const RigidTransform X_WC = (*next)->X_WB * vehicle.rig.X_BC();
    const PinholeCamera& camera = vehicle.rig.left.pinhole;
    const auto pixel = PixelFromWorldPoint(camera, X_WC, approach.p_W_cone());
    ASSERT_TRUE(pixel);
    EXPECT_LT((*pixel - Eigen::Vector2d(camera.cx_px, camera.cy_px)).norm(), 100);
    const Eigen::Vector3d skid_W = (*next)->X_WB * vehicle.lander.skid_centre_B();
    last_m = approach.p_W_cone().z() - skid_W.z();
    first_m = std::isnan(first_m) ? (*next)->X_WB.p.z() : first_m;
  }
  EXPECT_NEAR(first_m, -15.24, 0.2);
  EXPECT_NEAR(last_m, 2.0, 0.3);
}

TEST(ConeApproach, RefusesCamerasThatLookTooFlat) {
  for (const double tilt_deg : {0.0, -14.9}) {
    ConeApproachPlan plan{.seed = 3, .render = false};
    plan.vehicle.rig.tilt_rad = Rad(tilt_deg);
    const Result<ConeApproach> made = ConeApproach::Make(plan, nullptr);
    ASSERT_FALSE(made) << tilt_deg;
    EXPECT_THAT(made.error().message, testing::HasSubstr("below the horizon"));
    EXPECT_THAT(made.error().message, testing::HasSubstr("15 deg"));
  }
  EXPECT_TRUE(ConeApproach::Make({.seed = 3, .render = false}, nullptr));
}

PinholeCamera CameraOf(int width, int height) {
  PinholeCamera camera;
  camera.width = width;
  camera.height = height;
  camera.fx_px = camera.fy_px = width;
  camera.cx_px = (width - 1) / 2.0;
  camera.cy_px = (height - 1) / 2.0;
  return camera;
}

TEST(PositionPictures, AreTheCamerasOwnAndTheMiddleRowsOfTheThesis) {
  const struct {
    int height;
    std::vector<int> looked_at;
  } table[] = {{480, {480, 240}}, {1080, {1080, 240}}, {300, {300, 240}}, {240, {240}}};
  for (const auto& row : table) {
    const Result<std::vector<int>> heights = PictureHeights(CameraOf(320, row.height));
    ASSERT_TRUE(heights) << row.height;
    EXPECT_EQ(*heights, row.looked_at);
  }
  const Result<std::vector<int>> low = PictureHeights(CameraOf(320, 239));
  ASSERT_FALSE(low);
  EXPECT_THAT(low.error().message, testing::HasSubstr("320x239"));
}

TEST(PositionPictures, MiddleRowsShowTheSamePlacesAtTheSameRays) {
  MeasuredPicture whole;
  whole.camera = CameraOf(32, 301);
  whole.left = ImageU8(32, 301);
  whole.range.depth_m = whole.range.depth_sigma_m = ImageF(32, 301);
  for (int y = 0; y < 301; ++y) {
    for (int x = 0; x < 32; ++x) {
      whole.left.at(x, y) = static_cast<std::uint8_t>(y % 251);
      whole.range.depth_m.at(x, y) = static_cast<float>(y);
    }
  }
  const MeasuredPicture middle = MiddleRows(whole, 240);
  ASSERT_EQ(middle.left.height(), 240);
  ASSERT_EQ(middle.range.depth_m.height(), 240);
  EXPECT_EQ(middle.camera.height, 240);
  for (const int y : {0, 120, 239}) {
    const int row = static_cast<int>(middle.range.depth_m.at(3, y));
    EXPECT_EQ(middle.left.at(3, y), row % 251);
    const Eigen::Vector3d ray = RayFromPixel(middle.camera, {3, y}),
                          same = RayFromPixel(whole.camera, {3, row});
    EXPECT_LT((ray - same).norm(), 1e-12) << y;
  }
}

TEST(EstimatorRun, HearsTheVehicleAlsoWithoutAPicture) {
  Result<ConeApproach> approach = ConeApproach::Make({.seed = 4, .render = false}, nullptr);
  ASSERT_TRUE(approach);
  EstimatorRun run(PositionEstimator::kResection, {}, {}, approach->p_W_cone());
  Timestamp newest;
  for (int i = 0; i < 10; ++i) {
    const auto next = approach->Next();
    ASSERT_TRUE(next && *next);
    ASSERT_FALSE((*next)->bundle->stereo);
    run.AddSensors(*(*next)->bundle);
    newest = (*next)->bundle->time;
  }
  EXPECT_TRUE(run.navigation().gps.running);
  EXPECT_EQ(run.navigation().gps.estimate.time, newest);
}

TEST(AttitudeOf, ReplacesAttitudesAndNothingElse) {
  Result<ConeApproach> made = ConeApproach::Make({.seed = 4, .render = false}, nullptr);
  ASSERT_TRUE(made) << made.error().message;
  ConeApproach& approach = *made;
  AttitudeOf perfect(AttitudeQuality::kPerfect, 1), poor(AttitudeQuality::kPoor, 1);
  double worst_rad = 0;
  for (int i = 0; i < 20; ++i) {
    const auto next = approach.Next();
    ASSERT_TRUE(next && *next);
    const auto exact = perfect.Told((*next)->bundle, approach);
    const auto wrong = poor.Told((*next)->bundle, approach);
    ASSERT_EQ(exact->poses.size(), (*next)->bundle->poses.size());
    for (std::size_t k = 0; k < exact->poses.size(); ++k) {
      const RigidTransform truth = approach.TruePoseAt(exact->poses[k].time);
      EXPECT_LT((exact->poses[k].X_WB.R - truth.R).norm(), 1e-12);
      EXPECT_EQ(exact->poses[k].X_WB.p, (*next)->bundle->poses[k].X_WB.p);
      const Eigen::AngleAxisd off(Eigen::Matrix3d(truth.R.transpose() * wrong->poses[k].X_WB.R));
      worst_rad = std::max(worst_rad, off.angle());
    }
    EXPECT_EQ(wrong->pose_at_exposure->X_WB.R, wrong->poses.back().X_WB.R);
  }
  EXPECT_GT(worst_rad, Rad(0.3));
  EXPECT_LT(worst_rad, Rad(3));
}

TEST(PositionError, IsOnePerDegreeOfFreedomWhereTheCovarianceIsTrue) {
  RandomStream random(5);
  const Eigen::Vector3d sigma_m(0.01, 0.05, 0.2);
  const Eigen::Matrix3d R = RotationFromEuler({0.3, 0.4, 0.5});
  const Eigen::Matrix3d covariance_m2 = R * sigma_m.cwiseAbs2().asDiagonal() * R.transpose();
  double nees = 0;
  Eigen::Vector3d axes = Eigen::Vector3d::Zero();
  constexpr int kCount = 4000;
  for (int i = 0; i < kCount; ++i) {
    const Eigen::Vector3d n(random.Normal(), random.Normal(), random.Normal());
    const PositionError error{R * n.cwiseProduct(sigma_m), covariance_m2};
    nees += error.NeesPerDof() / kCount;
    axes += error.NeesOfAxes() / kCount;
  }
  EXPECT_NEAR(nees, 1, 0.05);
  EXPECT_LT((axes - Eigen::Vector3d::Ones()).cwiseAbs().maxCoeff(), 0.1);
}

/// Errors of one flight, in units of the stated sigma, which is `sigma_m`, on each axis.
std::vector<PositionSample> SamplesOf(double sigma_m, double ratio) {
  std::vector<PositionSample> samples(20);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples[i].time = AddSeconds({}, 0.1 * static_cast<double>(i));
    const double sign = i % 2 == 0 ? 1 : -1;
    const PositionError error{Eigen::Vector3d::Constant(sign * ratio * sigma_m),
                              sigma_m * sigma_m * Eigen::Matrix3d::Identity()};
    samples[i].raw = samples[i].filtered = error;
  }
  return samples;
}

using SamplesOfCase = std::function<std::vector<PositionSample>(int flight, AttitudeQuality)>;

/// Two flights of every case.
TrialTable TableOf(const SamplesOfCase& samples, const std::string& picture = "640x480") {
  TrialTable table;
  table.columns = PositionColumns();
  table.columns.insert(table.columns.begin(), {"trial", "seed"});
  for (int flight = 0; flight < 2; ++flight) {
    std::vector<TrialRow> rows;
    for (const bool whole : {true, false}) {
      for (const AttitudeQuality attitude : kAttitudeQualities) {
        for (const PositionEstimator estimator : kPositionEstimators) {
          AddPositionRows({whole ? picture : "640x240", whole, NameOf(attitude), NameOf(estimator)},
                          samples(flight, attitude), flight == 0, rows);
        }
      }
    }
    for (TrialRow& row : rows) {
      row.insert(row.begin(), {std::to_string(flight), "1"});
      EXPECT_EQ(row.size(), table.columns.size());
      table.rows.push_back(row);
    }
  }
  return table;
}

TrialTable TableOf(double sigma_m, double ratio) {
  return TableOf([&](int, AttitudeQuality) { return SamplesOf(sigma_m, ratio); });
}

TEST(PositionReport, PassesWhatIsNearAndHonestAlone) {
  EXPECT_TRUE(PositionReport(TableOf(0.03, 1)).passed);
  EXPECT_FALSE(PositionReport(TableOf(0.1, 1)).passed) << "0.17 m off with a perfect attitude";
  EXPECT_FALSE(PositionReport(TableOf(0.03, 0.5)).passed) << "states twice its error";
  EXPECT_FALSE(PositionReport(TableOf(0.03, 1.5)).passed) << "states two thirds of its error";
}

TEST(PositionReport, JudgesTheCamerasOwnPicturesWhateverTheirSize) {
  const auto good = [](int, AttitudeQuality) { return SamplesOf(0.03, 1); };
  const ExperimentReport report = PositionReport(TableOf(good, "320x300"));
  EXPECT_TRUE(report.passed);
  EXPECT_THAT(report.lines, testing::Contains(testing::HasSubstr("320x300, attitude perfect")));
  EXPECT_THAT(report.page.Text(), testing::HasSubstr("320x300"));
  EXPECT_THAT(report.page.Text(), testing::Not(testing::HasSubstr("640x480")));
}

// In the mean over attitudes these would be honest.
TEST(PositionReport, HonestyIsAskedOfEveryAttitude) {
  const ExperimentReport report = PositionReport(TableOf([](int, AttitudeQuality attitude) {
    return SamplesOf(0.01, attitude == AttitudeQuality::kPerfect ? std::sqrt(0.6)
                           : attitude == AttitudeQuality::kPoor  ? std::sqrt(1.4)
                                                                 : 1);
  }));
  EXPECT_FALSE(report.passed);
  const auto judged = [&](const std::string& verdict, const std::string& attitude) {
    return std::count_if(report.lines.begin(), report.lines.end(), [&](const std::string& line) {
      return line.starts_with(verdict + ": Normalised") &&
             line.find("attitude " + attitude + ":") != std::string::npos;
    });
  };
  EXPECT_EQ(judged("FAILED", "perfect"), 2) << "raw and filtered";
  EXPECT_EQ(judged("passed", "vehicle"), 2);
  EXPECT_EQ(judged("FAILED", "0.3 deg"), 2);
  EXPECT_THAT(report.lines, testing::Contains(testing::HasSubstr("0.60 (0.60 to 0.60) in 2 of 2")));
}

TEST(PositionReport, TellsWhereTheFlightsAreTooFewForItsVerdict) {
  const auto told = [](double first, double second) {
    const ExperimentReport report = PositionReport(TableOf([&](int flight, AttitudeQuality) {
      return SamplesOf(0.01, std::sqrt(flight == 0 ? first : second));
    }));
    return std::count_if(report.lines.begin(), report.lines.end(), [](const std::string& line) {
      return line.find("too few flights") != std::string::npos;
    });
  };
  EXPECT_EQ(told(1, 1), 0);
  EXPECT_EQ(told(3, 3), 0) << "surely not honest";
  EXPECT_EQ(told(0.7, 1.3), 6) << "raw and filtered of three attitudes";
}

TEST(PositionReport, AFlightWithoutFiguresDoesNotPass) {
  const ExperimentReport never = PositionReport(TableOf([](int flight, AttitudeQuality) {
    return flight == 0 ? SamplesOf(0.03, 1) : std::vector<PositionSample>();
  }));
  EXPECT_FALSE(never.passed);
  EXPECT_THAT(never.lines, testing::Each(testing::Not(testing::StartsWith("passed"))));
  EXPECT_THAT(never.page.Text(), testing::HasSubstr("1 of 2"));
  const ExperimentReport once = PositionReport(TableOf([](int flight, AttitudeQuality) {
    std::vector<PositionSample> samples = SamplesOf(0.03, 1);
    if (flight == 1) {
      samples[7].filtered->e_m.y() = NAN;
    }
    return samples;
  }));
  EXPECT_FALSE(once.passed);
}

}  // namespace
}  // namespace palace
