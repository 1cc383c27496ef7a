// The simulated camera against closed-form projection: what stereo, tracker and estimator rely on.
#include "gui/render/scene_renderer.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <thread>
#include <vector>

#include <opencv2/core.hpp>

#include "engine/core/units.h"
#include "gui/platform/offscreen_scene_camera.h"
#include "tests/gui/render/gl_fixture.h"

namespace palace {
namespace {

const PinholeCamera kCamera{640, 480, 700, 700, 319.5, 239.5};

RigidTransform LookDown(double north_m, double east_m, double height_m, double tilt_deg) {
  return {CameraRotationFromTilt(Rad(tilt_deg)), {north_m, east_m, -height_m}};
}

Eigen::Vector2d Project(const PinholeCamera& camera, const RigidTransform& X_WC,
                        const Eigen::Vector3d& p_W) {
  const Eigen::Vector3d p_C = X_WC.R.transpose() * (p_W - X_WC.p);
  return {camera.fx_px * p_C.x() / p_C.z() + camera.cx_px,
          camera.fy_px * p_C.y() / p_C.z() + camera.cy_px};
}

/// Centroid of a convex polygon's area.
Eigen::Vector2d Centroid(const std::vector<Eigen::Vector2d>& corners) {
  double area = 0;
  Eigen::Vector2d sum(0, 0);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d &a = corners[i], &b = corners[(i + 1) % corners.size()];
    const double cross = a.x() * b.y() - a.y() * b.x();
    area += cross / 2;
    sum += (a + b) * cross / 6;
  }
  return sum / area;
}

Eigen::Vector2d BrightCentroid(const ImageU8& picture, const Eigen::Vector2d& near, int reach,
                               int threshold) {
  double weight = 0;
  Eigen::Vector2d sum(0, 0);
  const int cx = static_cast<int>(std::lround(near.x())),
            cy = static_cast<int>(std::lround(near.y()));
  for (int y = cy - reach; y <= cy + reach; ++y) {
    for (int x = cx - reach; x <= cx + reach; ++x) {
      if (picture.Contains(x, y) && picture.at(x, y) >= threshold) {
        weight += picture.at(x, y);
        sum += picture.at(x, y) * Eigen::Vector2d(x, y);
      }
    }
  }
  return sum / weight;
}

void Add(World& scene, Shape shape, double north_m, double east_m, double yaw_rad, double albedo) {
  scene.solids.push_back(StandingOn(scene.ground, std::move(shape), north_m, east_m, yaw_rad));
  scene.solids.back().albedo = albedo;
}

/// Black ground, white tiles 1 mm high. Each is turned a little: the edge of a straight-on tile
/// falls between the four samples of a pixel and says nothing finer than an eighth of it.
World TileScene() {
  World scene;
  scene.sun.elevation_rad = Rad(89.9);
  for (int i = -2; i <= 2; ++i) {
    for (int j = -2; j <= 2; ++j) {
      Add(scene, Box{0.9, 0.9, 0.001}, 2.6 * i, 2.3 * j, 0.31 + 0.1 * i, 1);
    }
  }
  return scene;
}
const SceneLook kPlain{0.0F, 0.0F, false};

std::vector<Eigen::Vector3d> TopCorners(const Solid& box) {
  const Box& size = std::get<Box>(box.shape);
  std::vector<Eigen::Vector3d> corners;
  for (const auto& [sx, sy] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    corners.push_back(
        box.X_WO * Eigen::Vector3d(sx * size.size_x_m / 2, sy * size.size_y_m / 2, -size.height_m));
  }
  return corners;
}

struct ViewCase {
  const char* name;
  PinholeCamera camera;
  RigidTransform X_WC;
};

std::vector<ViewCase> Views() {
  RigidTransform turned = LookDown(-9, 2, 10, -50);
  turned.R = RotationFromEuler({0.12, -0.07, -0.25}) * turned.R;
  return {{"nadir 15 m", kCamera, LookDown(0.03, -0.02, 15.24, -90)},
          {"45 degrees 15 m", kCamera, LookDown(-15.24, 0.7, 15.24, -45)},
          {"rolled and turned", kCamera, turned},
          {"unequal focal lengths, off centre",
           {800, 600, 810.3, 745.1, 371.2, 322.9},
           LookDown(-8, 1, 12, -60)}};
}

class SceneRendererTest : public GlTest {
 protected:
  static ImageU8 Shot(const World& scene, const SceneLook& look, const PinholeCamera& camera,
                      const RigidTransform& X_WC) {
    auto renderer = SceneRenderer::Create(scene, look);
    EXPECT_TRUE(renderer.ok());
    Result<ImageU8> picture = (*renderer)->Render(camera, X_WC);
    EXPECT_TRUE(picture.ok());
    return std::move(picture).value();
  }
};

TEST_F(SceneRendererTest, KnownTilesProjectWithin005Pixels) {
  const World scene = TileScene();
  auto renderer = SceneRenderer::Create(scene, kPlain);
  ASSERT_TRUE(renderer.ok());
  for (const ViewCase& view : Views()) {
    SCOPED_TRACE(view.name);
    const Result<ImageU8> picture = (*renderer)->Render(view.camera, view.X_WC);
    ASSERT_TRUE(picture.ok());
    int seen = 0;
    double worst_px = 0;
    Eigen::Vector2d sum_px(0, 0);
    for (const Solid& tile : scene.solids) {
      std::vector<Eigen::Vector2d> pixels;
      bool inside = true;
      for (const Eigen::Vector3d& corner : TopCorners(tile)) {
        pixels.push_back(Project(view.camera, view.X_WC, corner));
        inside = inside && (pixels.back().array() > 3).all() &&
                 pixels.back().x() < view.camera.width - 4 &&
                 pixels.back().y() < view.camera.height - 4;
      }
      if (!inside) {
        continue;
      }
      ++seen;
      const Eigen::Vector2d expected = Centroid(pixels);
      double reach_px = 2;
      for (const Eigen::Vector2d& pixel : pixels) {
        reach_px = std::max(reach_px, (pixel - expected).cwiseAbs().maxCoeff() + 2);
      }
      const Eigen::Vector2d found =
          BrightCentroid(*picture, expected, static_cast<int>(reach_px), 1);
      worst_px = std::max(worst_px, (found - expected).norm());
      sum_px += found - expected;
    }
    EXPECT_GE(seen, 12);
    EXPECT_LT(worst_px, 0.05);
    EXPECT_LT((sum_px / seen).norm(), 0.015) << "the whole picture is shifted";
    RecordProperty(std::string("worst_px ") + view.name, std::to_string(worst_px));
  }
}

TEST_F(SceneRendererTest, TopOfABoxLiesAtItsHeight) {
  World scene;
  scene.sun.elevation_rad = Rad(89.9);
  scene.ground.rise_north = std::tan(0.08);
  scene.ground.rise_east = std::tan(-0.05);
  Add(scene, Box{1.2, 0.9, 1.1}, 2, 3, 0.4, 1);
  const RigidTransform X_WC = LookDown(0, 0, 15, -90);
  const ImageU8 picture = Shot(scene, kPlain, kCamera, X_WC);
  std::vector<Eigen::Vector2d> pixels;
  for (const Eigen::Vector3d& corner : TopCorners(scene.solids[0])) {
    pixels.push_back(Project(kCamera, X_WC, corner));
  }
  // Only the sunlit top is brighter than 200; the sides see the sky alone.
  const Eigen::Vector2d expected = Centroid(pixels);
  EXPECT_LT((BrightCentroid(picture, expected, 60, 200) - expected).norm(), 0.15);
}

/// What experiments cut out of half-spaces is drawn as the same shapes are that GL always had.
TEST_F(SceneRendererTest, ABoxOfHalfSpacesIsDrawnAsABox) {
  World exact, cut;
  exact.sun.elevation_rad = cut.sun.elevation_rad = Rad(70);
  Add(exact, Box{1.2, 0.9, 1.1}, 2, 3, 0.4, 1);
  cut.solids = {Moved(MakeBox(0, 0, 1.2, 0.9, 1.1), 0.4, {2, 3, 0})};
  cut.solids[0].albedo = 1;
  const SceneLook plain_shaded{0.4F, 0.0F, true};
  const RigidTransform X_WC = LookDown(-3, 2, 9, -60);
  const ImageU8 a = Shot(exact, plain_shaded, kCamera, X_WC);
  const ImageU8 b = Shot(cut, plain_shaded, kCamera, X_WC);
  int apart = 0;
  for (std::size_t i = 0; i < a.pixels().size(); ++i) {
    apart += std::abs(a.pixels()[i] - b.pixels()[i]) > 3 ? 1 : 0;
  }
  EXPECT_LE(apart, 40);  // of the pixels on its edges
}

TEST_F(SceneRendererTest, RightPictureIsTheLeftShiftedByTheExactDisparity) {
  World scene;
  scene.ground.runway_markings = true;
  auto renderer = SceneRenderer::Create(scene);
  ASSERT_TRUE(renderer.ok());
  for (const double height_m : {15.24, 5.0, 1.2}) {
    for (const double tilt_deg : {-90.0, -45.0}) {
      SCOPED_TRACE(std::to_string(height_m) + " m, tilt " + std::to_string(tilt_deg));
      const RigidTransform left_X_WC = LookDown(-3, 4, height_m, tilt_deg);
      // Depth of level ground on one row; the baseline makes its disparity a whole number.
      constexpr int kRow = 300, kDisparity = 37;
      const Eigen::Vector3d ray_W =
          left_X_WC.R * Eigen::Vector3d(0, (kRow - kCamera.cy_px) / kCamera.fy_px, 1);
      const double depth_m = height_m / ray_W.z();
      RigidTransform right_X_WC = left_X_WC;
      right_X_WC.p += left_X_WC.R.col(0) * (kDisparity * depth_m / kCamera.fx_px);
      const Result<ImageU8> left = (*renderer)->Render(kCamera, left_X_WC);
      const Result<ImageU8> right = (*renderer)->Render(kCamera, right_X_WC);
      ASSERT_TRUE(left.ok() && right.ok());
      double sum = 0;
      int worst = 0;
      for (int x = kDisparity; x < kCamera.width; ++x) {
        const int difference = std::abs(left->at(x, kRow) - right->at(x - kDisparity, kRow));
        sum += difference;
        worst = std::max(worst, difference);
      }
      EXPECT_LT(sum / (kCamera.width - kDisparity), 0.5);
      EXPECT_LE(worst, 6);
    }
  }
}

TEST_F(SceneRendererTest, GrainIsRichAtEveryHeight) {
  World scene;
  auto renderer = SceneRenderer::Create(scene);
  ASSERT_TRUE(renderer.ok());
  for (const double height_m : {38.0, 15.24, 8.0, 5.0, 3.0, 1.2}) {
    for (const double tilt_deg : {-90.0, -45.0}) {
      SCOPED_TRACE(std::to_string(height_m) + " m, tilt " + std::to_string(tilt_deg));
      const Result<ImageU8> picture =
          (*renderer)->Render(kCamera, LookDown(2, -1, height_m, tilt_deg));
      ASSERT_TRUE(picture.ok());
      std::vector<double> deviations;
      for (int y = 4; y + 4 < picture->height(); y += 9) {
        for (int x = 4; x + 4 < picture->width(); x += 9) {
          double sum = 0, squares = 0;
          for (int j = -4; j <= 4; ++j) {
            for (int i = -4; i <= 4; ++i) {
              const double v = picture->at(x + i, y + j);
              sum += v;
              squares += v * v;
            }
          }
          deviations.push_back(std::sqrt(squares / 81 - sum * sum / 81 / 81));
        }
      }
      std::sort(deviations.begin(), deviations.end());
      const double median = deviations[deviations.size() / 2];
      EXPECT_GT(median, height_m > 20 ? 9.5 : 12);
      EXPECT_LT(median, 26);
      EXPECT_GT(deviations[deviations.size() / 100], 5.5);  // 99 of 100 windows
    }
  }
}

/// Repeats would show as a second peak of the autocorrelation.
TEST_F(SceneRendererTest, GrainDoesNotRepeatWithinThePicture) {
  World scene;
  auto renderer = SceneRenderer::Create(scene);
  ASSERT_TRUE(renderer.ok());
  for (const double height_m : {25.0, 15.24, 5.0, 3.0}) {
    SCOPED_TRACE(height_m);
    const Result<ImageU8> picture = (*renderer)->Render(kCamera, LookDown(1, 2, height_m, -90));
    ASSERT_TRUE(picture.ok());
    cv::Mat grey(picture->height(), picture->width(), CV_8U,
                 const_cast<std::uint8_t*>(picture->pixels().data()));
    cv::Mat field, spectrum, correlation;
    grey.convertTo(field, CV_32F);
    field -= cv::mean(field)[0];
    cv::dft(field, spectrum, cv::DFT_COMPLEX_OUTPUT);
    cv::mulSpectrums(spectrum, spectrum, spectrum, 0, true);
    cv::dft(spectrum, correlation, cv::DFT_INVERSE | cv::DFT_REAL_OUTPUT | cv::DFT_SCALE);
    const float at_zero = correlation.at<float>(0, 0);
    float second = 0;
    for (int y = 0; y < correlation.rows; ++y) {
      for (int x = 0; x < correlation.cols; ++x) {
        const int dx = std::min(x, correlation.cols - x), dy = std::min(y, correlation.rows - y);
        if (dx * dx + dy * dy > 40 * 40) {
          second = std::max(second, correlation.at<float>(y, x) / at_zero);
        }
      }
    }
    EXPECT_LT(second, 0.3F);
  }
}

TEST_F(SceneRendererTest, ShadowFallsWhereTheSunSends) {
  World scene;
  Add(scene, Cylinder{0.8, 1.5}, 0, 0, 0, 0.5);
  const SceneLook lit{0.42F, 0.0F, false};
  const SceneLook shaded{0.42F, 0.0F, true};
  const RigidTransform X_WC = LookDown(0, 0, 15, -90);
  const ImageU8 without = Shot(scene, lit, kCamera, X_WC);
  const ImageU8 with = Shot(scene, shaded, kCamera, X_WC);
  const Eigen::Vector3d sun = scene.sun.Direction();
  const auto grey = [&](const ImageU8& picture, const Eigen::Vector3d& p_W) {
    const Eigen::Vector2d pixel = Project(kCamera, X_WC, p_W);
    return static_cast<double>(picture.at(static_cast<int>(std::lround(pixel.x())),
                                          static_cast<int>(std::lround(pixel.y()))));
  };
  // The point 1 m up the axis throws its shadow 1 / tan(elevation) away from the sun.
  const Eigen::Vector3d in_shadow = -sun * (1.0 / -sun.z()) - Eigen::Vector3d(0, 0, 1);
  const Eigen::Vector3d opposite(-in_shadow.x(), -in_shadow.y(), 0);
  EXPECT_NEAR(grey(with, in_shadow) / grey(without, in_shadow),
              0.50 / (0.50 + 0.70 * std::sin(scene.sun.elevation_rad)), 0.03);
  EXPECT_EQ(grey(with, opposite), grey(without, opposite));
}

TEST_F(SceneRendererTest, SameInputGivesTheSameBits) {
  World scene = TileScene();
  Add(scene, Cone{0.5, 0.7}, 1, 1, 0, 0.5);
  Add(scene, Table{1.8, 0.8, 0.75}, -1, 1, 0.2, 0.6);
  const RigidTransform X_WC = LookDown(-6, 0, 8, -50);
  const ImageU8 first = Shot(scene, {}, kCamera, X_WC);
  const ImageU8 again = Shot(scene, {}, kCamera, X_WC);
  EXPECT_EQ(first.pixels(), again.pixels());
  scene.ground.texture_seed = 2;
  EXPECT_NE(first.pixels(), Shot(scene, {}, kCamera, X_WC).pixels());
}

TEST(OffscreenSceneCameraTest, WorksOnAThreadItWasNotMadeOn) {
  const World scene = TileScene();
  auto here = MakeOffscreenSceneCamera(scene);
  auto there = MakeOffscreenSceneCamera(scene);
  PALACE_REQUIRE_GL(here);
  PALACE_REQUIRE_GL(there);
  const RigidTransform X_WC = LookDown(0, 0, 12, -90);
  const Result<ImageU8> expected = (*here)->Render(kCamera, X_WC);
  ASSERT_TRUE(expected.ok());
  ImageU8 found;
  std::thread([&] { found = (*there)->Render(kCamera, X_WC).value(); }).join();
  EXPECT_EQ(found.pixels(), expected->pixels());
}

TEST(OffscreenSceneCameraTest, RefusesAPictureWithoutPixels) {
  auto camera = MakeOffscreenSceneCamera(World{});
  PALACE_REQUIRE_GL(camera);
  const Result<ImageU8> picture = (*camera)->Render({0, 480, 700, 700, 0, 0}, RigidTransform{});
  ASSERT_FALSE(picture.ok());
  EXPECT_NE(picture.error().message.find("0x480"), std::string::npos);
}

}  // namespace
}  // namespace palace
