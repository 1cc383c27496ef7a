// Rules of others on maps in closed form: what each takes, what each refuses. It does not prove
// that they are what their authors fly, only that they do what the header says.
#include "engine/experiments/landing_peers.h"

#include <cmath>
#include <functional>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "engine/core/units.h"

namespace palace {
namespace {

constexpr double kCell_m = 0.15, kSide_m = 15, kAbove_m = 8;
using Height = std::function<double(double north_m, double east_m)>;

/// A map of that ground about the origin, and what a camera 8 m above sees of it, straight down.
struct Seen {
  ElevationMap map;
  std::vector<FieldFrame> frames;
};
Seen Look(const Height& height) {
  const int cells = static_cast<int>(kSide_m / kCell_m);
  Seen seen;
  ElevationMap& map = seen.map;
  map.geometry = {cells, cells, kCell_m, -kSide_m / 2, -kSide_m / 2};
  map.height_m = GridF(cells, cells);
  map.variance_m2 = GridF(cells, cells, 1e-4F);
  map.state = Grid<CellState>(cells, cells, CellState::kMeasured);
  for (int r = 0; r < cells; ++r) {
    for (int c = 0; c < cells; ++c) {
      const double z = height(map.geometry.NorthOfRow(r), map.geometry.EastOfCol(c));
      map.height_m.at(r, c) = static_cast<float>(z);
      map.state.at(r, c) = std::isnan(z) ? CellState::kUnknown : CellState::kMeasured;
    }
  }
  RangeMap range;
  range.camera = {640, 640, 500, 500, 319.5, 319.5};
  range.depth_m = ImageF(640, 640);
  // Camera axes right, down, forward: up in the picture is north.
  ViewPose pose;
  pose.X_WC.R = (Eigen::Matrix3d() << 0, -1, 0, 1, 0, 0, 0, 0, 1).finished();
  pose.X_WC.p = {0, 0, -kAbove_m};
  range.pose = pose;
  for (int y = 0; y < 640; ++y) {
    for (int x = 0; x < 640; ++x) {
      // Steps towards where the ray meets the ground; its slopes are gentle.
      double depth_m = kAbove_m;
      for (int step = 0; step < 4; ++step) {
        const double z = height(-(y - 319.5) / 500 * depth_m, (x - 319.5) / 500 * depth_m);
        depth_m = kAbove_m - z;
      }
      range.depth_m.at(x, y) = static_cast<float>(depth_m);
    }
  }
  FieldFrame frame;
  frame.input.view.range = std::make_shared<const RangeMap>(std::move(range));
  seen.frames.assign(10, frame);
  return seen;
}

std::string Proposing(const Height& height) {
  const Seen seen = Look(height);
  std::string text;
  for (const PeerPlace& peer : PlacesOfPeers(seen.frames, seen.map, SladSettings{})) {
    text += std::string(peer.place_m ? peer.rule : "-") + " ";
  }
  return text;
}

TEST(PlacesOfPeers, HoldEachRulesLimits) {
  const auto sloped = [](double degrees) {
    return [=](double north_m, double) { return std::tan(Rad(degrees)) * north_m; };
  };
  const auto stepped = [](double step_m) {
    return [=](double, double east_m) { return std::fmod(std::floor(east_m) + 100, 2) * step_m; };
  };
  const struct {
    const char* what;
    Height height;
    const char* proposing;
  } grounds[] = {
      {"level", sloped(0), "raster auterion alhat px4 "},
      {"9.5 degrees", sloped(9.5), "raster - alhat px4 "},
      {"10.5 degrees", sloped(10.5), "- - - px4 "},
      // From the third row on 0.1 m off: 66 of 121 cells; from the second: 88.
      {"12 degrees", sloped(12), "- - - - "},
      // 8 cm in two cells of 15 cm are 15 degrees; on alhat's plane they rise beyond its noise.
      {"a step of 8 cm every metre", stepped(0.08), "- auterion - px4 "},
      {"a step of 16 cm every metre", stepped(0.16), "- - - - "},
      {"unknown", [](double, double) { return std::nan(""); }, "- - - - "},
  };
  for (const auto& ground : grounds) {
    EXPECT_EQ(Proposing(ground.height), ground.proposing) << ground.what;
  }
}

TEST(PlacesOfPeers, KeepAwayFromARock) {
  const Eigen::Vector2d rock_m(0.4, -0.3);
  const Seen seen = Look([&](double north_m, double east_m) {
    return (Eigen::Vector2d(north_m, east_m) - rock_m).norm() < 0.4 ? 0.3 : 0.0;
  });
  for (const PeerPlace& peer : PlacesOfPeers(seen.frames, seen.map, SladSettings{})) {
    ASSERT_TRUE(peer.place_m) << peer.rule;
    // px4 asks no more than that the rock's own cells lie beyond six others, and that near the
    // middle.
    const bool is_px4 = std::string(peer.rule) == "px4";
    EXPECT_GT((*peer.place_m - rock_m).norm(), is_px4 ? 1.4 : 2.2) << peer.rule;
    EXPECT_LT(peer.place_m->norm(), is_px4 ? 1.7 : 8) << peer.rule;
  }
}

}  // namespace
}  // namespace palace
