// Every family, seed by seed: the same seed the same world, never too large, safe where it says so.
// It does not prove that the pictures look like ground: people look at the gallery.
#include "engine/world/families/families.h"

#include <algorithm>
#include <bit>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "engine/world/families/clearing.h"
#include "engine/world/families/view_plan.h"
#include "engine/world/ground_truth.h"
#include "engine/world/world_mesh.h"

namespace palace {
namespace {

/// The limits that the program starts with.
constexpr double kClearRadius_m = 2.3;
constexpr std::size_t kMostTriangles = 150'000;
constexpr std::uint64_t kSeeds = 4;

/// Mixes the bits of what a world is made of (FNV-1a).
class WorldHash {
 public:
  void Mix(double value) {
    hash_ = (hash_ ^ std::bit_cast<std::uint64_t>(value)) * 0x100000001B3ULL;
  }
  std::uint64_t Of(const World& world) {
    for (double north = -15; north < 60; north += 0.9) {
      for (double east = -30; east < 30; east += 0.9) {
        Mix(world.ground.Height(north, east));
      }
    }
    for (const MeshVertex& vertex : SolidTriangles(world, 0.5F)) {
      for (const float part :
           {vertex.position_W.x(), vertex.position_W.y(), vertex.position_W.z(), vertex.albedo}) {
        Mix(static_cast<double>(part));
      }
    }
    for (const Solid& solid : world.solids) {
      Mix(solid.v_WO.sum());
    }
    for (const GroundPatch& patch : world.ground.patches) {
      Mix(patch.outline_m.front().x());
      Mix(static_cast<double>(patch.material.seed));
    }
    Mix(world.ground.material ? world.ground.material->scale : 0);
    Mix(world.sun.azimuth_rad);
    return hash_;
  }

 private:
  std::uint64_t hash_ = 0xCBF29CE484222325ULL;
};

std::uint64_t HashOf(const World& world) { return WorldHash().Of(world); }

World Make(std::string_view name, std::uint64_t seed) { return MakeFamily(name, seed).value(); }

SafePlaces SafePlacesOf(const World& world, const TruthLimits& limits = {}, double every_m = 0.5) {
  const TruthArea area = world.name == "rmax" ? TruthArea{20, 120, -40, 40, 0.1} : TruthArea{};
  return FindSafePlaces(TruthOf(world, area), kClearRadius_m, limits, every_m);
}

/// Of kSeeds seeds, how many must have a safe disc.
int LeastSafe(std::string_view family) {
  const bool hard = family == "slopes" || family == "rough" || family == "dunes";
  return family == "nowhere" ? 0 : hard ? 2 : 4;
}

class EveryFamily : public testing::TestWithParam<std::string_view> {};

TEST_P(EveryFamily, SameSeedSameWorld) {
  EXPECT_EQ(HashOf(Make(GetParam(), 5)), HashOf(Make(GetParam(), 5)));
}

/// Small enough for renderers without a graphics card, bare where the vehicle starts, safe where it
/// should be, and no seed like another.
TEST_P(EveryFamily, IsWhatItSaysForEverySeed) {
  std::set<std::uint64_t> hashes;
  int safe = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const World world = Make(GetParam(), seed);
    EXPECT_EQ(world.name, GetParam());
    EXPECT_LE(SolidTriangles(world, 0.5F).size() / 3, kMostTriangles);
    EXPECT_LE(world.solids.size(), 2500u);
    EXPECT_LE(world.ground.patches.size(), 120u);
    EXPECT_TRUE(!world.ground.relief || world.ground.relief->place().levels <= 10);
    ASSERT_TRUE(world.ground.material.has_value());
    EXPECT_GT(world.sun.elevation_rad, 0.2);
    EXPECT_NEAR(world.ground.Height(0, 0), 0, GetParam() == "roof" ? 13 : 2);
    hashes.insert(HashOf(world));
    safe += SafePlacesOf(world).Count() > 0;
  }
  EXPECT_EQ(hashes.size(), kSeeds);
  EXPECT_GE(safe, LeastSafe(GetParam()));
  EXPECT_TRUE(GetParam() != "nowhere" || safe == 0);
}

TEST_P(EveryFamily, IsSeenInManyWays) {
  std::set<double> heights, lenses;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const ViewPlan view = DrawViewPlan(GetParam(), seed);
    EXPECT_GE(view.height_m, 8);
    EXPECT_LE(view.height_m, GetParam() == "rmax" ? 46 : 30);
    EXPECT_LE(view.tilt_rad, -0.6);
    heights.insert(view.height_m);
    lenses.insert(view.camera.fx_px);
  }
  EXPECT_EQ(heights.size(), GetParam() == "rmax" ? 1 : kSeeds);
  EXPECT_EQ(lenses.size(), kSeeds);
}

INSTANTIATE_TEST_SUITE_P(All, EveryFamily, testing::ValuesIn(FamilyNames()), [](const auto& row) {
  std::string name(row.param);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

TEST(Families, NowhereHasNoSafePlaceEvenWithWiderLimits) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    EXPECT_EQ(SafePlacesOf(Make("nowhere", seed), TruthLimits{}.Scaled(1.2)).Count(), 0)
        << "seed " << seed;
  }
}

TEST(Families, OneHasOneSafePlaceAndRoomInIt) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const SafePlaces places = SafePlacesOf(Make("one", seed), {}, 0.25);
    EXPECT_EQ(places.Regions(), 1) << "seed " << seed;
    EXPECT_GE(places.Count(), 10) << "seed " << seed;
    EXPECT_LE(places.Count(), 200) << "seed " << seed << ", 12 square metres";
  }
}

TEST(Families, TheSearchedGroundHasOneSafePlaceSomewhereInIt) {
  constexpr double kRim_m = kClearRadius_m;
  double nearest_m = 100, farthest_m = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const World world = MakeSearchedGround(seed);
    const GroundTruth truth = TruthOf(world, {.north_min_m = -kSearchedHalf_m - kRim_m,
                                              .north_max_m = kSearchedHalf_m + kRim_m,
                                              .east_min_m = -kSearchedHalf_m - kRim_m,
                                              .east_max_m = kSearchedHalf_m + kRim_m,
                                              .cell_m = 0.1});
    const SafePlaces places = FindSafePlaces(truth, kRim_m, {}, 0.25);
    EXPECT_EQ(places.Regions(), 1) << "seed " << seed;
    const GridGeometry& g = places.geometry;
    for (int row = 0; row < g.rows; ++row) {
      for (int col = 0; col < g.cols; ++col) {
        if (places.safe.at(row, col) != 0) {
          const double away_m = std::hypot(g.NorthOfRow(row), g.EastOfCol(col));
          nearest_m = std::min(nearest_m, away_m);
          farthest_m = std::max(farthest_m, away_m);
        }
      }
    }
  }
  EXPECT_GT(farthest_m, 25);
  EXPECT_LT(nearest_m, 25);
}

TEST(Families, NoTwoLookAlike) {
  std::set<std::uint64_t> seeds;
  for (const std::string_view name : FamilyNames()) {
    EXPECT_TRUE(seeds.insert(Make(name, 1).ground.material->seed).second) << name;
    EXPECT_FALSE(FamilySummary(name).empty()) << name;
  }
}

TEST(Families, UnknownNameListsTheNames) {
  const Result<World> world = MakeFamily("moon", 1);
  ASSERT_FALSE(world.ok());
  EXPECT_EQ(world.error().code, ErrorCode::kUsage);
  for (const std::string_view name : FamilyNames()) {
    EXPECT_NE(world.error().message.find(name), std::string::npos) << name;
    EXPECT_TRUE(IsFamily(name));
  }
  EXPECT_FALSE(IsFamily("moon"));
}

}  // namespace
}  // namespace palace
