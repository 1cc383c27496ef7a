// Worlds with other people's meshes and elevation models: they stand and rise where the world file
// says, and what cannot be flown is named, with the world file's line.
#include "engine/world/imported.h"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "engine/world/ground_truth.h"
#include "engine/world/world_file.h"
#include "tests/support/own_path.h"
#include "tests/support/survey_files.h"

namespace palace {
namespace {

using ::testing::HasSubstr;

/// A block 1 m east-west, 2 m north-south and 0.5 m high on its origin's plane, as OBJ, z up.
std::string Block() {
  std::string text;
  for (const double z : {0.0, 0.5}) {
    for (const auto& [x, y] : {std::pair(-0.5, -1.0), {0.5, -1.0}, {0.5, 1.0}, {-0.5, 1.0}}) {
      text += "v " + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + "\n";
    }
  }
  return text + "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
}

/// Heights 500 + 0.02 north + 0.01 east over a square of `cells` metres, 1 m a cell.
TiffFile Slope(int cells) {
  std::vector<float> heights;
  for (int row = 0; row < cells; ++row) {
    for (int col = 0; col < cells; ++col) {
      const double north = cells - 0.5 - row, east = col + 0.5;
      heights.push_back(static_cast<float>(500 + 0.02 * north + 0.01 * east));
    }
  }
  return {.cols = cells, .rows = cells, .cells = BytesOf(heights)};
}

class Imported : public testing::Test {
 protected:
  Imported() { std::filesystem::create_directories(folder_); }
  ~Imported() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  void Write(const std::string& name, const std::string& bytes) {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
  }
  Result<World> Load(const std::string& text) {
    Write("world.toml", text);
    return LoadWorld(folder_ / "world.toml");
  }
  const std::filesystem::path folder_ = OwnPath();
};

TEST_F(Imported, AMeshStandsWhereItIsPut) {
  Write("block.obj", Block());
  const Result<World> world = Load("[[mesh]]\nfile = \"block.obj\"\nat = [10, 4]\n");
  ASSERT_TRUE(world.ok()) << world.error().message;
  const GroundTruth truth = TruthOf(*world);
  const auto height = [&](double north, double east) {
    const auto cell = truth.geometry.CellFromPoint(north, east);
    return cell ? static_cast<double>(truth.height_m.at(*cell)) : NAN;
  };
  // 2 m along north, 1 m along east, and nothing beside it.
  EXPECT_NEAR(height(10.9, 4), 0.5, 1e-4);
  EXPECT_NEAR(height(10, 4.4), 0.5, 1e-4);
  EXPECT_NEAR(height(11.1, 4), 0, 1e-4);
  EXPECT_NEAR(height(10, 4.6), 0, 1e-4);
}

TEST_F(Imported, ScaleTurnAndAxesAreTheFiles) {
  // The same block with y up, in centimetres: x east, z south.
  std::string y_up;
  for (const double y : {0.0, 50.0}) {
    for (const auto& [x, z] : {std::pair(-50, 100), {50, 100}, {50, -100}, {-50, -100}}) {
      y_up += "v " + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + "\n";
    }
  }
  Write("block.obj", y_up + "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
  const Result<World> world = Load(
      "[[mesh]]\nfile = \"block.obj\"\nat = [10, 4]\nscale = 0.01\ny_up = true\n"
      "turn_deg = 90\n");
  ASSERT_TRUE(world.ok()) << world.error().message;
  ASSERT_EQ(world->solids.size(), 1U);
  const Solid& solid = world->solids[0];
  EXPECT_NEAR(DistanceFromAbove(solid, 10, 4.9), 0, 1e-9);  // turned: 2 m along east now
  EXPECT_NEAR(DistanceFromAbove(solid, 10, 5.25), 0.25, 1e-6);
  EXPECT_NEAR(DistanceFromAbove(solid, 10.75, 4), 0.25, 1e-6);
  EXPECT_NEAR(Enter(solid, {10, 4, -10}, {0, 0, 1}), 9.5, 1e-6);
}

TEST_F(Imported, AnElevationModelIsTheRelief) {
  Write("dem.tif", TiffBytes(Slope(80), {{1024, 1}, {3072, 32633}}));
  const Result<World> world = Load("[relief]\nfile = \"dem.tif\"\n");
  ASSERT_TRUE(world.ok()) << world.error().message;
  EXPECT_NEAR(world->ground.Height(0, 0), 0, 1e-4);
  EXPECT_NEAR(world->ground.Height(20, 5), 0.02 * 20 + 0.01 * 5, 1e-3);
  EXPECT_NEAR(world->ground.Height(-10, -20), -0.02 * 10 - 0.01 * 20, 1e-3);
}

TEST_F(Imported, HolesAreCutIntoAnElevationModel) {
  Write("dem.tif", TiffBytes(Slope(80), {{1024, 1}, {3072, 32633}}));
  const Result<World> world =
      Load("[relief]\nfile = \"dem.tif\"\n[[hole]]\nat = [12, 0]\ndiameter_m = 1\ndepth_m = 0.4\n");
  ASSERT_TRUE(world.ok()) << world.error().message;
  EXPECT_NEAR(world->ground.Height(12, 0), 0.24 - 0.4, 1e-3);
}

TEST_F(Imported, WhatCannotBeFlownIsNamedWithItsLine) {
  std::string open = Block();
  open.resize(open.rfind("f 4 1"));
  Write("open.obj", open);
  Write("empty.obj", "");
  Write("block.obj", Block());
  Write("small.tif", TiffBytes(Slope(40), {{1024, 1}, {3072, 32633}}));
  TiffFile nowhere = Slope(80);
  nowhere.scale.clear();
  nowhere.tie.clear();
  Write("nowhere.tif", TiffBytes(nowhere, {}));
  TiffFile holes = Slope(80);
  const std::string unknown = BytesOf<float>({-9999});
  holes.cells.replace(4 * (80 * 30 + 30), unknown.size(), unknown);
  holes.no_data = "-9999";
  Write("holes.tif", TiffBytes(holes, {{1024, 1}, {3072, 32633}}));
  const struct {
    const char* world;
    std::vector<const char*> says;
  } table[] = {
      {"[[mesh]]\nat = [10, 4]\nfile = \"open.obj\"\n",
       {"world.toml:3: mesh.file: ", "open.obj: is open: 4 edges", "open = true"}},
      {"[[mesh]]\nat = [10, 4]\nfile = \"empty.obj\"\n", {":3: mesh.file: ", "has no triangles"}},
      {"[[mesh]]\nat = [10, 4]\nfile = \"none.obj\"\n", {":3: ", "none.obj: no such file"}},
      {"[[mesh]]\nat = [10, 4]\nfile = \"block.obj\"\nscale = 100\n",
       {"reaches over", "the limit is 100 m"}},
      {"[[mesh]]\nat = [10, 4]\nfile = \"block.obj\"\nscale = 0\n", {":4: ", "0.0001", "1000"}},
      {"[[mesh]]\nat = [10, 4]\nfile = \"block.obj\"\nsize = 3\n", {":4: ", "size"}},
      {"[relief]\nfile = \"small.tif\"\n",
       {":2: relief.file: ", "lies over north -4.0 to 36.0 m", "needs north -16.0 to 48.0 m"}},
      {"[relief]\nfile = \"nowhere.tif\"\n", {":2: ", "no GeoTIFF pixel scale"}},
      {"[relief]\nfile = \"holes.tif\"\n", {":2: ", "are unknown in it", "gdal_fillnodata"}},
      {"[relief]\nrms_m = 0.1\nat = [0, 0]\n", {":3: relief.at", "there is no file"}},
  };
  for (const auto& row : table) {
    const Result<World> world = Load(row.world);
    ASSERT_FALSE(world.ok()) << row.world;
    for (const char* says : row.says) {
      EXPECT_THAT(world.error().message, HasSubstr(says)) << row.world;
    }
  }
}

TEST_F(Imported, AnOpenMeshMayBeFlownWhenItIsMeant) {
  std::string open = Block();
  open.resize(open.rfind("f 4 1"));
  Write("open.obj", open);
  const Result<World> world = Load("[[mesh]]\nat = [10, 4]\nfile = \"open.obj\"\nopen = true\n");
  ASSERT_TRUE(world.ok()) << world.error().message;
}

}  // namespace
}  // namespace palace
