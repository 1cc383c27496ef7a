// The whole path on pictures: rendered here, rendered elsewhere, and photographed.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "engine/calibration/calibration_quality.h"
#include "engine/calibration/target_detection.h"
#include "engine/capture/picture_file.h"
#include "tests/calibration/calibration_world.h"
#include "tests/support/reference_data.h"

namespace palace {
namespace {

namespace fs = std::filesystem;
using calibration_world::CountInside;
using calibration_world::Options;
using calibration_world::TruthOf;

/// Issue limits.
constexpr double kFocalShare = 0.0005;
constexpr double kBaselineShare = 0.001;
constexpr double kRowRms_px = 0.05;

double FocalError(const RigEstimate& estimate, const RigEstimate& truth) {
  double most = 0;
  for (const std::size_t side : {0u, 1u}) {
    for (const int index : {kHs, kVs}) {
      most = std::max(most, std::abs(estimate.lens[side][index] / truth.lens[side][index] - 1));
    }
  }
  return most;
}

void ExpectWithinLimits(const Calibration& calibration, const RigEstimate& truth) {
  EXPECT_LT(FocalError(calibration.estimate, truth), kFocalShare);
  EXPECT_LT(std::abs(calibration.baseline_m() / truth.X_C0C1.p.norm() - 1), kBaselineShare);
  EXPECT_LT(CheckEpipolar(calibration).rms_px, kRowRms_px);
}

/// Three of the twenty that `palacectl evaluate calibration` runs.
TEST(RenderedCalibrationTest, TruthIsFoundWithinItsSigmas) {
  constexpr int kViews = 9;
  int inside = 0, parameters = 0;
  for (const std::uint64_t seed : {1, 2, 3}) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const CalibrationSession session = MakeCalibrationSession(seed, kViews);
    std::vector<TargetView> views;
    for (int v = 0; v < kViews; ++v) {
      TargetView view;
      view.name = "view " + std::to_string(v);
      for (const int side : {0, 1}) {
        auto seen = DetectTarget(RenderSessionView(session, seed, v, side), session.target);
        ASSERT_TRUE(seen.ok()) << seen.error().message;
        (side == 0 ? view.left : view.right) = std::move(*seen);
      }
      MatchTurn(session.target, view.left, view.right);
      views.push_back(std::move(view));
    }
    const auto calibration = Calibrate(session.target, views, Options());
    ASSERT_TRUE(calibration.ok()) << calibration.error().message;
    const RigEstimate truth = TruthOf(session);
    ExpectWithinLimits(*calibration, truth);
    inside += CountInside(RigDifference(calibration->estimate, truth), calibration->covariance, 3);
    parameters += kCameraSize;
  }
  EXPECT_GE(inside, 0.95 * parameters);
}

std::vector<TargetView> DetectFiles(const CalibrationTarget& target,
                                    const std::vector<std::pair<fs::path, fs::path>>& files) {
  std::vector<TargetView> views;
  for (const auto& [left, right] : files) {
    TargetView view;
    view.name = left.filename().string();
    for (const bool is_left : {true, false}) {
      const auto picture = ReadGreyPicture(is_left ? left : right);
      EXPECT_TRUE(picture.ok()) << picture.error().message;
      auto seen = DetectTarget(*picture, target);
      EXPECT_TRUE(seen.ok()) << left << ": " << (seen.ok() ? "" : seen.error().message);
      if (seen) {
        (is_left ? view.left : view.right) = std::move(*seen);
      }
    }
    MatchTurn(target, view.left, view.right);
    views.push_back(std::move(view));
  }
  return views;
}

Eigen::Vector3d VectorOf(const nlohmann::json& json) {
  return Eigen::Vector3d(json[0].get<double>(), json[1].get<double>(), json[2].get<double>());
}

CahvorModel ModelOf(const nlohmann::json& json) {
  CahvorModel model;
  model.width = 640;
  model.height = 480;
  model.C = VectorOf(json["C"]);
  model.A = VectorOf(json["A"]);
  model.H = VectorOf(json["H"]);
  model.V = VectorOf(json["V"]);
  model.O = VectorOf(json["O"]);
  model.R = VectorOf(json["R"]);
  return model;
}

TEST(DotGridTest, TruthIsFoundWithinTheLimitsAndItsSigmas) {
  const fs::path folder = ReferenceData("dotgrid_synthetic");
  std::ifstream file(folder / "truth.json");
  if (!file) {
    GTEST_SKIP() << NoReferenceData("dotgrid_synthetic");
  }
  const nlohmann::json json = nlohmann::json::parse(file);
  CalibrationSession session;
  session.target.columns = json["grid"]["cols"];
  session.target.rows = json["grid"]["rows"];
  session.target.pitch_m = json["grid"]["spacing_m"];
  session.target.dot_diameter_m = 2 * json["grid"]["dot_radius_m"].get<double>();
  session.left = ModelOf(json["cameras"]["left"]);
  session.right = ModelOf(json["cameras"]["right"]);
  const RigEstimate truth = TruthOf(session);
  std::vector<std::pair<fs::path, fs::path>> files;
  for (int v = 0; v < 10; ++v) {
    char name[16];
    std::snprintf(name, sizeof name, "%02d.png", v);
    files.emplace_back(folder / (std::string("left") + name),
                       folder / (std::string("right") + name));
  }
  const auto views = DetectFiles(session.target, files);
  double square_sum = 0;
  std::size_t count = 0;
  for (std::size_t v = 0; v < views.size(); ++v) {
    for (const TargetPoint& point : views[v].left) {
      const auto& at = json["views"][v]["left_px"][static_cast<std::size_t>(point.index)];
      square_sum +=
          (point.pixel - Eigen::Vector2d(at[0].get<double>(), at[1].get<double>())).squaredNorm();
      ++count;
    }
  }
  EXPECT_EQ(count, 1300u);
  // Against the dots' centres; the eccentricity is part of this.
  EXPECT_LT(std::sqrt(square_sum / static_cast<double>(count)), 0.03);
  const auto calibration = Calibrate(session.target, views, Options());
  ASSERT_TRUE(calibration.ok()) << calibration.error().message;
  ExpectWithinLimits(*calibration, truth);
  EXPECT_LT(calibration->held_out_rms_px, 0.03);
  EXPECT_GE(CountInside(RigDifference(calibration->estimate, truth), calibration->covariance, 3),
            21);
}

TEST(ChessboardTest, PhotographedPairsReachOpenCvsFigures) {
  const fs::path folder = ReferenceData("opencv_stereo_calib");
  if (!fs::exists(folder / "left01.jpg")) {
    GTEST_SKIP() << NoReferenceData("opencv_stereo_calib");
  }
  CalibrationTarget target;
  target.kind = TargetKind::kChessboard;
  target.columns = 9;
  target.rows = 6;
  target.pitch_m = 1;  // squares
  std::vector<std::pair<fs::path, fs::path>> files;
  for (const int v : {1, 2, 3, 4, 5, 6, 7, 8, 9, 11, 12, 13, 14}) {
    char name[16];
    std::snprintf(name, sizeof name, "%02d.jpg", v);
    files.emplace_back(folder / (std::string("left") + name),
                       folder / (std::string("right") + name));
  }
  const auto calibration = Calibrate(target, DetectFiles(target, files), Options());
  ASSERT_TRUE(calibration.ok()) << calibration.error().message;
  EXPECT_EQ(calibration->points, 13 * 54 * 2);
  // Over all corners, those taken out included.
  double square_sum[2] = {0, 0};
  for (const auto* residuals : {&calibration->residuals, &calibration->rejected}) {
    for (const PointResidual& r : *residuals) {
      square_sum[r.side] += r.error_px.squaredNorm();
    }
  }
  EXPECT_LE(std::sqrt(square_sum[0] / (13 * 54)), 0.196);
  EXPECT_LE(std::sqrt(square_sum[1] / (13 * 54)), 0.207);
  EXPECT_LE(CheckEpipolar(*calibration).rms_px, 0.171);
  EXPECT_NEAR(calibration->baseline_m(), 3.328, 0.01);  // OpenCV's, in squares
}

/// The board is cut through its outermost squares, and OpenCV finds 8 x 6 corners in most pictures.
TEST(ChessboardTest, APartOfAPhotographedBoardIsNotTaken) {
  const fs::path folder = ReferenceData("opencv_stereo_calib");
  if (!fs::exists(folder / "left01.jpg")) {
    GTEST_SKIP() << NoReferenceData("opencv_stereo_calib");
  }
  for (const char* name :
       {"left03.jpg", "left05.jpg", "left09.jpg", "right06.jpg", "right12.jpg"}) {
    const auto picture = ReadGreyPicture(folder / name);
    ASSERT_TRUE(picture.ok()) << picture.error().message;
    for (const auto& [columns, rows] : {std::pair(8, 6), {7, 6}, {8, 5}}) {
      CalibrationTarget part;
      part.kind = TargetKind::kChessboard;
      part.columns = columns;
      part.rows = rows;
      part.pitch_m = 1;
      EXPECT_FALSE(DetectTarget(*picture, part).ok()) << name << " as " << columns << " x " << rows;
    }
  }
}

}  // namespace
}  // namespace palace
