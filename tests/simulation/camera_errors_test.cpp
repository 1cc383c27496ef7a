// Each error of the simulated cameras against what it must be in closed form.
//
// The scene is an edge that runs north through the origin, dark to the west, seen straight down
// from 10 m with f = 500 px: a vehicle that flies east at v moves it by -50 v px/s.
#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "engine/core/units.h"
#include "engine/simulation/stereo_cameras.h"

namespace palace {
namespace {

constexpr double kHeight_m = 10, kFocal_px = 500;
constexpr int kWidth = 96, kRows = 49;
constexpr double kDark = 50, kBright = 200;
constexpr Timestamp kStart{1'000'000};
constexpr double kNow_s = 2;

/// Exact coverage of each pixel by the bright side.
class EdgeCamera final : public SceneCamera {
 public:
  Result<ImageU8> Render(const PinholeCamera& camera, const RigidTransform& X_WC,
                         double time_s) override {
    times_s.push_back(time_s);
    ImageU8 picture(camera.width, camera.height);
    const double edge_px = camera.cx_px - camera.fx_px * X_WC.p.y() / -X_WC.p.z();
    for (int y = 0; y < camera.height; ++y) {
      for (int x = 0; x < camera.width; ++x) {
        const double bright = std::clamp(x + 0.5 - edge_px, 0.0, 1.0);
        picture.at(x, y) =
            static_cast<std::uint8_t>(std::lround(kDark + (kBright - kDark) * bright));
      }
    }
    return picture;
  }
  std::vector<double> times_s;
};

class EvenCamera final : public SceneCamera {
 public:
  explicit EvenCamera(std::uint8_t grey) : grey_(grey) {}
  Result<ImageU8> Render(const PinholeCamera& camera, const RigidTransform&, double) override {
    return ImageU8(camera.width, camera.height, grey_);
  }

 private:
  std::uint8_t grey_;
};

VehicleDescription Vehicle(int width = kWidth, int height = kRows) {
  VehicleDescription vehicle = DefaultVehicle();
  vehicle.rig.tilt_rad = -Rad(90);
  vehicle.rig.position_body_m.setZero();
  vehicle.rig.baseline_m = 0;  // both see the same
  vehicle.rig.left.pinhole = {
      width, height, kFocal_px, kFocal_px, (width - 1) / 2.0, (height - 1) / 2.0};
  vehicle.rig.right = vehicle.rig.left;
  vehicle.sensors.camera = {};
  return vehicle;
}

/// Flies east at a constant speed and is over the origin at kNow_s.
PoseHistory Flying(double east_mps) {
  PoseHistory history;
  for (int i = 0; i <= 400; ++i) {
    const double t = 0.005 * i;
    VehiclePose told;
    told.time = AddSeconds(kStart, t);
    history.Add({Eigen::Matrix3d::Identity(), {0, east_mps * (t - kNow_s), -kHeight_m}}, told);
  }
  return history;
}

StereoFrame Deliver(StereoCameras& cameras, SceneCamera& scene, double east_mps = 0) {
  const auto frame = cameras.Deliver(scene, Flying(east_mps), AddSeconds(kStart, kNow_s)).value();
  return frame ? *frame : StereoFrame{};
}

StereoFrame Seen(const VehicleDescription& vehicle, double east_mps) {
  StereoCameras cameras(vehicle, kStart, 5);
  EdgeCamera scene;
  return Deliver(cameras, scene, east_mps);
}

/// Where the edge lies in a row: the dark side's length.
double EdgeOf(const ImageU8& picture, int y) {
  double dark = 0;
  for (int x = 0; x < picture.width(); ++x) {
    dark += (kBright - picture.at(x, y)) / (kBright - kDark);
  }
  return dark - 0.5;
}

struct Moments {
  double mean = 0, deviation = 0;
};
Moments MomentsOf(const ImageU8& image) {
  double sum = 0, squares = 0;
  for (const std::uint8_t pixel : image.pixels()) {
    sum += pixel;
    squares += static_cast<double>(pixel) * pixel;
  }
  const double n = static_cast<double>(image.pixels().size());
  return {sum / n, std::sqrt(squares / n - sum / n * (sum / n))};
}

TEST(CameraErrors, NoneAreAnIdealCamera) {
  const StereoFrame frame = Seen(Vehicle(), 3);
  EXPECT_EQ(frame.time, AddSeconds(kStart, kNow_s));
  EXPECT_NEAR(EdgeOf(frame.left, 0), (kWidth - 1) / 2.0, 1e-9);
  EXPECT_EQ(frame.left.pixels(), frame.right.pixels());
}

// sigma^2 = read^2 + 255 S / full well + 1/12 of rounding; mean = gain * grey + offset.
TEST(CameraErrors, GainOffsetReadAndShotNoise) {
  VehicleDescription vehicle = Vehicle(640, 480);
  CameraFigures& c = vehicle.sensors.camera;
  c.gain = 1.5;
  c.brightness_gain_right = 0.8;
  c.offset_left_grey = 10;
  c.offset_right_grey = -5;
  c.noise_grey = 2;
  c.full_well_electrons = 5000;
  EvenCamera scene(80);
  StereoCameras cameras(vehicle, kStart, 7);
  const StereoFrame frame = Deliver(cameras, scene);
  for (const auto& [picture, signal, offset] :
       {std::tuple(&frame.left, 120.0, 10.0), std::tuple(&frame.right, 96.0, -5.0)}) {
    const Moments found = MomentsOf(*picture);
    const double sigma = std::sqrt(4 + 255 * signal / 5000 + 1.0 / 12);
    const double n = 640.0 * 480;
    // The tables hold 65536 normals: their own mean and deviation are known no better than that.
    EXPECT_NEAR(found.mean, signal + offset, 5 * sigma * std::sqrt(1 / n + 1 / 65536.0));
    EXPECT_NEAR(found.deviation / sigma, 1, 5 * std::sqrt(0.5 / n + 0.5 / 65536.0));
  }
}

TEST(CameraErrors, CornersLackTheShareThatVignettingNames) {
  VehicleDescription vehicle = Vehicle();
  vehicle.sensors.camera.vignetting = 0.4;
  EvenCamera scene(200);
  StereoCameras cameras(vehicle, kStart, 7);
  const ImageU8 left = Deliver(cameras, scene).left;
  for (const int x : {0, kWidth - 1}) {
    for (const int y : {0, kRows - 1}) {
      EXPECT_EQ(left.at(x, y), 120) << x << " " << y;
    }
  }
  EXPECT_EQ(left.at(kWidth / 2, kRows / 2), 200);
}

// An edge becomes the normal distribution's integral; the edge is half a pixel wide of its own.
TEST(CameraErrors, BlurIsANormalOfThatDeviation) {
  VehicleDescription vehicle = Vehicle(97, kRows);  // the edge in the middle of a pixel
  vehicle.sensors.camera.blur_px = 3;
  const ImageU8 left = Seen(vehicle, 0).left;
  for (int x = 40; x < 57; ++x) {
    const double share = 0.5 * std::erfc(-(x - 48.0) / (std::sqrt(2.0) * std::hypot(3, 0.29)));
    EXPECT_NEAR(left.at(x, 20), kDark + (kBright - kDark) * share, 1.5) << x;
  }
}

// v = 8 m/s is 400 px/s: 20 ms smear the edge over 8 px, evenly, about where it is at the stamp.
TEST(CameraErrors, MotionBlurIsExposureTimesImageSpeed) {
  VehicleDescription vehicle = Vehicle();
  vehicle.sensors.camera.exposure_s = 0.02;
  vehicle.sensors.camera.exposure_samples = 16;
  const StereoFrame frame = Seen(vehicle, 8);
  EXPECT_NEAR(SecondsBetween(frame.time, AddSeconds(kStart, kNow_s)), 0.01, 1e-6);
  // Over the origin at now, so 0.08 m west of it at the stamp: the edge is 4 px to the right.
  const double edge_px = (kWidth - 1) / 2.0 + 4;
  EXPECT_NEAR(EdgeOf(frame.left, 3), edge_px, 0.03);
  for (int x = 0; x < kWidth; ++x) {
    const double ramp = std::clamp((x - edge_px) / 8 + 0.5, 0.0, 1.0);
    EXPECT_NEAR(frame.left.at(x, 3), kDark + (kBright - kDark) * ramp, 0.5 * (kBright - kDark) / 8)
        << x;
  }
  EXPECT_EQ(EdgeOf(Seen(vehicle, 0).left, 3), (kWidth - 1) / 2.0) << "and at rest none";
}

// Each row 100 us after the one above it, 400 px/s: the last is 48 * 0.04 px off the first.
TEST(CameraErrors, RollingShutterSkewsByLineDelayRowsAndImageSpeed) {
  VehicleDescription vehicle = Vehicle();
  CameraFigures& c = vehicle.sensors.camera;
  c.line_delay_s = 1e-4;
  c.shutter_bands = kRows;
  const StereoFrame frame = Seen(vehicle, 8);
  const double skew_px = 1e-4 * (kRows - 1) * 8 * kFocal_px / kHeight_m;
  EXPECT_NEAR(EdgeOf(frame.left, 0) - EdgeOf(frame.left, kRows - 1), skew_px, 0.02);
  EXPECT_NEAR(SecondsBetween(frame.time, AddSeconds(kStart, kNow_s)), 1e-4 * (kRows - 1) / 2, 1e-6);
  // Seven rows at a time: their middles lie on the same line.
  c.shutter_bands = 7;
  const StereoFrame banded = Seen(vehicle, 8);
  EXPECT_EQ(EdgeOf(banded.left, 0), EdgeOf(banded.left, 6));
  EXPECT_NEAR(EdgeOf(banded.left, 3), EdgeOf(frame.left, 3), 0.02);
  EXPECT_NEAR(EdgeOf(banded.left, 45), EdgeOf(frame.left, 45), 0.02);
}

TEST(CameraErrors, TheRightCameraIsLateAndTheStampIsTheLeftOnes) {
  VehicleDescription vehicle = Vehicle();
  vehicle.sensors.camera.right_late_s = 0.01;
  const StereoFrame frame = Seen(vehicle, 8);
  EXPECT_NEAR(SecondsBetween(frame.time, AddSeconds(kStart, kNow_s)), 0.01, 1e-9);
  EXPECT_NEAR(EdgeOf(frame.left, 0) - EdgeOf(frame.right, 0), 0.01 * 400, 0.01);
  vehicle.sensors.camera.right_late_s = -0.01;
  const StereoFrame early = Seen(vehicle, 8);
  EXPECT_EQ(early.time, AddSeconds(kStart, kNow_s));
  EXPECT_NEAR(EdgeOf(early.left, 0) - EdgeOf(early.right, 0), -0.01 * 400, 0.01);
}

// Delivered later; the stamp and what is seen are of the exposure, of vehicle and of what moves.
TEST(CameraErrors, LatencyDelaysDeliveryNotTheStamp) {
  VehicleDescription vehicle = Vehicle();
  vehicle.sensors.camera.latency_s = 0.123;
  StereoCameras cameras(vehicle, kStart, 5);
  EdgeCamera scene;
  const StereoFrame frame = Deliver(cameras, scene, 2);
  EXPECT_NEAR(SecondsBetween(frame.time, AddSeconds(kStart, kNow_s)), 0.123, 1e-9);
  EXPECT_NEAR(EdgeOf(frame.left, 0), (kWidth - 1) / 2.0 + 0.123 * 100, 0.01);
  EXPECT_NEAR(scene.times_s.front(), kNow_s - 0.123, 1e-9);
}

/// 3,000 pairs of an even scene with noise; empty where dropped.
std::vector<StereoFrame> Pairs(const CameraFigures& figures, std::uint64_t seed = 3) {
  VehicleDescription vehicle = Vehicle(16, 8);
  vehicle.sensors.camera = figures;
  vehicle.sensors.camera.noise_grey = 5;
  StereoCameras cameras(vehicle, kStart, seed);
  EvenCamera scene(100);
  const PoseHistory history = Flying(0);
  std::vector<StereoFrame> pairs;
  for (int i = 0; i < 3000; ++i) {
    const auto frame = cameras.Deliver(scene, history, AddSeconds(kStart, kNow_s)).value();
    pairs.push_back(frame ? *frame : StereoFrame{});
  }
  return pairs;
}

double FourSigma(double share) { return 4 * std::sqrt(share * (1 - share) / 3000); }

// And what comes is bit for bit what came without drops: each error has a stream of its own.
TEST(CameraErrors, DropsAreAsOftenAsStatedAndChangeNothingElse) {
  const std::vector<StereoFrame> whole = Pairs({}), some = Pairs({.dropped = 0.1});
  double dropped = 0;
  for (std::size_t i = 0; i < some.size(); ++i) {
    dropped += some[i].left.empty() ? 1 : 0;
    ASSERT_TRUE(some[i].left.empty() || (some[i].left.pixels() == whole[i].left.pixels() &&
                                         some[i].right.pixels() == whole[i].right.pixels()))
        << i;
  }
  EXPECT_NEAR(dropped / 3000, 0.1, FourSigma(0.1));
}

TEST(CameraErrors, RepeatsAreOfOneCameraAndAsOftenAsStated) {
  const std::vector<StereoFrame> whole = Pairs({}), some = Pairs({.repeated = 0.05});
  double left = 0, right = 0, both = 0;
  for (std::size_t i = 1; i < some.size(); ++i) {
    const bool l = some[i].left.pixels() == some[i - 1].left.pixels();
    const bool r = some[i].right.pixels() == some[i - 1].right.pixels();
    left += l, right += r, both += l && r;
    ASSERT_TRUE(l || some[i].left.pixels() == whole[i].left.pixels()) << i;
    ASSERT_TRUE(r || some[i].right.pixels() == whole[i].right.pixels()) << i;
  }
  EXPECT_NEAR(left / 3000, 0.05, FourSigma(0.05));
  EXPECT_NEAR(right / 3000, 0.05, FourSigma(0.05));
  EXPECT_NEAR(both / 3000, 0.05 * 0.05, FourSigma(0.0025)) << "the cameras do not agree on it";
}

TEST(CameraErrors, ShotNoiseLeavesReadNoiseAsItWas) {
  // So little shot noise that only pixels on the edge between two grey levels may move.
  const std::vector<StereoFrame> none = Pairs({}), faint = Pairs({.full_well_electrons = 1e7});
  const StereoFrame &a = none.back(), &b = faint.back();
  int moved = 0;
  for (std::size_t i = 0; i < a.left.pixels().size(); ++i) {
    const int by = std::abs(a.left.pixels()[i] - b.left.pixels()[i]);
    EXPECT_LE(by, 1);
    moved += by;
  }
  EXPECT_LT(moved, 16) << "of 128";
}

TEST(CameraErrors, OneSeedIsOneSequence) {
  const CameraFigures worn{.full_well_electrons = 8000,
                           .blur_px = 0.7,
                           .vignetting = 0.2,
                           .exposure_s = 0.004,
                           .line_delay_s = 3e-5,
                           .dropped = 0.03,
                           .repeated = 0.02};
  const std::vector<StereoFrame> once = Pairs(worn), twice = Pairs(worn), other = Pairs(worn, 4);
  for (std::size_t i = 0; i < once.size(); ++i) {
    ASSERT_EQ(once[i].left.pixels(), twice[i].left.pixels()) << i;
    ASSERT_EQ(once[i].right.pixels(), twice[i].right.pixels()) << i;
  }
  EXPECT_NE(once.front().left.pixels(), other.front().left.pixels());
}

}  // namespace
}  // namespace palace
