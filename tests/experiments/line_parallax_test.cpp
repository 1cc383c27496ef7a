// Lines along the baseline, through stereo and SLAD: what the vehicle's own motion tells.
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "engine/camera/pinhole.h"
#include "engine/core/units.h"
#include "engine/experiments/field_trial.h"
#include "engine/slad/slad.h"
#include "engine/world/painted_things.h"

namespace palace {
namespace {

constexpr double kNorth_m = 0.3;

HoverView Hover(double height_m) {
  HoverView view;
  view.height_m = height_m;
  view.field_of_view_rad = Rad(50);
  return view;
}

/// What ten frames of a hover (moves and pose errors as experiments draw them) make of a line 3 cm
/// wide that runs along the baseline, dark unless said.
struct Told {
  int flagged = 0;  ///< cells
  int under = 0;    ///< of those straight below the line, in view
  /// … whose top is known within 40 %: the way between two views errs by 4 cm of some 30, and of
  /// all maps the highest counts.
  int with_its_height = 0;
};
Told LineAt(double up_m, const HoverView& view, GroundTexture texture, double angle_deg,
            double grey = 30) {
  World world;
  world.ground.texture = texture;
  const PinholeCamera camera =
      PinholeFromFov(view.width_px, view.height_px, view.field_of_view_rad);
  constexpr std::uint64_t kSeed = 11;
  const BakedGround ground = BakeForHover(world, view, HoverPoses(view, kSeed));
  const Eigen::Vector2d along{std::sin(Rad(angle_deg)), std::cos(Rad(angle_deg))};
  const auto point = [&](double s) {
    return Eigen::Vector3d(kNorth_m + s * along.x(), s * along.y(), -up_m);
  };
  std::uint64_t exposures = 0;
  const auto take = [&](const RigidTransform& X_WC, bool, double) -> Result<ImageU8> {
    ImageF picture = DrawGrey(world, camera, X_WC, ground);
    PaintWire({point(-30), point(30), 0.03, grey}, camera, X_WC, picture);
    return Expose(picture, {view.noise_grey}, exposures++);
  };
  const auto frames = LookFromHover(view, camera, take, StereoSettings{}, kSeed);
  EXPECT_TRUE(frames.ok());
  const Slad slad = MapOfField(*frames, SladSettings{});
  const ElevationMap& map = *slad.elevation();
  Told told;
  for (const unsigned flags : map.flags.cells()) {
    told.flagged += (flags & kFlagThinStructure) != 0 ? 1 : 0;
  }
  const double reach_m = 0.2 * view.height_m;
  for (double s = -reach_m; s <= reach_m; s += map.geometry.cell_m) {
    const Eigen::Vector3d p = point(s);
    const auto cell = map.geometry.CellFromPoint(p.x(), p.y());
    if (cell && (map.flags.at(*cell) & kFlagThinStructure) != 0) {
      ++told.under;
      told.with_its_height +=
          std::abs(double{map.thin_top_m.at(*cell)} - up_m) < 0.4 * up_m ? 1 : 0;
    }
  }
  return told;
}

class LinesAlongTheBaselineOver : public testing::TestWithParam<GroundTexture> {};

TEST_P(LinesAlongTheBaselineOver, OnePaintedOnTheGroundIsNoWireOnceTheVehicleHasMoved) {
  for (const double height_m : {8.0, 15.0}) {
    for (const double angle_deg : {0.0, 2.0}) {
      SCOPED_TRACE(testing::Message() << height_m << " m, " << angle_deg << " degrees");
      EXPECT_EQ(LineAt(0.001, Hover(height_m), GetParam(), angle_deg).flagged, 0);
    }
  }
}

TEST_P(LinesAlongTheBaselineOver, AWireIsFoundWithItsHeightOnceTheVehicleHasMoved) {
  struct Row {
    double height_m, up_m;
  };
  for (const auto& [height_m, up_m] : {Row{8, 1}, Row{12, 3}, Row{15, 1}, Row{15, 3}}) {
    SCOPED_TRACE(testing::Message() << height_m << " m, wire " << up_m << " m up");
    const Told told = LineAt(up_m, Hover(height_m), GetParam(), 0);
    EXPECT_GE(told.under, 15);
    EXPECT_GE(told.with_its_height, 0.8 * told.under);
  }
}

INSTANTIATE_TEST_SUITE_P(All, LinesAlongTheBaselineOver,
                         testing::Values(GroundTexture::kCloud, GroundTexture::kGravel,
                                         GroundTexture::kGrass, GroundTexture::kAsphalt),
                         [](const auto& texture) { return NameOf(texture.param); });

/// No strip of it stands out enough by itself; that it goes on does.
TEST(LinesAlongTheBaseline, AWireNearTheGroundsGreyIsSeenAndPaintOfThatGreyIsFreed) {
  constexpr double kFaint = 85;
  const Told wire = LineAt(3, Hover(12), GroundTexture::kAsphalt, 0, kFaint);
  EXPECT_GE(wire.under, 15);
  EXPECT_GE(wire.with_its_height, 0.8 * wire.under);
  EXPECT_EQ(LineAt(0.001, Hover(12), GroundTexture::kAsphalt, 0, kFaint).flagged, 0);
}

/// Without motion nothing tells paint from a wire: both stay flagged, of unknown height.
TEST(LinesAlongTheBaseline, AVehicleThatStandsStillTellsNothing) {
  for (const double up_m : {0.001, 3.0}) {
    HoverView still = Hover(15);
    still.drift_m = 0;
    still.position_error_m = 0;
    const Told told = LineAt(up_m, still, GroundTexture::kAsphalt, 0);
    EXPECT_GE(told.flagged, 100) << up_m;
    EXPECT_EQ(told.with_its_height, 0) << up_m;
  }
}

}  // namespace
}  // namespace palace
