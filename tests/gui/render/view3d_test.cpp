#include <cmath>
#include <limits>

#include "engine/core/random.h"
#include "engine/core/units.h"
#include "gui/render/frustum_renderer.h"
#include "gui/render/vehicle_model.h"
#include "gui/render/view3d_renderer.h"
#include "tests/gui/render/gl_fixture.h"

namespace palace {
namespace {

constexpr int kWidth = 416, kHeight = 480;
constexpr double kAtOnce = std::numeric_limits<double>::infinity();

int Count(const ImageRgba& picture, bool (*wanted)(Rgba8)) {
  int count = 0;
  for (const Rgba8& pixel : picture.pixels()) {
    count += wanted(pixel) ? 1 : 0;
  }
  return count;
}
bool Blue(Rgba8 p) { return p.b > p.r + 40 && p.b > 90; }
bool Orange(Rgba8 p) { return p.r > p.b + 40 && p.r > 90; }
bool White(Rgba8 p) { return p.r > 225 && p.g > 225 && p.b > 225; }

View3dInput FlatMap() {
  View3dInput input;
  const GridGeometry geometry{60, 60, 0.25, -7.5, -7.5};
  auto elevation = std::make_shared<ElevationMap>();
  elevation->geometry = geometry;
  elevation->height_m = GridF(60, 60, 0.0F);
  auto hazards = std::make_shared<HazardMaps>();
  hazards->geometry = geometry;
  hazards->reasons = Grid<std::uint8_t>(60, 60, kHazardNone);
  hazards->safe_distance_m = GridF(60, 60, 2.5F);
  input.elevation = elevation;
  input.hazards = hazards;
  return input;
}

class View3dTest : public GlTest {
 protected:
  void SetUp() override {
    GlTest::SetUp();
    if (IsSkipped()) {
      return;
    }
    auto created = View3dRenderer::Create();
    ASSERT_TRUE(created.ok()) << created.error().message;
    renderer_ = std::move(created).value();
    camera_.Frame({0, 0, -15}, {0, 0, 0}, 8, 0);
    camera_.Advance(kAtOnce);
  }
  void TearDown() override { renderer_.reset(); }

  View3dLabels Draw(const View3dInput& input) {
    Result<View3dLabels> labels = renderer_->Render(input, camera_, kWidth, kHeight);
    EXPECT_TRUE(labels.ok());
    return std::move(labels).value();
  }
  std::unique_ptr<View3dRenderer> renderer_;
  OrbitCamera camera_;
};

TEST_F(View3dTest, EmptyInputShowsTheSkyGradientAndTheGrid) {
  Draw({});
  const ImageRgba picture = renderer_->Read();
  const Rgba8 top = picture.at(2, 0);
  EXPECT_NEAR(top.r, 0x0E, 1);
  EXPECT_NEAR(top.g, 0x13, 1);
  EXPECT_NEAR(top.b, 0x19, 1);
  EXPECT_EQ(Count(picture, Blue) + Count(picture, Orange), 0);
  EXPECT_GT(Count(picture, [](Rgba8 p) { return p.r > 0x1A && p.b > 0x29; }), 500);  // grid
  EXPECT_EQ(Count(picture, [](Rgba8 p) { return p.a != 255; }), 0);
}

TEST_F(View3dTest, SafeIsBlueUnsafeIsOrangeUnknownIsNeither) {
  View3dInput input = FlatMap();
  Draw(input);
  const int all_safe = Count(renderer_->Read(), Blue);
  EXPECT_GT(all_safe, 10000);
  EXPECT_EQ(Count(renderer_->Read(), Orange), 0);

  auto hazards = std::make_shared<HazardMaps>(*input.hazards);
  for (int row = 0; row < 30; ++row) {
    std::fill_n(hazards->reasons.row(row), 60, kHazardSlope);
  }
  input.hazards = hazards;
  Draw(input);
  EXPECT_GT(Count(renderer_->Read(), Orange), 2000);
  EXPECT_NEAR(Count(renderer_->Read(), Blue) / static_cast<double>(all_safe), 0.55, 0.1);

  auto unknown = std::make_shared<ElevationMap>(*input.elevation);
  unknown->height_m = GridF(60, 60, kUnknownValue);
  input.elevation = unknown;
  Draw(input);
  EXPECT_EQ(Count(renderer_->Read(), Blue) + Count(renderer_->Read(), Orange), 0);
}

TEST_F(View3dTest, NoCurtainHangsBetweenHeights) {
  View3dInput input = FlatMap();
  auto elevation = std::make_shared<ElevationMap>(*input.elevation);
  for (int row = 20; row < 28; ++row) {
    for (int col = 20; col < 28; ++col) {
      elevation->height_m.at(row, col) = 3.0F;
    }
  }
  Draw(input);
  const int flat = Count(renderer_->Read(), Blue);
  input.elevation = elevation;
  Draw(input);
  // A tower's walls would add blue; its points take some away.
  EXPECT_LT(Count(renderer_->Read(), Blue), flat);
  EXPECT_GT(Count(renderer_->Read(), Orange), 20);
}

TEST_F(View3dTest, HeightTicksStandEveryTenMetresUpTheDropLine) {
  View3dInput input = FlatMap();
  input.X_WB = RigidTransform{Eigen::Matrix3d::Identity(), {0, 0, -34}};
  camera_.Frame(input.X_WB->p, {0, 0, 0}, 8, 0);
  const View3dLabels labels = Draw(input);
  ASSERT_EQ(labels.height_ticks.size(), 3U);
  EXPECT_EQ(labels.height_ticks[0].text, "10 m");
  EXPECT_EQ(labels.height_ticks[2].text, "30 m");
  EXPECT_GT(labels.height_ticks[0].pixel.y(), labels.height_ticks[1].pixel.y());
  EXPECT_GT(labels.height_ticks[1].pixel.y(), labels.height_ticks[2].pixel.y());
  ASSERT_TRUE(labels.vehicle);
  EXPECT_LT(labels.vehicle->y(), labels.height_ticks[2].pixel.y());
}

TEST_F(View3dTest, SiteRingAndVehicleAreDrawn) {
  View3dInput input = FlatMap();
  Draw(input);
  const int before = Count(renderer_->Read(), White);
  input.site = View3dSite{{0, 0, 0}, 2.3};
  Draw(input);
  EXPECT_GT(Count(renderer_->Read(), White), before + 150);
  input.X_WB = RigidTransform{Eigen::Matrix3d::Identity(), {0, 0, -15}};
  Draw(input);
  int lit = 0;  // greys of the model stand on the dark sky
  const ImageRgba picture = renderer_->Read();
  for (int y = 0; y < kHeight / 3; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      lit += picture.at(x, y).g > 110 ? 1 : 0;
    }
  }
  EXPECT_GT(lit, 200);
}

TEST_F(View3dTest, TheVehicleIsDrawnAsWideAsItIs) {
  View3dInput input;
  input.X_WB = RigidTransform{Eigen::Matrix3d::Identity(), {0, 0, -15}};
  const auto grey = [&](double rotor_diameter_m) {
    input.rotor_diameter_m = rotor_diameter_m;
    Draw(input);
    return Count(renderer_->Read(), [](Rgba8 p) { return p.g > 110; });
  };
  Draw({});
  const int grid = Count(renderer_->Read(), [](Rgba8 p) { return p.g > 110; });
  EXPECT_GT(grey(20) - grid, 2 * (grey(10) - grid)) << "wide enough not to be enlarged";
}

TEST(VehicleModel, AMultirotorIsSymmetricAsWideAsItsPropellersAndHasNoTail) {
  double left = 0, right = 0, front = 0, back = 0, low = 0;
  for (const VehicleVertex& vertex : VehicleTriangles(VehicleBody::kMultirotor)) {
    const Eigen::Vector3d p = vertex.position_B.cast<double>();
    EXPECT_LT(p.head<2>().norm(), kRotorRadius_m);
    left = std::min(left, p.y()), right = std::max(right, p.y());
    back = std::min(back, p.x()), front = std::max(front, p.x());
    low = std::max(low, p.z());
  }
  EXPECT_NEAR(-left, right, 1e-3);
  EXPECT_NEAR(-back, front, 0.05);
  EXPECT_NEAR(low, kSkidCentre_B.z(), 0.05) << "the drop line begins there";
}

TEST_F(View3dTest, AMultirotorIsDrawnAsOne) {
  View3dInput input;
  input.X_WB = RigidTransform{Eigen::Matrix3d::Identity(), {0, 0, -15}};
  Draw(input);
  const ImageRgba helicopter = renderer_->Read();
  input.body = VehicleBody::kMultirotor;
  Draw(input);
  EXPECT_FALSE(helicopter.pixels() == renderer_->Read().pixels());
}

TEST_F(View3dTest, TheSamePictureTwice) {
  View3dInput input = FlatMap();
  input.X_WB = RigidTransform{Eigen::Matrix3d::Identity(), {-3, 1, -15}};
  Draw(input);
  const ImageRgba first = renderer_->Read();
  Draw(input);
  EXPECT_TRUE(first.pixels() == renderer_->Read().pixels());
}

TEST(FrustumFootprintTest, NadirCameraCoversARectangleOfItsFieldOfView) {
  const PinholeCamera camera{640, 480, 700, 700, 319.5, 239.5};
  const RigidTransform X_WC{CameraRotationFromTilt(Rad(-90)), {1, 2, -14}};
  const std::vector<Eigen::Vector3d> corners = FrustumFootprint(camera, X_WC, 0);
  ASSERT_EQ(corners.size(), 4U);
  EXPECT_NEAR((corners[1] - corners[0]).norm(), 14.0 * 640 / 700, 1e-9);
  EXPECT_NEAR((corners[2] - corners[1]).norm(), 14.0 * 480 / 700, 1e-9);
  for (const Eigen::Vector3d& corner : corners) {
    EXPECT_NEAR(corner.z(), 0, 1e-9);
  }
}

TEST(FrustumFootprintTest, RaysAboveTheHorizonEndAtALimit) {
  const PinholeCamera camera{640, 480, 700, 700, 319.5, 239.5};
  const RigidTransform X_WC{CameraRotationFromTilt(0), {0, 0, -5}};
  for (const Eigen::Vector3d& corner : FrustumFootprint(camera, X_WC, 0)) {
    EXPECT_LT((corner - X_WC.p).norm(), 80.01);
  }
}

TEST(OrbitCameraTest, VehicleAndGroundStayInThePicture) {
  constexpr std::uint64_t kSeed = 5;
  RandomStream random(kSeed, "orbit");
  for (int trial = 0; trial < 200; ++trial) {
    SCOPED_TRACE("seed 5, trial " + std::to_string(trial));
    OrbitCamera camera;
    const Eigen::Vector3d vehicle(random.Uniform(-40, 40), random.Uniform(-40, 40),
                                  -random.Uniform(0.5, 60));
    const Eigen::Vector3d ground(random.Uniform(-20, 20), random.Uniform(-20, 20), 0);
    camera.Frame(vehicle, ground, 6, random.Uniform(-3, 3));
    camera.SetPreset(static_cast<View3dPreset>(random.Index(3)));
    camera.Advance(kAtOnce);
    camera.Drag(random.Uniform(-400, 400), random.Uniform(-200, 200));
    const Eigen::Matrix4d clip_from_world = camera.ClipFromWorld(kWidth, kHeight);
    for (const Eigen::Vector3d& p :
         {vehicle, ground, Eigen::Vector3d(ground.x() + 6, ground.y(), 0),
          Eigen::Vector3d(vehicle.x(), vehicle.y(), 0)}) {
      const Eigen::Vector4d clip = clip_from_world * p.homogeneous();
      EXPECT_GT(clip.w(), 0);
      EXPECT_LE(std::abs(clip.x()), clip.w());
      EXPECT_LE(std::abs(clip.y()), clip.w());
    }
  }
}

TEST(OrbitCameraTest, BirdsEyeHasNorthOnTopAndEastOnTheRight) {
  OrbitCamera camera;
  camera.Frame({0, 0, -10}, {0, 0, 0}, 8, 1.2);
  camera.SetPreset(View3dPreset::kAbove);
  camera.Advance(kAtOnce);
  const Eigen::Matrix4d clip_from_world = camera.ClipFromWorld(kWidth, kHeight);
  const Eigen::Vector4d north = clip_from_world * Eigen::Vector4d(5, 0, 0, 1);
  const Eigen::Vector4d east = clip_from_world * Eigen::Vector4d(0, 5, 0, 1);
  EXPECT_LT(north.y(), 0);  // y runs down
  EXPECT_GT(east.x(), 0);
}

TEST(OrbitCameraTest, PresetIsReachedInAQuarterSecondAndLeftByHand) {
  OrbitCamera camera;
  camera.Frame({0, 0, -10}, {0, 0, 0}, 8, 0);
  camera.SetPreset(View3dPreset::kAbove);
  OrbitCamera there = camera;
  there.Advance(kAtOnce);
  for (int i = 0; i < 15; ++i) {
    camera.Advance(1 / 60.0);
  }
  EXPECT_LT((camera.eye_W() - there.eye_W()).norm(), 0.06 * there.eye_W().norm());
  EXPECT_EQ(camera.preset(), View3dPreset::kAbove);
  camera.Drag(10, 0);
  EXPECT_FALSE(camera.preset());
}

}  // namespace
}  // namespace palace
