// What stereo says about its own health, and what it refuses.
#include "engine/stereo/stereo_quality.h"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "engine/core/random.h"
#include "engine/core/units.h"
#include "tests/support/synthetic_stereo.h"

namespace palace {
namespace {

using synthetic::Pair;

constexpr double kHeight_m = 50 * kMetresPerFoot;
constexpr DisparityWindow kWindow{10, 64};

const Pair& NadirPair() {
  static const Pair pair = synthetic::MakePair({}, kHeight_m, Rad(-90), 2, 1, 0, 400, 240);
  return pair;
}

Result<StereoResult> Match(const ImageU8& left, const ImageU8& right,
                           DisparityWindow window = kWindow) {
  StereoMatcher matcher;
  return matcher.Match(left, right, NadirPair().camera, 1, window, {}, {});
}

ImageU8 MovedDown(const ImageU8& image, int rows) {
  ImageU8 moved(image.width(), image.height());
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      moved.at(x, y) = image.at(x, std::clamp(y - rows, 0, image.height() - 1));
    }
  }
  return moved;
}

TEST(StereoQuality, MeasuresAMisalignedPair) {
  const Pair& pair = NadirPair();
  const auto good = Match(pair.left, pair.right);
  ASSERT_TRUE(good.ok());
  EXPECT_LT(good->quality.row_error_px, 0.1);
  const auto bad = Match(pair.left, MovedDown(pair.right, 1));
  ASSERT_TRUE(bad.ok());
  EXPECT_NEAR(bad->quality.row_error_px, 1.0, 0.15);
}

TEST(StereoQuality, SeesExchangedCameras) {
  const Pair& pair = NadirPair();
  const auto as_given = Match(pair.left, pair.right);
  ASSERT_TRUE(as_given.ok());
  EXPECT_FALSE(as_given->quality.suspect_swapped);
  EXPECT_GT(as_given->quality.coverage, 0.7);
  const auto exchanged = Match(pair.right, pair.left);
  ASSERT_TRUE(exchanged.ok());
  EXPECT_LT(exchanged->quality.coverage, 0.1);
  EXPECT_TRUE(exchanged->quality.suspect_swapped);
}

TEST(StereoQuality, TellsWhichCameraShowsNothing) {
  const Pair& pair = NadirPair();
  const ImageU8 black(pair.left.width(), pair.left.height(), std::uint8_t{0});
  const ImageU8 white(pair.left.width(), pair.left.height(), std::uint8_t{255});
  const auto brighter = [&](double factor) {
    ImageU8 picture = pair.left;
    for (std::uint8_t& grey : picture.pixels()) {
      grey = static_cast<std::uint8_t>(std::min(255.0, factor * grey));
    }
    return picture;
  };
  const ImageU8 dim = brighter(0.5), washed_out = brighter(20);
  struct Row {
    const ImageU8 &left, &right;
    bool left_blank, right_blank;
  };
  for (const Row& row :
       {Row{pair.left, pair.right, false, false}, Row{pair.left, black, false, true},
        Row{white, pair.right, true, false}, Row{black, black, true, true},
        Row{washed_out, pair.right, true, false}, Row{dim, pair.right, false, false}}) {
    StereoQuality quality;
    SuspectPictures(row.left, row.right, quality);
    EXPECT_EQ(quality.left_blank, row.left_blank);
    EXPECT_EQ(quality.right_blank, row.right_blank);
  }
}

TEST(Stereo, GroundWithoutTextureIsUnknown) {
  ImageU8 left(400, 240, 120);
  ImageU8 right(400, 240, 120);
  RandomStream random(8);
  for (ImageU8* image : {&left, &right}) {
    for (auto& pixel : image->pixels()) {
      pixel = static_cast<std::uint8_t>(120 + std::lround(1.5 * random.Normal()));
    }
  }
  const auto result = Match(left, right);
  ASSERT_TRUE(result.ok());
  EXPECT_LT(result->quality.coverage, 0.02);
  EXPECT_FALSE(result->quality.suspect_swapped);
}

TEST(Stereo, BlackBordersAreUnknown) {
  Pair pair = NadirPair();
  for (int y = 0; y < 240; ++y) {
    for (int x = 200; x < 260; ++x) {
      pair.left.at(x, y) = 0;
      pair.right.at(x, y) = 0;
    }
  }
  const auto result = Match(pair.left, pair.right);
  ASSERT_TRUE(result.ok());
  for (int y = 0; y < 240; ++y) {
    for (int x = 202; x < 258; ++x) {
      ASSERT_TRUE(std::isnan(result->range.depth_m.at(x, y))) << x << ',' << y;
    }
  }
  EXPECT_GT(result->quality.coverage, 0.4);
}

TEST(Stereo, ColumnsLeftOfTheWindowsEndAreKept) {
  // Ground at 31.7 px: columns from 32 on have a match. OpenCV alone starts at 10 + 64.
  const auto result = Match(NadirPair().left, NadirPair().right);
  ASSERT_TRUE(result.ok());
  int known = 0;
  int wrong = 0;
  for (int y = 20; y < 220; ++y) {
    for (int x = 40; x < 74; ++x) {
      known += std::isnan(result->range.depth_m.at(x, y)) ? 0 : 1;
    }
    for (int x = 0; x < 31; ++x) {
      wrong += std::isnan(result->range.depth_m.at(x, y)) ? 0 : 1;
    }
  }
  EXPECT_LT(wrong, 0.01 * 200 * 31) << "there is no match there";
  EXPECT_GT(known, 0.95 * 200 * 34);
}

TEST(Stereo, RefusesWhatCannotBeMatched) {
  const Pair& pair = NadirPair();
  StereoMatcher matcher;
  const auto refuses = [&](const ImageU8& right, double baseline_m, DisparityWindow window) {
    const auto result = matcher.Match(pair.left, right, pair.camera, baseline_m, window, {}, {});
    return !result.ok() && result.error().code == ErrorCode::kInvalid;
  };
  EXPECT_TRUE(refuses(ImageU8(320, 240), 1, kWindow));
  EXPECT_TRUE(refuses(pair.right, 0, kWindow));
  EXPECT_TRUE(refuses(pair.right, std::nan(""), kWindow));
  EXPECT_TRUE(refuses(pair.right, 1, {0, 60}));
  EXPECT_TRUE(refuses(pair.right, 1, {-16, 64}));
  EXPECT_TRUE(refuses(pair.right, 1, {390, 64}));
  EXPECT_FALSE(refuses(pair.right, 1, {350, 64}));
}

struct WindowRow {
  const char* name;
  double height_m;
  double tilt_deg;
  double roll_deg;
};

TEST(PredictWindow, HoldsTheGroundFromFiftyFeetToTwo) {
  const PinholeCamera camera = PinholeFromFov(640, 480, Rad(45));
  for (const WindowRow& row :
       {WindowRow{"50 ft nadir", 15.24, -90, 0}, WindowRow{"50 ft slant", 15.24, -45, 0},
        WindowRow{"rolled", 15.24, -45, 12}, WindowRow{"10 ft nadir", 3.048, -90, 0},
        WindowRow{"10 ft slant", 3.048, -45, 5}, WindowRow{"300 ft", 91.4, -60, 0}}) {
    SCOPED_TRACE(row.name);
    RigidTransform X_WC;
    X_WC.R =
        RotationFromEuler({Rad(row.roll_deg), 0, 0.7}) * CameraRotationFromTilt(Rad(row.tilt_deg));
    X_WC.p = {40, -20, -row.height_m - 2};  // ground 2 m above the origin
    const DisparityWindow window = PredictWindow(camera, 1, X_WC, 2, 1, {});
    EXPECT_EQ(window.count % 16, 0);
    EXPECT_GE(window.count, StereoSettings{}.num_disparities);
    EXPECT_LE(window.count, 256);
    EXPECT_GE(window.min_px, 0);
    for (int y = 0; y < 480; y += 479) {
      for (int x = 0; x < 640; x += 639) {
        const Eigen::Vector3d ray = RayFromPixel(camera, {1.0 * x, 1.0 * y});
        const double disparity = camera.fx_px * (X_WC.R * ray).z() / row.height_m;
        EXPECT_GE(disparity, window.min_px) << x << ',' << y;
        EXPECT_LE(disparity, window.min_px + window.count - 1) << x << ',' << y;
      }
    }
  }
}

TEST(PredictWindow, ReachesToInfinityAtTheHorizonAndNeverFails) {
  const PinholeCamera camera = PinholeFromFov(640, 480, Rad(45));
  RigidTransform X_WC;
  X_WC.p = {0, 0, -15.24};
  X_WC.R = CameraRotationFromTilt(Rad(-5));
  EXPECT_EQ(PredictWindow(camera, 1, X_WC, 0, 2, {}).min_px, 0);
  X_WC.R = CameraRotationFromTilt(Rad(40));  // all sky
  const DisparityWindow sky = PredictWindow(camera, 1, X_WC, 0, 2, {});
  EXPECT_EQ(sky.min_px, 0);
  EXPECT_EQ(sky.count, StereoSettings{}.num_disparities);
  X_WC.R = CameraRotationFromTilt(Rad(-90));
  X_WC.p.z() = 3;  // below the ground it was told
  const DisparityWindow low = PredictWindow(camera, 1, X_WC, 0, 2, {});
  EXPECT_LE(low.count, 256);
  EXPECT_GE(low.min_px, 0);
}

TEST(PredictWindow, GivesUpTallObjectsBeforeTheGround) {
  const PinholeCamera camera = PinholeFromFov(640, 480, Rad(45));
  RigidTransform X_WC;
  X_WC.R = CameraRotationFromTilt(Rad(-90));
  X_WC.p = {0, 0, -2};  // ground at 386 px, a 2 m object could be anywhere above
  const DisparityWindow window = PredictWindow(camera, 1, X_WC, 0, 2, {});
  EXPECT_LE(window.min_px, 386);
  EXPECT_GT(window.min_px + window.count, 386);
  EXPECT_LE(window.count, 256);
}

}  // namespace
}  // namespace palace
