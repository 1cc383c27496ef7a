// Two renderers, one truth: GL draws what single rays meet.
#include "gui/render/lit_scene_renderer.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/core/random.h"
#include "engine/core/units.h"
#include "engine/world/lattice_noise.h"
#include "engine/world/ray_scene.h"
#include "tests/gui/render/gl_fixture.h"

namespace palace {
namespace {

const PinholeCamera kCamera{320, 240, 386, 386, 159.5, 119.5};

World Yard() {
  World world;
  world.ground.material = Material{GroundTexture::kSoil, 3, NAN, 1, 1, 0};
  world.ground.patches = {StripPatch({4, -3}, {20, 3}, 0.2, {GroundTexture::kPaint, 5}),
                          DiscPatch(12, 5, 2, {GroundTexture::kGrass, 9})};
  world.ground.rise_north = 0.03;
  world.ground.relief = std::make_shared<const HeightField>(
      HeightField::Place{-8, -16, 32, 8}, [](double n, double e) {
        const double hole = std::hypot(n - 14, e - 4) < 0.6 ? -0.4 : 0;
        return 0.08 * FractalNoise(n, e, 11, 6, 0.5, 0.8) + hole;
      });
  const auto add = [&](Shape shape, double n, double e, double albedo) {
    world.solids.push_back(StandingOn(world.ground, std::move(shape), n, e, 0.4));
    world.solids.back().albedo = albedo;
  };
  add(Box{1.2, 0.8, 0.6}, 12, -2, 0.5);
  add(Cylinder{0.4, 1.0}, 15, 1, 0.7);
  add(Box{0.6, 0.6, 1.2}, 10, 2, 0.3);
  world.solids.back().v_WO = {0, 1, 0};
  return world;
}

class LitScene : public GlTest {};

TEST_F(LitScene, IsWhatRaysMeet) {
  const World world = Yard();
  const RayScene scene(world, 0.02);
  auto renderer = LitSceneRenderer::Create(world);
  ASSERT_TRUE(renderer.ok()) << renderer.error().message;
  struct View {
    double height_m, tilt_deg, time_s;
  };
  for (const View& view : {View{8, -45, 0}, View{15, -45, 0}, View{15, -90, 0}, View{10, -60, 3}}) {
    SCOPED_TRACE(view.height_m);
    const RigidTransform X_WC{CameraRotationFromTilt(Rad(view.tilt_deg)),
                              {view.tilt_deg < -80 ? 12.0 : 0.0, 0, -view.height_m}};
    const Result<ImageU8> drawn = (*renderer)->Render(kCamera, X_WC, view.time_s);
    ASSERT_TRUE(drawn.ok()) << drawn.error().message;
    const ImageF cast = scene.Grey(kCamera, X_WC, 2, view.time_s);
    std::vector<double> off;
    for (std::size_t i = 0; i < cast.pixels().size(); ++i) {
      off.push_back(std::abs(static_cast<double>(cast.pixels()[i]) - drawn->pixels()[i]));
    }
    std::sort(off.begin(), off.end());
    const double median = off[off.size() / 2], most = off[off.size() * 99 / 100];
    std::printf("%.0f m, %.0f deg: median %.2f, 99 %% %.1f grey levels\n", view.height_m,
                view.tilt_deg, median, most);
    EXPECT_LE(median, 2);
    EXPECT_LE(most, 25);
  }
}

TEST_F(LitScene, GroundThatIsNotDrawnIsNotSeen) {
  // Cameras inside and outside of the square (north -8 .. 24, east -16 .. 16), at its edge and over
  // the middle of its mirrored neighbours; down, slanting, along the horizon and above it; rolled.
  auto renderer = LitSceneRenderer::Create(Yard());
  ASSERT_TRUE(renderer.ok()) << renderer.error().message;
  constexpr std::uint64_t kSeed = 11;
  RandomStream random(kSeed, "cameras over a yard");
  for (int i = 0; i < 60; ++i) {
    PinholeCamera camera = kCamera;
    camera.fx_px = camera.fy_px = random.Uniform(120, 900);
    camera.cx_px += random.Uniform(-60, 60);
    const double tilt_deg = i % 4 == 0 ? -90 : i % 4 == 1 ? 0 : random.Uniform(-90, 15);
    const Eigen::Matrix3d heading =
        Eigen::AngleAxisd(random.Uniform(-3.1, 3.1), Eigen::Vector3d::UnitZ()).toRotationMatrix();
    const Eigen::Matrix3d roll =
        Eigen::AngleAxisd(random.Uniform(-0.6, 0.6), Eigen::Vector3d::UnitZ()).toRotationMatrix();
    RigidTransform X_WC{heading * CameraRotationFromTilt(Rad(tilt_deg)) * roll,
                        {random.Uniform(-45, 60), random.Uniform(-50, 50), 0}};
    if (i % 3 == 0) {
      X_WC.p.x() = -8;
    }
    X_WC.p.z() = -0.03 * X_WC.p.x() - (i % 5 == 0 ? 0.7 : random.Uniform(1.5, 40));
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", camera " + std::to_string(i));
    const Result<ImageU8> culled = (*renderer)->Render(camera, X_WC);
    const Result<ImageF> culled_m = (*renderer)->Depth(camera, X_WC);
    (*renderer)->Cull(false);
    const Result<ImageU8> whole = (*renderer)->Render(camera, X_WC);
    const Result<ImageF> whole_m = (*renderer)->Depth(camera, X_WC);
    (*renderer)->Cull(true);
    ASSERT_TRUE(culled.ok() && culled_m.ok() && whole.ok() && whole_m.ok());
    EXPECT_TRUE(culled->pixels() == whole->pixels());
    EXPECT_TRUE(culled_m->pixels() == whole_m->pixels());
  }
}

}  // namespace
}  // namespace palace
