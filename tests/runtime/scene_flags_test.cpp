// What pictures show beside heights, through stereo and SLAD: wires, painted
// lines, still water, somebody moving; and nothing where there is nothing.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "engine/camera/pinhole.h"
#include "engine/core/units.h"
#include "engine/slad/slad.h"
#include "engine/stereo/stereo.h"
#include "engine/world/painted_things.h"
#include "engine/world/ray_pictures.h"

namespace palace {
namespace {

constexpr double kHeight_m = 50 * kMetresPerFoot;
constexpr double kBaseline_m = 1;
constexpr double kInterval_s = 0.2;

PinholeCamera Camera() { return PinholeFromFov(640, 480, Rad(45)); }

/// Straight down over the origin, a little elsewhere in every frame.
RigidTransform PoseOf(int frame) {
  return {CameraRotationFromTilt(-Rad(90)),
          {0.03 * (frame % 3), 0.05 * (frame % 2), -kHeight_m - 0.04 * (frame % 4)}};
}

RigidTransform RightOf(const RigidTransform& X_WC) {
  return {X_WC.R, X_WC.p + kBaseline_m * X_WC.R.col(0)};
}

World FieldWithObstacles(GroundTexture texture) {
  World world;
  world.ground.texture = texture;
  world.solids = {MakeBox(2.5, -2, 0.5, 0.5, 0.5), MakeBox(-2, 2, 1.0, 2.0, 1.0),
                  MakeCone(1, 3, 0.3, 0.05, 0.7), MakeWedge(-2.5, -3, 2, 2, Rad(8))};
  return world;
}

using Paint = std::function<void(const PinholeCamera&, const RigidTransform&, ImageF&)>;
using Poses = std::function<RigidTransform(int)>;
/// Asked before each frame with the map of those before: which frame's pictures are shown.
using Showing = std::function<int(int, Slad&, const ElevationMap*)>;

struct Seen {
  std::shared_ptr<const ElevationMap> map;

  bool At(double north_m, double east_m, unsigned flag) const {
    const auto cell = map->geometry.CellFromPoint(north_m, east_m);
    return cell && (map->flags.at(*cell) & flag) != 0;
  }
  int Count(unsigned flag) const {
    return static_cast<int>(std::count_if(map->flags.cells().begin(), map->flags.cells().end(),
                                          [&](unsigned f) { return (f & flag) != 0; }));
  }
};

/// The map after some frames of a world, which may differ from frame to frame.
Seen Look(int frames, const std::function<World(int)>& world, const Paint& paint = {},
          const Poses& pose_of = PoseOf, const Showing& showing = {}) {
  Slad slad;
  const PinholeCamera camera = Camera();
  const BakedGround ground = BakeFor(world(0), camera, {pose_of(0), RightOf(pose_of(5))});
  for (int k = 0; k < frames; ++k) {
    const RigidTransform X_WC = pose_of(k);
    const RigidTransform X_WShown = pose_of(showing ? showing(k, slad, slad.elevation().get()) : k);
    std::array<std::shared_ptr<const ImageU8>, 2> pictures;
    for (const bool right : {false, true}) {
      const RigidTransform X = right ? RightOf(X_WShown) : X_WShown;
      ImageF grey = DrawGrey(world(k), camera, X, ground);
      if (paint) {
        paint(camera, X, grey);
      }
      pictures[right] = std::make_shared<const ImageU8>(
          Expose(grey, {2}, static_cast<std::uint64_t>(2 * k + right)));
    }
    StereoMatcher matcher;
    const StereoSettings settings;
    auto stereo = matcher.Match(*pictures[0], *pictures[1], camera, kBaseline_m,
                                PredictWindow(camera, kBaseline_m, X_WC, 0, 3, settings), settings,
                                AddSeconds({}, k * kInterval_s));
    EXPECT_TRUE(stereo.ok());
    stereo->range.pose = ViewPose{X_WC};
    slad.Add({.view = {pictures[0], pictures[1],
                       std::make_shared<const RangeMap>(std::move(stereo->range))},
              .p_WB = X_WC.p},
             SladSettings{});
  }
  return {slad.elevation()};
}

class SceneFlagsOn : public testing::TestWithParam<GroundTexture> {};

TEST_P(SceneFlagsOn, NothingIsFlaggedWhereThereIsNothing) {
  const World world = FieldWithObstacles(GetParam());
  const Seen seen = Look(4, [&](int) { return world; });
  EXPECT_EQ(seen.Count(kFlagThinStructure | kFlagNoTexture | kFlagMotion), 0);
}

/// Soil from 4 m: patches of a decimetre, 3 grey levels, over many pixels. Stereo measures them,
/// but for the picture's rim.
TEST(SceneFlags, FaintTextureSeenFromCloseByIsTextureUpToTheRimOfThePicture) {
  const auto soil = [](const PinholeCamera& camera, const RigidTransform& X_WC, ImageF& picture) {
    for (int y = 0; y < picture.height(); ++y) {
      for (int x = 0; x < picture.width(); ++x) {
        const Eigen::Vector3d ray =
            X_WC.R * RayFromPixel(camera, {static_cast<double>(x), static_cast<double>(y)});
        const Eigen::Vector3d p = X_WC.p - X_WC.p.z() / ray.z() * ray;
        const double wave = std::sin(47 * p.x() + 11 * p.y()) + std::sin(53 * p.y() - 7 * p.x()) +
                            std::sin(29 * p.x() - 31 * p.y()) + std::sin(17 * p.x() + 23 * p.y());
        picture.at(x, y) = static_cast<float>(80 + 2.2 * wave);
      }
    }
  };
  const auto low = [](int frame) {
    return RigidTransform{CameraRotationFromTilt(-Rad(45)), {0.05 * frame, 0, -4.2}};
  };
  const Seen seen = Look(
      4, [](int) { return World{}; }, soil, low);
  EXPECT_EQ(seen.Count(kFlagNoTexture), 0);
}

/// A wire 2 cm thick, 3 m above the ground, and a line of the same width painted beside it.
TEST_P(SceneFlagsOn, AWireIsFlaggedAPaintedLineIsNot) {
  const World world = FieldWithObstacles(GetParam());
  for (const double grey : {40.0, 220.0}) {
    const Seen seen = Look(
        2, [&](int) { return world; },
        [&](const PinholeCamera& camera, const RigidTransform& X_WC, ImageF& picture) {
          PaintWire({{-9, 1, -0.001}, {9, 3, -0.001}, 0.02, grey}, camera, X_WC, picture);
          PaintWire({{-9, -2, -3}, {9, 1, -3}, 0.02, grey}, camera, X_WC, picture);
        });
    int under = 0, flagged = 0;
    for (double north_m = -3; north_m <= 3; north_m += 0.1) {
      ++under;
      flagged += seen.At(north_m, -2 + (north_m + 9) / 6, kFlagThinStructure) ? 1 : 0;
      EXPECT_FALSE(seen.At(north_m, 1 + (north_m + 9) / 9, kFlagThinStructure)) << north_m;
    }
    EXPECT_GE(flagged, 0.6 * under) << grey;
    EXPECT_LE(seen.Count(kFlagThinStructure), 4 * 60);
  }
}

TEST_P(SceneFlagsOn, StillWaterHasNoTexture) {
  const World world = FieldWithObstacles(GetParam());
  const Seen seen = Look(
      2, [&](int) { return world; },
      [&](const PinholeCamera& camera, const RigidTransform& X_WC, ImageF& picture) {
        PaintPool({0.3, -0.2, 0.8, 90}, camera, X_WC, picture);
      });
  EXPECT_TRUE(seen.At(0.3, -0.2, kFlagNoTexture));
  EXPECT_FALSE(seen.At(0.3, -1.6, kFlagNoTexture));
  const double area_m2 = seen.Count(kFlagNoTexture) * std::pow(seen.map->geometry.cell_m, 2);
  EXPECT_NEAR(area_m2, 3.14 * 0.8 * 0.8, 0.9);
}

/// Half a metre wide, 1.6 m tall, 0.5 m/s to the east.
TEST_P(SceneFlagsOn, SomebodyWalkingIsFlaggedAndSomebodyStandingIsNot) {
  for (const double speed_mps : {0.5, 0.0}) {
    const Seen seen = Look(6, [&](int frame) {
      World world = FieldWithObstacles(GetParam());
      const double east_m = -0.8 + speed_mps * kInterval_s * frame;
      world.solids.push_back(MakeBox(0, east_m, 0.5, 0.5, 1.6));
      return world;
    });
    if (speed_mps > 0) {
      EXPECT_TRUE(seen.At(0, -0.8 + 5 * speed_mps * kInterval_s, kFlagMotion));
      EXPECT_LE(seen.Count(kFlagMotion), 60);
    } else {
      EXPECT_EQ(seen.Count(kFlagMotion), 0);
    }
  }
}

/// Navigation errs by decimetres and tenths of a degree from frame to frame: the ground stays where
/// it is, and who walks over it is still told from it.
TEST(SceneFlags, PosesThatErrSetNoGroundInMotion) {
  constexpr int kTruth = 100;
  const auto pose_of = [](int frame) {
    RigidTransform X_WC = PoseOf(frame % kTruth);
    if (frame < kTruth) {
      const double side = frame % 2 == 0 ? 1 : -1;
      X_WC.R = RotationFromEuler({Rad(0.15) * side, -Rad(0.1) * (frame % 3), 0}) * X_WC.R;
      X_WC.p += Eigen::Vector3d(0.1 * side, 0.05 * (frame % 3), 0.15 * side);
    }
    return X_WC;
  };
  const auto shown = [](int frame, Slad&, const ElevationMap*) { return kTruth + frame; };
  for (const double speed_mps : {0.0, 0.5}) {
    const auto world = [&](int frame) {
      World now = FieldWithObstacles(GroundTexture::kGravel);
      now.solids.push_back(MakeBox(0, -0.8 + speed_mps * kInterval_s * frame, 0.5, 0.5, 1.6));
      return now;
    };
    const Seen seen = Look(8, world, {}, pose_of, shown);
    if (speed_mps > 0) {
      EXPECT_GT(seen.Count(kFlagMotion), 0);
      EXPECT_LE(seen.Count(kFlagMotion), 80);
    } else {
      EXPECT_EQ(seen.Count(kFlagMotion), 0);
    }
  }
}

/// The cameras repeat a picture through noise while the vehicle drifts 0.2 m a frame; then they are
/// said to, and it flies on. Cells in motion afterwards, the most of any map.
int InMotionAfterRepeats(bool doubted) {
  constexpr int kFrom = 3, kTo = 9, kFrames = 15;
  const auto pose_of = [](int frame) {
    RigidTransform X_WC = PoseOf(0);
    X_WC.p.x() += 0.2 * frame;
    return X_WC;
  };
  const World world = FieldWithObstacles(GroundTexture::kGravel);
  int most = 0;
  Look(
      kFrames, [&](int) { return world; }, {}, pose_of,
      [&](int frame, Slad& slad, const ElevationMap* map) {
        if (frame == kTo && doubted) {
          slad.DoubtViews();
        }
        if (map != nullptr && frame > kTo) {
          most = std::max(most, Seen{std::make_shared<ElevationMap>(*map)}.Count(kFlagMotion));
        }
        return frame >= kFrom && frame < kTo ? kFrom : frame;  // the picture that is shown
      });
  return most;
}

TEST(SceneFlags, GroundIsNotInMotionAgainstPicturesThatWereRepeats) {
  EXPECT_EQ(InMotionAfterRepeats(/*doubted=*/true), 0);
  EXPECT_GT(InMotionAfterRepeats(/*doubted=*/false), 100) << "or this shows nothing";
}

INSTANTIATE_TEST_SUITE_P(All, SceneFlagsOn,
                         testing::Values(GroundTexture::kCloud, GroundTexture::kGravel,
                                         GroundTexture::kGrass, GroundTexture::kAsphalt),
                         [](const auto& texture) { return NameOf(texture.param); });

/// Faint: stereo measures it at half the size, and texture is asked there too.
TEST(SceneFlags, SnowIsNotTakenForWater) {
  const World world = FieldWithObstacles(GroundTexture::kSnow);
  const Seen bare = Look(4, [&](int) { return world; });
  EXPECT_EQ(bare.Count(kFlagThinStructure | kFlagNoTexture | kFlagMotion), 0);
  const Seen seen = Look(
      2, [&](int) { return world; },
      [&](const PinholeCamera& camera, const RigidTransform& X_WC, ImageF& picture) {
        PaintPool({0.3, -0.2, 0.8, 90}, camera, X_WC, picture);
      });
  EXPECT_TRUE(seen.At(0.3, -0.2, kFlagNoTexture));
  EXPECT_FALSE(seen.At(0.3, -1.9, kFlagNoTexture));
}

/// Over faint ground the wire is the strongest texture: stereo measures it, windows wide, as a
/// thing that stands there, and where it does not the line is flagged.
TEST(SceneFlags, AWireOverSnowStandsInTheHeightsOrIsFlagged) {
  const World world = FieldWithObstacles(GroundTexture::kSnow);
  const Seen seen = Look(
      4, [&](int) { return world; },
      [&](const PinholeCamera& camera, const RigidTransform& X_WC, ImageF& picture) {
        PaintWire({{-9, -2, -3}, {9, 1, -3}, 0.02, 40}, camera, X_WC, picture);
      });
  int under = 0, told = 0, gap = 0, widest = 0;
  for (double north_m = -3; north_m <= 3; north_m += 0.3) {
    ++under;
    bool found = false;
    for (const double aside_m : {-0.15, 0.0, 0.15}) {
      const auto cell = seen.map->geometry.CellFromPoint(north_m, -2 + (north_m + 9) / 6 + aside_m);
      found |= cell && (seen.map->height_m.at(*cell) > 2 ||
                        (seen.map->flags.at(*cell) & kFlagThinStructure) != 0);
    }
    told += found ? 1 : 0;
    gap = found ? 0 : gap + 1;
    widest = std::max(widest, gap);
  }
  EXPECT_GE(told, 0.75 * under) << told << " of " << under;
  EXPECT_LE(widest, 2) << "places 0.3 m apart: a clear radius bridges them";
}

/// A wire found from above is not forgotten when the camera sinks to where it is too near to be
/// found, over ground that is in view; one that would still show there, and does not, is.
TEST(SceneFlags, AWireThatIsTooNearToBeFoundStands) {
  const World world = FieldWithObstacles(GroundTexture::kAsphalt);
  constexpr double kLow_m = 10;  // the ground is far enough, what is 4 m up is not
  const Poses sinking = [](int frame) {
    RigidTransform X_WC = PoseOf(frame);
    X_WC.p.z() += frame < 3 ? 0 : kHeight_m - kLow_m;
    return X_WC;
  };
  for (const double up_m : {4.0, 1.5}) {
    const Seen seen = Look(
        3 + 23, [&](int) { return world; },
        [&](const PinholeCamera& camera, const RigidTransform& X_WC, ImageF& picture) {
          if (-X_WC.p.z() > kLow_m + 1) {
            PaintWire({{-12, 0, -up_m}, {12, 0, -up_m}, 0.02, 30}, camera, X_WC, picture);
          }
        },
        sinking);
    EXPECT_EQ(seen.At(0.4, 0, kFlagThinStructure), up_m > 3) << up_m << " m up";
  }
}

/// Along the baseline a wire shows no disparity: it is flagged on the ground behind it.
TEST(SceneFlags, AWireAlongTheBaselineIsFlaggedWithoutItsHeight) {
  const World world = FieldWithObstacles(GroundTexture::kAsphalt);
  const Seen seen = Look(
      2, [&](int) { return world; },
      [&](const PinholeCamera& camera, const RigidTransform& X_WC, ImageF& picture) {
        PaintWire({{0.2, -12, -2}, {0.2, 12, -2}, 0.02, 30}, camera, X_WC, picture);
      });
  EXPECT_TRUE(seen.At(0.2, 0.0, kFlagThinStructure));
}

/// At any angle to the baseline, high and higher: the ground under it is flagged along most of it.
/// A line painted at the same angle is not, unless it runs along the baseline, where nothing tells
/// the two apart.
TEST(SceneFlags, AWireIsFoundAtEveryAngleToTheBaseline) {
  const World world = FieldWithObstacles(GroundTexture::kAsphalt);
  constexpr double kToldFromPaint_deg = 5;
  for (const double angle_deg : {2.0, 4.0, 6.0, 9.0, -9.0, 13.0, 20.0, -20.0, 30.0, 60.0, 90.0}) {
    for (const double up_m : {0.001, 3.0, 6.0}) {
      SCOPED_TRACE(std::to_string(angle_deg) + " degrees, " + std::to_string(up_m) + " m up");
      const Eigen::Vector2d along{std::sin(Rad(angle_deg)), std::cos(Rad(angle_deg))};
      const Eigen::Vector2d middle{0.3, 0};
      const auto point = [&](double s) {
        const Eigen::Vector2d p = middle + s * along;
        return Eigen::Vector3d(p.x(), p.y(), -up_m);
      };
      const Seen seen = Look(
          2, [&](int) { return world; },
          [&](const PinholeCamera& camera, const RigidTransform& X_WC, ImageF& picture) {
            PaintWire({point(-12), point(12), 0.02, 30}, camera, X_WC, picture);
          });
      int under = 0, flagged = 0, high = 0;
      for (double s = -2.5; s <= 2.5; s += 0.1) {
        const Eigen::Vector3d p = point(s);
        ++under;
        if (seen.At(p.x(), p.y(), kFlagThinStructure)) {
          ++flagged;
          const auto cell = seen.map->geometry.CellFromPoint(p.x(), p.y());
          high += std::abs(seen.map->thin_top_m.at(*cell) - up_m) < 1 ? 1 : 0;
        }
      }
      const bool has_height = std::abs(angle_deg) > kToldFromPaint_deg;
      if (up_m > 1) {
        EXPECT_GE(flagged, 0.8 * under);
        EXPECT_GE(high, has_height ? 0.8 * flagged : 0) << flagged;
      } else if (has_height) {
        EXPECT_EQ(seen.Count(kFlagThinStructure), 0);
      }
    }
  }
}

TEST(SceneFlags, SameBitsForAnyNumberOfThreads) {
  const World world = FieldWithObstacles(GroundTexture::kGrass);
  const auto look = [&] {
    return Look(
        2, [&](int) { return world; },
        [&](const PinholeCamera& camera, const RigidTransform& X_WC, ImageF& picture) {
          PaintWire({{-9, -2, -3}, {9, 1, -3}, 0.02, 40}, camera, X_WC, picture);
        });
  };
  const int threads = cv::getNumThreads();
  cv::setNumThreads(1);
  const Seen one = look();
  cv::setNumThreads(2);
  const Seen two = look();
  cv::setNumThreads(threads);
  EXPECT_EQ(one.map->flags.cells(), two.map->flags.cells());
  EXPECT_GT(one.Count(kFlagThinStructure), 0);
}

TEST(SceneFlags, PicturesThatMakeNoSenseFlagNothing) {
  const GridGeometry geometry{20, 20, 0.15, -1.5, -1.5};
  const auto picture = [](int w, int h) { return std::make_shared<const ImageU8>(w, h, 100); };
  const auto range = [](int w, int h, float disparity_px, double baseline_m = 1) {
    const ImageF layer(w, h, disparity_px);
    RangeMap made{{},   PinholeFromFov(std::max(1, w), std::max(1, h), 1), layer, layer, layer,
                  layer};
    made.baseline_m = baseline_m;
    made.pose = ViewPose{PoseOf(0)};
    return std::make_shared<RangeMap>(std::move(made));
  };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const auto without_pose = range(67, 65, 9);
  without_pose->pose.reset();
  const std::vector<SceneView> views = {
      {nullptr, nullptr, nullptr},
      {picture(640, 480), picture(640, 480), nullptr},
      {picture(0, 0), picture(0, 0), range(0, 0, 1)},
      {picture(1, 1), picture(1, 1), range(1, 1, 1)},
      {picture(67, 65), picture(64, 65), range(67, 65, 9)},
      {picture(67, 65), picture(67, 65), range(67, 65, nan)},
      {picture(67, 65), picture(67, 65), range(67, 65, 0)},
      {picture(67, 65), picture(67, 65), range(67, 65, -3)},
      {picture(67, 65), picture(67, 65), range(67, 65, 1e30F)},
      {picture(67, 65), picture(67, 65), without_pose},
      {picture(67, 65), picture(67, 65), range(67, 65, 9, 0)},
      {picture(67, 65), picture(67, 65), range(67, 65, 9, double(nan))}};
  for (std::size_t k = 0; k < views.size(); ++k) {
    SceneFlags flags;
    for (int map = 0; map < 3; ++map) {
      const Grid<std::uint8_t> found = flags.Add(views[k], geometry);
      EXPECT_EQ(found.rows(), geometry.rows) << k;
      EXPECT_TRUE(std::all_of(found.cells().begin(), found.cells().end(), [](unsigned f) {
        return (f & kFlagThinStructure) == 0;
      })) << k;
    }
  }
  SceneFlags flags;
  EXPECT_TRUE(flags.Add(views.back(), GridGeometry{0, 0, 0.15, 0, 0}).empty());
}

}  // namespace
}  // namespace palace
