// Pairs drawn from baked ground measure stereo as the slow pairs do. The slow ones take 64 samples
// a pixel: with 16, stones finer than a pixel alias differently in the two pictures, which makes
// stereo on gravel a quarter worse; what is baked is one ground for both.
#include <gtest/gtest.h>

#include "engine/camera/pinhole.h"
#include "engine/core/units.h"
#include "engine/stereo/accuracy.h"
#include "engine/stereo/stereo.h"
#include "engine/world/ray_pictures.h"

namespace palace {
namespace {

constexpr double kNadir_rad = -1.5707963267948966;
constexpr double kHeight_m = 10;
constexpr double kBaseline_m = 0.5;

DisparityAccuracy AccuracyOf(const World& world, const PinholeCamera& camera,
                             const RigidTransform& X_WC, bool drawn) {
  RigidTransform X_WRight = X_WC;
  X_WRight.p += X_WC.R.col(0) * kBaseline_m;
  const BakedGround ground = BakeFor(world, camera, {X_WC, X_WRight});
  const auto look = [&](const RigidTransform& X, std::uint64_t seed) {
    return Expose(drawn ? DrawGrey(world, camera, X, ground) : RenderGrey(world, camera, X, 8), {},
                  seed);
  };
  const StereoSettings settings;
  const Result<StereoResult> result =
      StereoMatcher().Match(look(X_WC, 1), look(X_WRight, 2), camera, kBaseline_m,
                            PredictWindow(camera, kBaseline_m, X_WC, 0, 1, settings), settings, {});
  PALACE_CHECK(result);
  return CompareDisparity(
      result->range.disparity_px, result->range.disparity_sigma_px,
      DisparityFromDepth(RenderDepth(world, camera, X_WC), camera.fx_px * kBaseline_m));
}

TEST(DrawnPairs, MeasureStereoAsSlowPairsDo) {
  for (const GroundTexture texture :
       {GroundTexture::kGravel, GroundTexture::kGrass, GroundTexture::kAsphalt}) {
    World world;
    world.ground.texture = texture;
    world.solids = MakeTrafficCone(0.8, 0.6, 0.711);
    world.solids.push_back(MakeBox(-1, -0.5, 0.4, 0.3, 0.15));
    const PinholeCamera camera = PinholeFromFov(240, 180, Rad(35));
    const RigidTransform X_WC{
        RotationFromEuler({0.02, -0.01, 0.6}) * CameraRotationFromTilt(kNadir_rad),
        {0, 0, -kHeight_m}};
    const DisparityAccuracy slow = AccuracyOf(world, camera, X_WC, false);
    const DisparityAccuracy drawn = AccuracyOf(world, camera, X_WC, true);
    EXPECT_NEAR(drawn.rms_px, slow.rms_px, 0.15 * slow.rms_px) << NameOf(texture);
    EXPECT_NEAR(drawn.coverage, slow.coverage, 0.01) << NameOf(texture);
    EXPECT_NEAR(drawn.normalised, slow.normalised, 0.15 * slow.normalised) << NameOf(texture);
    EXPECT_NEAR(drawn.lock_px, slow.lock_px, 0.01) << NameOf(texture);
  }
}

}  // namespace
}  // namespace palace
