// Pictures through lenses of every family: each pixel shows what lies along its own ray, and a
// station that has the models rectifies them to what a pinhole sees.
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "engine/camera/camera_pair.h"
#include "engine/camera/rectification.h"
#include "engine/core/units.h"
#include "engine/simulation/picture_tiles.h"
#include "engine/simulation/stereo_cameras.h"
#include "engine/world/ray_pictures.h"
#include "tests/camera/sample_cameras.h"

namespace palace {
namespace {

/// A grey of each direction, smooth over some ten pixels.
double GreyAlong(const Eigen::Vector3d& ray) {
  const Eigen::Vector3d d = ray.normalized();
  return 128 + 35 * (std::sin(25 * d.x()) + std::sin(25 * d.y()) + std::sin(25 * d.z()));
}

/// Every direction has its grey, wherever the camera stands.
class SkyCamera final : public SceneCamera {
 public:
  Result<ImageU8> Render(const PinholeCamera& camera, const RigidTransform& X_WC,
                         double /*time_s*/) override {
    ImageU8 picture(camera.width, camera.height);
    for (int y = 0; y < camera.height; ++y) {
      for (int x = 0; x < camera.width; ++x) {
        const Eigen::Vector3d ray((x - camera.cx_px) / camera.fx_px,
                                  (y - camera.cy_px) / camera.fy_px, 1);
        picture.at(x, y) = static_cast<std::uint8_t>(std::lround(GreyAlong(X_WC.R * ray)));
      }
    }
    return picture;
  }
};

CameraModel Fisheye(double degrees_across) {
  OpenCvModel fisheye;
  const double f_px = 320 / Rad(degrees_across / 2);
  fisheye.pinhole = {640, 480, f_px, f_px, 322, 236};
  fisheye.lens = OpenCvLens::kFisheye;
  fisheye.coefficients = 4;
  fisheye.k = {0.01, -0.003};
  return {fisheye};
}

CameraModel Radial() {
  OpenCvModel model;
  model.pinhole = {640, 480, 560, 565, 318, 243};
  model.coefficients = 5;
  model.k = {-0.28, 0.09, 0.0008, -0.0005, 0.01};
  return {model};
}

struct Lens {
  std::string name;
  CameraModel model;
};

std::vector<Lens> LensesOfEveryFamily() {
  RandomStream random(11, "lenses");
  std::vector<Lens> lenses = {{"fisheye 180", Fisheye(180)}, {"radial", Radial()}};
  for (int family = 0; family < kFamilies; ++family) {
    const CameraModel model = RandomCamera(random, family);
    lenses.push_back({FamilyOf(model), model});
  }
  return lenses;
}

TEST(LensPictures, EveryPixelShowsItsOwnRay) {
  SkyCamera sky;
  const Eigen::Matrix3d R_WC = RotationFromEuler({0.3, -0.7, 1.1});
  for (const Lens& lens : LensesOfEveryFamily()) {
    for (const int bands : {1, 5}) {
      if (bands > 1 && lens.name != "radial") {
        continue;
      }
      SCOPED_TRACE(lens.name + ", bands " + std::to_string(bands));
      const Eigen::Matrix3d R_CF = RotationOf(lens.model);
      double worst = 0;
      int covered = 0, none = 0;
      for (const PictureTile& tile : TilesOf(RigCameraOf(lens.model), bands)) {
        const ImageU8 drawn = sky.Render(tile.camera, {R_WC * tile.R_CT, {}}, 0).value();
        ImageF drawing(drawn.width(), drawn.height());
        std::copy(drawn.pixels().begin(), drawn.pixels().end(), drawing.pixels().begin());
        const ImageF seen = ThroughLens(tile, std::move(drawing));
        covered += tile.width * tile.height;
        for (int y = 0; y < tile.height; y += 3) {
          for (int x = 0; x < tile.width; x += 3) {
            const auto ray = RayFromPixelCamera(lens.model, {tile.x + x, tile.y + y});
            if (!ray) {
              ++none;
              EXPECT_EQ(seen.at(x, y), 0);
              continue;
            }
            const double expected = GreyAlong(R_WC * (R_CF * ray->direction));
            worst = std::max(worst, std::abs(seen.at(x, y) - expected));
          }
        }
      }
      EXPECT_EQ(covered, WidthOf(lens.model) * HeightOf(lens.model)) << "each pixel once";
      EXPECT_LT(none, covered / 9 / 3);
      EXPECT_LT(worst, 1.5) << "grey levels: half a level of rounding, the rest interpolation";
    }
  }
}

TEST(LensPictures, APinholeIsDrawnAsItself) {
  RigCamera camera;
  camera.pinhole = {64, 50, 70, 71, 31.5, 24.5};
  const std::vector<PictureTile> whole = TilesOf(camera, 1), bands = TilesOf(camera, 8);
  ASSERT_EQ(whole.size(), 1u);
  EXPECT_EQ(whole[0].camera, camera.pinhole);
  int rows = 0;
  for (const PictureTile& band : bands) {
    EXPECT_EQ(band.y, rows);
    EXPECT_EQ(band.camera.cy_px, 24.5 - rows);
    rows += band.height;
  }
  EXPECT_EQ(rows, 50);
}

// Straight down on a plane 15 m below, every pixel that has a ray sees 15 m along the axis.
TEST(LensPictures, DepthThroughALensIsAlongItsAxis) {
  const RigidTransform X_WC{CameraRotationFromTilt(-Rad(90)), {0, 0, -15}};
  const ImageF depth_m = RenderDepth(World{}, RigCameraOf(Fisheye(150)), X_WC);
  ASSERT_EQ(depth_m.width(), 640);
  for (const float depth : depth_m.pixels()) {
    ASSERT_TRUE(std::isnan(depth) || std::abs(depth - 15) < 1e-4) << depth;
  }
  EXPECT_NEAR(depth_m.at(322, 236), 15, 1e-4);
}

// The whole way: two lenses that are turned against each other, pictures through them, and the
// station's own rectification. What comes out is what its pinhole sees from its place.
TEST(LensPictures, TheStationRectifiesThemToWhatAPinholeSees) {
  VehicleDescription vehicle = DefaultVehicle();
  vehicle.sensors.camera = {};
  CameraPair pair{Radial(), Radial()};
  pair.right =
      MovedCamera(pair.right, RotationFromEuler({0.01, -0.008, 0.012}), {0.5, 0.004, 0.003});
  SetCameras(vehicle.rig, pair);
  EXPECT_FALSE(vehicle.rig.rectified);
  StereoCameras cameras(vehicle, Timestamp{}, 1);
  PoseHistory history;
  const RigidTransform X_WB{RotationFromEuler({0.05, -0.1, 0.8}), {1, 2, -20}};
  history.Add(X_WB, {});
  SkyCamera sky;
  const auto frame = cameras.Deliver(sky, history, Timestamp{}).value();
  const StereoRectifier rectifier = StereoRectifier::Make(vehicle.rig).value();
  const RectifiedPair rectified = rectifier.Rectify(*frame).value();
  const Eigen::Matrix3d R_WC = (X_WB * rectifier.X_BC(vehicle.rig)).R;
  const ImageU8 expected = sky.Render(rectifier.camera(), {R_WC, {}}, 0).value();
  for (const ImageU8* picture : {rectified.left.get(), rectified.right.get()}) {
    int worst = 0;
    for (int y = 2; y < expected.height() - 2; ++y) {
      for (int x = 2; x < expected.width() - 2; ++x) {
        worst = std::max(worst, std::abs(picture->at(x, y) - expected.at(x, y)));
      }
    }
    EXPECT_LE(worst, 4) << "grey levels, both pictures: all things are far";
  }
}

}  // namespace
}  // namespace palace
