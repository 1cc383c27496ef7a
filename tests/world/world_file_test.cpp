// World files: what a person writes is what is simulated, and what is wrong in it is named.
#include "engine/world/world_file.h"

#include <cmath>
#include <cstdio>
#include <ctime>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "engine/core/random.h"
#include "engine/core/units.h"

namespace palace {
namespace {

constexpr const char* kYard = R"(name = "yard"
[ground]
material = "grass"
seed = 4
rise_north_deg = 2

[relief]
rms_m = 0

[sun]
azimuth_deg = 200
elevation_deg = 35

[[hole]]
at = [14, 4]
diameter_m = 0.8
depth_m = 0.4

[[ditch]]
from = [20, -6]
to = [20, 6]
width_m = 0.6
depth_m = 0.3

[[mound]]
at = [8, -4]
diameter_m = 3
height_m = 0.5

[[line]]
from = [5, 0]
to = [25, 0]
width_m = 0.15

[[pool]]
at = [10, 6]
diameter_m = 2

[[box]]
at = [12, -2]
size_m = [1, 2, 0.5]
turn_deg = 30
albedo = 0.6

[[cylinder]]
at = [16, 2]
diameter_m = 0.1
height_m = 1
moves_mps = [0, 0.5]

[[rod]]
from = [6, -3, 1]
to = [6, 3, 1]
diameter_m = 0.02
)";

TEST(WorldFile, IsTheWorldThatItSays) {
  const Result<World> read = ParseWorld(kYard, "yard.toml");
  ASSERT_TRUE(read.ok()) << read.error().message;
  const World& world = *read;
  EXPECT_EQ(world.name, "yard");
  EXPECT_NEAR(world.ground.rise_north, std::tan(Rad(2)), 1e-12);
  EXPECT_NEAR(world.sun.elevation_rad, Rad(35), 1e-12);
  const auto above_plane = [&](double n, double e) {
    return world.ground.Height(n, e) - n * world.ground.rise_north;
  };
  EXPECT_NEAR(above_plane(14, 4), -0.4, 1e-6);
  EXPECT_NEAR(above_plane(20, 5), -0.3, 1e-6);
  EXPECT_NEAR(above_plane(8, -4), 0.5, 1e-3);
  EXPECT_NEAR(above_plane(24, 8), 0, 1e-9);
  EXPECT_EQ(world.ground.MaterialAt(15, 0).texture, GroundTexture::kPaint);
  EXPECT_EQ(world.ground.MaterialAt(10, 6.5).texture, GroundTexture::kWater);
  EXPECT_EQ(world.ground.MaterialAt(2, 9).texture, GroundTexture::kGrass);
  ASSERT_EQ(world.solids.size(), 3u);
  EXPECT_NEAR(SurfaceHeight(world, 12, -2) - world.ground.Height(12, -2), 0.5, 1e-9);
  EXPECT_EQ(world.solids[1].v_WO, Eigen::Vector3d(0, 0.5, 0));
  EXPECT_NEAR(SurfaceHeight(world, 6, 1) - world.ground.Height(6, 1), 1.01, 2e-3);
}

TEST(WorldFile, NamesWhatIsWrongWithItsLine) {
  const struct {
    const char *text, *said;
  } table[] = {
      {"[ground]\nmaterial = \"lava\"\n", "w.toml:2: ground.material = \"lava\"; choose one of"},
      {"[grond]\n", "w.toml:1: unknown \"grond\"; a world file knows"},
      {"[ground]\nalbedo = 1.5\n", "w.toml:2: ground.albedo = 1.5 is outside 0 .. 1"},
      {"[ground]\nslope = 1\n", "w.toml:2: unknown key ground.slope"},
      {"[[hole]]\nat = [1, 2]\ndiameter_m = 1\n", "hole.depth_m is missing"},
      {"[[hole]]\nat = [1, 2, 3]\ndiameter_m = 1\ndepth_m = 1\n",
       "w.toml:2: hole.at must be a list of 2"},
      {"[hole]\nat = [1, 2]\n", "write [[hole]] before each"},
      {"[[box]]\nat = [1, 2]\nsize_m = [1, 1, 0]\n",
       "w.toml:3: box.size_m = 0 is outside 0.01 .. 100"},
      {"[[box]]\nat = [1, nan]\nsize_m = [1, 1, 1]\n", "w.toml:2: box.at = nan is outside"},
      {"[[rod]]\nfrom = [1, 1, 1]\nto = [1, 1, 1]\ndiameter_m = 0.1\n", "a rod has a length"},
      {"[[patch]]\noutline = [0, 0, 1, 0, 1, 1, 2]\n", "odd count"},
      {"[relief]\nrms_m = 0.1\nlongest_m = 1\nshortest_m = 2\n", "is longer than longest_m"},
      {"[sun]\nazimuth_deg = 90\n", "sun.elevation_deg is missing"},
      {"[[box]\n", "w.toml:1"},
  };
  for (const auto& row : table) {
    SCOPED_TRACE(row.text);
    const Result<World> read = ParseWorld(row.text, "w.toml");
    ASSERT_FALSE(read.ok());
    EXPECT_NE(read.error().message.find(row.said), std::string::npos) << read.error().message;
  }
}

TEST(WorldFile, TooManyThingsAreRefused) {
  std::string text;
  for (int i = 0; i < 2001; ++i) {
    text += "[[pool]]\nat = [1, 1]\ndiameter_m = 1\n";
  }
  const Result<World> read = ParseWorld(text, "w.toml");
  ASSERT_FALSE(read.ok());
  EXPECT_NE(read.error().message.find("more than 2000 things"), std::string::npos)
      << read.error().message;
}

/// Against the plain sum of all of them; asking each at each corner took a minute.
TEST(WorldFile, ManyFormsAddUpAndTakeNoMinute) {
  RandomStream random(7, "forms");
  struct Mound {
    double north_m, east_m, radius_m, height_m;
  };
  std::vector<Mound> mounds;
  std::string text = "[relief]\nrms_m = 0\nsize_m = 100\n";
  while (mounds.size() < 1990) {
    mounds.push_back({random.Uniform(-60, 80), random.Uniform(-60, 60), random.Uniform(0.1, 4),
                      random.Uniform(0.05, 0.5)});
    const Mound& m = mounds.back();
    char table[200];
    std::snprintf(table, sizeof table,
                  "[[mound]]\nat = [%.17g, %.17g]\ndiameter_m = %.17g\nheight_m = %.17g\n",
                  m.north_m, m.east_m, 2 * m.radius_m, m.height_m);
    text += table;
  }
  text += "[[ditch]]\nfrom = [-70, -95]\nto = [120, 95]\nwidth_m = 3\ndepth_m = 1\n";
  const std::clock_t before = std::clock();
  const Result<World> world = ParseWorld(text, "forms.toml");
  ASSERT_TRUE(world.ok()) << world.error().message;
  EXPECT_LT(double(std::clock() - before) / CLOCKS_PER_SEC, 15);  // of processors, not of a clock
  const HeightField& relief = *world->ground.relief;
  const HeightField::Place& place = relief.place();
  for (int i = 0; i <= relief.cells(); i += 13) {
    for (int j = 0; j <= relief.cells(); j += 13) {
      const double n = place.north_m + i * relief.cell_m(), e = place.east_m + j * relief.cell_m();
      double height_m = 0;
      for (const Mound& m : mounds) {
        const double share = std::hypot(n - m.north_m, e - m.east_m) / m.radius_m;
        height_m += share < 1 ? m.height_m * 0.5 * (1 + std::cos(std::numbers::pi * share)) : 0.0;
      }
      height_m -= std::abs((n + 20) - (e + 45)) / std::numbers::sqrt2 <= 1.5 ? 1 : 0;
      ASSERT_NEAR(relief.Corner(i, j), height_m, 1e-5) << n << " north, " << e << " east";
    }
  }
}

TEST(WorldFile, AnEmptyFileIsLevelGround) {
  const Result<World> read = ParseWorld("", "w.toml");
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(read->ground.Height(7, -3), 0);
  EXPECT_TRUE(read->solids.empty());
}

TEST(WorldFile, AMissingOneIsNamed) {
  const Result<World> read = OpenWorld("/nowhere/x.toml", 1);
  ASSERT_FALSE(read.ok());
  EXPECT_NE(read.error().message.find("/nowhere/x.toml"), std::string::npos);
}

}  // namespace
}  // namespace palace
