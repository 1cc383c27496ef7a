// Finding targets in rendered pictures: accuracy against the exact projection, and what is seen of
// boards that are turned, hidden, cluttered, cut off or not there.
#include "engine/calibration/target_detection.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "engine/calibration/lens.h"
#include "engine/calibration/target_sheet.h"
#include "engine/core/random.h"
#include "engine/core/units.h"
#include "engine/simulation/target_view.h"

namespace palace {
namespace {

using testing::HasSubstr;

CalibrationTarget Dots() {
  CalibrationTarget target;
  target.columns = 13;
  target.rows = 10;
  target.pitch_m = 0.09;
  target.dot_diameter_m = 0.045;
  return target;
}

CalibrationTarget Chessboard() {
  CalibrationTarget target;
  target.kind = TargetKind::kChessboard;
  target.columns = 9;
  target.rows = 6;
  target.pitch_m = 0.12;
  return target;
}

CalibrationTarget Marked() {
  CalibrationTarget target = DefaultTarget();
  const double scale = 0.1 / target.pitch_m;
  target.pitch_m *= scale;
  target.dot_diameter_m *= scale;
  target.mark_diameter_m *= scale;
  return target;
}

Lens StrongLens() {
  Lens lens;
  lens << 700, 322, 702, 236, 0.006, -0.004, -0.22, 0.07;
  return lens;
}

/// The board's middle at (x, y, z), turned about its own normal, then tilted about the axis at
/// `axis_deg` of the picture.
RigidTransform Pose(const CalibrationTarget& target, const Eigen::Vector3d& middle_C,
                    double roll_deg, double tilt_deg, double axis_deg) {
  const Eigen::Vector3d axis(std::cos(Rad(axis_deg)), std::sin(Rad(axis_deg)), 0);
  RigidTransform X_CT;
  X_CT.R = Eigen::AngleAxisd(Rad(tilt_deg), axis).toRotationMatrix() *
           Eigen::AngleAxisd(Rad(roll_deg), Eigen::Vector3d::UnitZ()).toRotationMatrix();
  X_CT.p = middle_C - X_CT.R * ((target.p_TQ(0) + target.p_TQ(target.point_count() - 1)) / 2);
  return X_CT;
}

ImageU8 Render(const CalibrationTarget& target, const RigidTransform& X_CT,
               const TargetLook& look) {
  RandomStream random(5, "noise");
  return RenderTarget(target, CahvorFromLens(StrongLens(), RigidTransform{}, 640, 480), X_CT, look,
                      random);
}

/// Root mean square of one coordinate of observed minus predicted.
double Error_px(const CalibrationTarget& target, const RigidTransform& X_CT,
                const TargetObservation& seen) {
  double sum = 0;
  for (const TargetPoint& point : seen) {
    const auto at =
        ProjectDot(StrongLens(), X_CT, target.p_TQ(point.index), target.DotDiameter_m(point.index));
    sum += (point.pixel - at->pixel).squaredNorm();
  }
  return std::sqrt(sum / (2.0 * static_cast<double>(seen.size())));
}

void Disc(ImageU8& picture, double x, double y, double radius, std::uint8_t grey) {
  for (int v = 0; v < picture.height(); ++v) {
    for (int u = 0; u < picture.width(); ++u) {
      if (std::hypot(u - x, v - y) < radius) {
        picture.at(u, v) = grey;
      }
    }
  }
}

struct View {
  const char* name;
  Eigen::Vector3d middle;
  double roll_deg;
  double tilt_deg;
  double axis_deg;
};

class SeenTarget : public testing::TestWithParam<View> {};

TEST_P(SeenTarget, DotsAreFoundToAFewHundredths) {
  const View& view = GetParam();
  const CalibrationTarget target = Dots();
  const RigidTransform X_CT =
      Pose(target, view.middle, view.roll_deg, view.tilt_deg, view.axis_deg);
  TargetLook clean;
  clean.noise_sigma = 0;
  const auto exact = DetectTarget(Render(target, X_CT, clean), target);
  ASSERT_TRUE(exact.ok()) << exact.error().message;
  EXPECT_EQ(exact->size(), 130u);
  EXPECT_LT(Error_px(target, X_CT, *exact), 0.006);  // rounding to whole grey levels
  TargetLook uneven;
  uneven.noise_sigma = 2;
  uneven.light_right = -0.4;
  uneven.light_down = 0.25;
  uneven.vignetting = 0.3;
  const auto noisy = DetectTarget(Render(target, X_CT, uneven), target);
  ASSERT_TRUE(noisy.ok()) << noisy.error().message;
  EXPECT_EQ(noisy->size(), 130u);
  EXPECT_LT(Error_px(target, X_CT, *noisy), 0.03);
}

INSTANTIATE_TEST_SUITE_P(Views, SeenTarget,
                         testing::Values(View{"Frontal", {0, 0, 2.2}, 0, 0, 0},
                                         View{"Far", {0.5, -0.4, 4.5}, 10, 20, 30},
                                         View{"Rolled", {0, 0, 2.6}, 40, 25, 0},
                                         View{"Slanted", {0, 0, 2.4}, 5, 60, 90},
                                         View{"SlantedAlongDiagonal", {0, 0, 2.4}, 0, 55, 45},
                                         View{"Steep", {0, 0, 2.4}, 0, 65, 0},
                                         View{"Corner", {-0.5, -0.3, 2.6}, -15, 30, 130}),
                         [](const auto& row) { return row.param.name; });

/// Without marks a half turn cannot be seen: the x axis is the one that points right.
TEST(DetectTargetTest, ABoardUpsideDownIsNumberedFromTheOtherEnd) {
  const CalibrationTarget target = Dots();
  const RigidTransform X_CT = Pose(target, {0, 0, 2.4}, 180, 20, 30);
  const auto seen = DetectTarget(Render(target, X_CT, {}), target);
  ASSERT_TRUE(seen.ok()) << seen.error().message;
  for (const TargetPoint& point : *seen) {
    const auto at = ProjectDot(StrongLens(), X_CT, target.p_TQ(129 - point.index), 0.045);
    EXPECT_LT((point.pixel - at->pixel).norm(), 0.2) << point.index;
  }
}

TEST(DetectTargetTest, BothCamerasNumberAlikeThoughOneIsRolled) {
  const CalibrationTarget target = Dots();
  const RigidTransform upright = Pose(target, {0, 0, 2.4}, 85, 20, 30);
  const RigidTransform past = Pose(target, {0, 0, 2.4}, 95, 20, 30);
  const auto left = DetectTarget(Render(target, upright, {}), target);
  auto right = DetectTarget(Render(target, past, {}), target);
  ASSERT_TRUE(left.ok() && right.ok());
  MatchTurn(target, *left, *right);
  const auto pixel_of = [](const TargetObservation& seen, int index) {
    return std::find_if(seen.begin(), seen.end(), [&](const auto& p) { return p.index == index; })
        ->pixel;
  };
  EXPECT_LT((pixel_of(*left, 0) - pixel_of(*right, 0)).norm(), 80);
}

TEST(DetectTargetTest, MarksTellEveryTurn) {
  const CalibrationTarget target = Marked();
  for (const double roll_deg : {0, 60, 90, 180, 270}) {
    const RigidTransform X_CT = Pose(target, {0, 0, 2.2}, roll_deg, 25, 40);
    const auto seen = DetectTarget(Render(target, X_CT, {}), target);
    ASSERT_TRUE(seen.ok()) << roll_deg << ": " << seen.error().message;
    EXPECT_EQ(seen->size(), 77u) << roll_deg;
    EXPECT_LT(Error_px(target, X_CT, *seen), 0.02) << roll_deg;
  }
}

TEST(DetectTargetTest, WithMarksAPartIsEnough) {
  const CalibrationTarget target = Marked();
  const RigidTransform X_CT = Pose(target, {0.35, 0.4, 2.0}, 10, 20, 40);
  const auto seen = DetectTarget(Render(target, X_CT, {}), target);
  ASSERT_TRUE(seen.ok()) << seen.error().message;
  EXPECT_LT(seen->size(), 77u);
  EXPECT_GT(seen->size(), 30u);
  EXPECT_LT(Error_px(target, X_CT, *seen), 0.02);
}

TEST(DetectTargetTest, AMirroredPictureIsRefused) {
  const CalibrationTarget target = Marked();
  ImageU8 picture = Render(target, Pose(target, {0, 0, 2.2}, 0, 20, 40), {});
  for (int y = 0; y < picture.height(); ++y) {
    std::reverse(picture.row(y), picture.row(y) + picture.width());
  }
  const auto seen = DetectTarget(picture, target);
  ASSERT_FALSE(seen.ok());
  EXPECT_THAT(seen.error().message, HasSubstr("mirrored"));
}

TEST(DetectTargetTest, HiddenDotsAndClutterAreSurvived) {
  const CalibrationTarget target = Dots();
  const RigidTransform X_CT = Pose(target, {0, 0, 2.6}, 15, 30, 70);
  TargetLook look;
  ImageU8 picture = Render(target, X_CT, look);
  RandomStream random(77, "clutter");
  int hidden = 0;
  for (int k = 0; k < target.point_count(); ++k) {
    if (random.Uniform() < 0.12) {
      const auto at = ProjectDot(StrongLens(), X_CT, target.p_TQ(k), 0.045);
      Disc(picture, at->pixel.x(), at->pixel.y(), 9, 210);
      ++hidden;
    }
  }
  for (int i = 0; i < 40; ++i) {
    Disc(picture, random.Uniform(5, 635), random.Uniform(5, 60), random.Uniform(2, 6),
         static_cast<std::uint8_t>(random.Uniform(0, 255)));
  }
  const auto seen = DetectTarget(picture, target);
  ASSERT_TRUE(seen.ok()) << seen.error().message;
  EXPECT_NEAR(static_cast<double>(seen->size()), 130 - hidden, 6);
  for (const TargetPoint& point : *seen) {
    const auto at = ProjectDot(StrongLens(), X_CT, target.p_TQ(point.index), 0.045);
    EXPECT_LT((point.pixel - at->pixel).norm(), 1.5) << point.index;
  }
}

TEST(DetectTargetTest, ChessboardCornersAreFoundToAFewHundredths) {
  const CalibrationTarget target = Chessboard();
  for (const double tilt_deg : {0, 35}) {
    const RigidTransform X_CT = Pose(target, {0, 0, 2.4}, 8, tilt_deg, 60);
    TargetLook look;
    look.light_right = 0.3;
    const auto seen = DetectTarget(Render(target, X_CT, look), target);
    ASSERT_TRUE(seen.ok()) << seen.error().message;
    EXPECT_EQ(seen->size(), 54u);
    EXPECT_LT(Error_px(target, X_CT, *seen), 0.05) << tilt_deg;
  }
}

struct Mismatch {
  const char* name;
  CalibrationTarget shown;
  int columns;
  int rows;
  const char* says;
};

class MismatchedTarget : public testing::TestWithParam<Mismatch> {};

TEST_P(MismatchedTarget, SaysWhatIsSeenInstead) {
  const Mismatch& mismatch = GetParam();
  const ImageU8 picture = Render(mismatch.shown, Pose(mismatch.shown, {0, 0, 2.6}, 5, 25, 40), {});
  CalibrationTarget looked_for = mismatch.shown;
  looked_for.columns = mismatch.columns;
  looked_for.rows = mismatch.rows;
  const auto seen = DetectTarget(picture, looked_for);
  ASSERT_FALSE(seen.ok());
  EXPECT_THAT(seen.error().message, HasSubstr(mismatch.says));
  EXPECT_THAT(seen.error().message, HasSubstr("the target has " + std::to_string(mismatch.columns) +
                                              " x " + std::to_string(mismatch.rows)));
}

INSTANTIATE_TEST_SUITE_P(
    Rows, MismatchedTarget,
    testing::Values(Mismatch{"LargerDots", Dots(), 12, 9, "found 13 x 10 dots"},
                    Mismatch{"OneRowMore", Dots(), 13, 9, "found 13 x 10"},
                    Mismatch{"SmallerDots", Dots(), 14, 11, "found 13 x 10"},
                    Mismatch{"PartOfColumns", Chessboard(), 8, 6, "found 9 x 6 inner corners"},
                    Mismatch{"PartOfRows", Chessboard(), 9, 5, "found 9 x 6 inner corners"},
                    Mismatch{"PartOfBoth", Chessboard(), 6, 4, "found 9 x 6 inner corners"},
                    Mismatch{"Chessboard", Chessboard(), 13, 10, "found 9 x 6 inner corners"}),
    [](const auto& row) { return row.param.name; });

/// The file's dot diameter against the picture's: right within a fifth, refused from 30 % on, near
/// and far.
TEST(DetectTargetTest, DotsOfAnotherSizeAreRefused) {
  const CalibrationTarget shown = Dots();
  for (const double distance_m : {2.2, 4.5}) {
    const ImageU8 picture = Render(shown, Pose(shown, {0, 0, distance_m}, 5, 25, 40), {});
    for (const double factor : {0.25, 0.6, 0.9, 1.0, 1.1, 1.45}) {
      CalibrationTarget told = shown;
      told.dot_diameter_m *= factor;
      const auto seen = DetectTarget(picture, told);
      EXPECT_EQ(seen.ok(), std::abs(factor - 1) < 0.2) << factor << " at " << distance_m << " m";
      if (!seen) {
        EXPECT_THAT(seen.error().message, HasSubstr("dot_diameter_m"));
      }
    }
  }
}

TEST(DetectTargetTest, PicturesWithoutATargetAreNoTarget) {
  RandomStream random(3, "noise");
  ImageU8 noise(320, 240);
  for (std::uint8_t& pixel : noise.pixels()) {
    pixel = static_cast<std::uint8_t>(random.Index(256));
  }
  for (const CalibrationTarget& target : {Dots(), Marked(), Chessboard()}) {
    EXPECT_FALSE(DetectTarget(ImageU8(640, 480, 0), target).ok());
    EXPECT_FALSE(DetectTarget(ImageU8(640, 480, 255), target).ok());
    EXPECT_FALSE(DetectTarget(noise, target).ok());
    EXPECT_FALSE(DetectTarget(ImageU8(1, 1, 7), target).ok());
    EXPECT_FALSE(DetectTarget(ImageU8(), target).ok());
    EXPECT_FALSE(DetectTarget(ImageU8(5000, 20, 99), target).ok());
  }
}

}  // namespace
}  // namespace palace
