// Two renderers, one truth, on every family of worlds: grey and depth that OpenGL draws against
// what single rays meet, from the pose, height and lens that the family's view plan draws.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "engine/world/families/families.h"
#include "engine/world/families/view_plan.h"
#include "engine/world/ray_scene.h"
#include "gui/render/lit_scene_renderer.h"
#include "tests/gui/render/gl_fixture.h"

namespace palace {
namespace {

constexpr std::uint64_t kSeed = 5;
constexpr double kMoved_s = 2;
/// Of grey: what the median pixel may differ by. Of depth: 1 cm, or as much as 0.3 px of disparity
/// are at that depth, for 99 of 100 pixels.
constexpr double kMedianGrey = 2, kDepth_m = 0.01, kDisparity_px = 0.3, kShare = 0.99;

class EveryFamily : public GlTest, public ::testing::WithParamInterface<std::string_view> {};

/// Whether two depths are one: the same sky, or as near as promised.
bool SameDepth(double a_m, double b_m, const ViewPlan& view) {
  if (std::isinf(a_m) || std::isinf(b_m)) {
    return std::isinf(a_m) == std::isinf(b_m);
  }
  const double disparity_m = kDisparity_px * b_m * b_m / (view.camera.fx_px * view.baseline_m);
  return std::abs(a_m - b_m) <= std::max(kDepth_m, disparity_m);
}

TEST_P(EveryFamily, IsTheSameByOpenGlAndByRays) {
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  const Result<World> world = MakeFamily(GetParam(), kSeed);
  ASSERT_TRUE(world.ok());
  const ViewPlan view = DrawViewPlan(GetParam(), kSeed);
  const RigidTransform X_WC = view.X_WC(world->ground.Height(0, 0));
  const RayScene scene(*world, 0.02);
  auto renderer = LitSceneRenderer::Create(scene);
  ASSERT_TRUE(renderer.ok()) << renderer.error().message;

  const Result<ImageU8> drawn = (*renderer)->Render(view.camera, X_WC, kMoved_s);
  ASSERT_TRUE(drawn.ok()) << drawn.error().message;
  const ImageF cast = scene.Grey(view.camera, X_WC, 2, kMoved_s);
  std::vector<double> off;
  for (std::size_t i = 0; i < cast.pixels().size(); ++i) {
    off.push_back(std::abs(static_cast<double>(cast.pixels()[i]) - drawn->pixels()[i]));
  }
  std::sort(off.begin(), off.end());
  const double median = off[off.size() / 2], most = off[off.size() * 99 / 100];

  const Result<ImageF> depth = (*renderer)->Depth(view.camera, X_WC, kMoved_s);
  ASSERT_TRUE(depth.ok()) << depth.error().message;
  const ImageF truth_m = scene.Depth(view.camera, X_WC, kMoved_s);
  std::size_t same = 0;
  for (std::size_t i = 0; i < truth_m.pixels().size(); ++i) {
    same += SameDepth(depth->pixels()[i], truth_m.pixels()[i], view) ? 1U : 0U;
  }
  const double share = static_cast<double>(same) / static_cast<double>(truth_m.pixels().size());
  std::printf("%-12s %4.1f m: grey median %.2f, 99 %% %.1f levels; depth %.2f %% the same\n",
              std::string(GetParam()).c_str(), view.height_m, median, most, 100 * share);
  EXPECT_LE(median, kMedianGrey);
  EXPECT_GE(share, kShare);
}

INSTANTIATE_TEST_SUITE_P(Families, EveryFamily, ::testing::ValuesIn(FamilyNames()),
                         [](const auto& family) {
                           std::string name(family.param);
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace palace
