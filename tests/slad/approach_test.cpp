// Ways down to a site: what stands or hangs in them, and from where it can be reached.
#include <bit>
#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "engine/slad/sites/approach_corridors.h"
#include "engine/slad/sites/site_selection.h"
#include "tests/slad/seen_from_the_south.h"
#include "tests/slad/worlds.h"

namespace palace {
namespace {

using testing::Context;
using testing::Flat;
using testing::MakeMap;
using testing::Select;

TEST(Approach, TallWallTowardsTheVehicleBlocksTheCorridor) {
  // A wall 8 m high across the approach, 4.5 m south of the middle.
  const auto wall = [](double n, double) { return std::abs(n + 4.5) < 0.4 ? 8.0 : 0.0; };
  SiteContext context = Context();
  const SiteSelection blocked = Select(MakeMap(120, 120, 0.15, wall), {}, context);
  ASSERT_FALSE(blocked.sites.empty());
  for (const LandingSite& site : blocked.sites) {
    if (site.p_WS.x() > -4 && site.p_WS.x() < 2) {
      EXPECT_FALSE(site.corridor_clear) << site.p_WS.transpose();
    }
  }
  context.p_WB = {15, 0, -15};
  context.X_WC.p = context.p_WB;
  for (const LandingSite& site : Select(MakeMap(120, 120, 0.15, wall), {}, context).sites) {
    EXPECT_TRUE(site.corridor_clear || site.p_WS.x() < -4.5) << site.p_WS.transpose();
  }
}

// A wall as high as a house beside the middle, from each of eight sides: exactly the sectors that
// face it are blocked, and they turn with the world.
TEST(Approach, SectorsOfApproachThatFaceAWallAreBlocked) {
  for (unsigned side = 0; side < 8; ++side) {
    const double bearing_rad = side * Rad(45);
    const auto wall = [=](double n, double e) {
      const double along = n * std::cos(bearing_rad) + e * std::sin(bearing_rad);
      const double across = n * std::sin(bearing_rad) - e * std::cos(bearing_rad);
      return std::abs(along - 5) < 0.3 && std::abs(across) < 1.5 ? 8.0 : 0.0;
    };
    const ElevationMap map = MakeMap(121, 121, 0.15, wall);
    const SladSettings settings;
    const HazardMaps hazards = EvaluateHazards(map, settings);
    LandingSite middle;
    const auto site = RecheckSite(map, hazards, settings, middle, Context());
    ASSERT_TRUE(site);
    EXPECT_EQ(site->clear_approaches, 0xFF & ~(1U << side)) << side;
    EXPECT_EQ(site->corridor_clear, side != 4) << side;  // the vehicle stands in the south
  }
}

// The way round is flown level: what is higher than the vehicle on the way to a sector blocks that
// sector, though its corridor is clear; what is lower does not.
TEST(Approach, TheWayRoundToASectorIsClearToo) {
  struct Row {
    const char* name;
    double top_m;
    unsigned blocked;
  };
  // The vehicle 9 m high in the south; a mast in the south-west, beside every corridor.
  for (const Row& row : {Row{"a mast above the vehicle", 12, 0x40}, Row{"a low one", 4, 0}}) {
    SCOPED_TRACE(row.name);
    const auto mast = [&](double n, double e) {
      return std::hypot(n + 4.5, e + 4.5) < 0.3 ? row.top_m : 0.0;
    };
    SiteContext context = Context();
    context.p_WB = context.X_WC.p = {-9, 0, -9};
    const ElevationMap map = MakeMap(121, 121, 0.15, mast);
    SladSettings settings;
    settings.lander.rotor_diameter_m = 2;
    const auto site =
        RecheckSite(map, EvaluateHazards(map, settings), settings, LandingSite{}, context);
    ASSERT_TRUE(site);
    const unsigned south_west = 0x20;  // the mast stands in that corridor itself
    EXPECT_EQ(site->clear_approaches | south_west, 0xFF & ~row.blocked);
  }
}

// The corridor that is judged is the planned one, from its own beginning, wherever the vehicle is
// on its way there.
TEST(Approach, APlannedCourseIsJudgedFromWhereItBegins) {
  const auto wall = [](double n, double) { return std::abs(n - 5) < 0.3 ? 9.0 : 0.0; };
  const ElevationMap map = MakeMap(121, 121, 0.15, wall);
  const SladSettings settings;
  const HazardMaps hazards = EvaluateHazards(map, settings);
  for (const double vehicle_north_m : {-15.0, -3.0, 0.5, 15.0}) {
    SiteContext context = Context();
    context.p_WB = {vehicle_north_m, 0, -15};
    context.approach_heading_rad = 0;  // northwards: from the south
    EXPECT_TRUE(RecheckSite(map, hazards, settings, LandingSite{}, context)->corridor_clear);
    context.approach_heading_rad = Rad(180);
    EXPECT_FALSE(RecheckSite(map, hazards, settings, LandingSite{}, context)->corridor_clear)
        << vehicle_north_m;
  }
}

// A vehicle that is nearer than where its slope begins backs away to there, at its height: what
// stands behind it is in the way, what stands behind that beginning is not.
TEST(Approach, AVehicleTooNearBacksAway) {
  struct Row {
    double wall_north_m, vehicle_north_m;
    bool clear;
  };
  // 15 m high; the wall as high as a house, south of the middle: 15 m is where the slope begins.
  for (const Row& row : {Row{-6, -3, false}, Row{-6, 3, true}, Row{-8.5, -3, false}}) {
    SCOPED_TRACE(row.wall_north_m);
    const auto wall = [&](double n, double) {
      return std::abs(n - row.wall_north_m) < 0.3 ? 20.0 : 0.0;
    };
    SiteContext context = Context();
    context.p_WB = {row.vehicle_north_m, 0, -15};
    const ElevationMap map = MakeMap(121, 121, 0.15, wall);
    const SladSettings settings;
    const auto site =
        RecheckSite(map, EvaluateHazards(map, settings), settings, LandingSite{}, context);
    ASSERT_TRUE(site);
    EXPECT_EQ(site->corridor_clear, row.clear);
  }
}

// Over the site and nearly down the ground itself is as high as the level way to nowhere.
TEST(Approach, OnTheLastMetresNothingStandsInTheWay) {
  const ElevationMap map = MakeMap(121, 121, 0.15, [](double n, double) { return 0.15 * n; });
  const SladSettings settings;
  const HazardMaps hazards = EvaluateHazards(map, settings);
  for (const double height_m : {3.0, 2.0, 1.7, 1.0, 0.3}) {
    SiteContext context = Context();
    context.p_WB = {0, 0, -height_m - settings.lander.skid_centre_B().z()};
    context.approach_heading_rad = Rad(180);  // from the north, uphill
    const auto site = RecheckSite(map, hazards, settings, LandingSite{}, context);
    ASSERT_TRUE(site);
    EXPECT_TRUE(site->corridor_clear) << height_m;
  }
}

struct WireRow {
  const char* name;
  float top_m;
  bool clear;
};

// A wire across the approach, 7 m south of the middle, over flat ground: in the way when it hangs
// as high as the way down or higher, or at nobody knows what height; a low one is flown over.
TEST(Approach, AWireAcrossTheApproachBlocksIt) {
  for (const WireRow& row :
       {WireRow{"at the height of the way", 7, false}, WireRow{"above it", 12, false},
        WireRow{"of unknown height", std::numeric_limits<float>::infinity(), false},
        WireRow{"a low rope", 0.8F, true}}) {
    SCOPED_TRACE(row.name);
    ElevationMap map = MakeMap(121, 121, 0.15, Flat());
    map.thin_top_m = GridF(121, 121, kUnknownValue);
    for (int r = 0; r < 121; ++r) {
      for (int c = 0; c < 121; ++c) {
        if (std::abs(map.geometry.NorthOfRow(r) + 7) < 0.2) {
          map.thin_top_m.at(r, c) = row.top_m;
        }
      }
    }
    const SladSettings settings;
    const auto site =
        RecheckSite(map, EvaluateHazards(map, settings), settings, LandingSite{}, Context());
    ASSERT_TRUE(site);
    EXPECT_EQ(site->corridor_clear, row.clear);
  }
}

// Of two places the wider has its straight approach blocked: it comes second and says from where it
// can be reached; one that is walled in comes last.
TEST(Approach, ABlockedStraightApproachNamesAnother) {
  const auto wall = [](double n, double e) {
    return std::abs(n + 1) < 0.3 && e < 2 ? 9.0 : 0.0;  // north of it is the wide ground
  };
  SladSettings settings;
  settings.choice.sites_kept = 26;
  const SiteSelection selection = Select(MakeMap(141, 141, 0.15, wall), settings);
  bool found = false;
  bool blocked_before = false;
  for (const LandingSite& site : selection.sites) {
    EXPECT_FALSE(blocked_before && site.corridor_clear) << "a clear one after a blocked one";
    blocked_before = blocked_before || !site.corridor_clear;
    if (!site.corridor_clear && site.clear_approaches != 0) {
      found = true;
      const int sides = std::popcount(site.clear_approaches);
      ASSERT_GT(sides, 2);
      EXPECT_EQ(site.reason,
                "Straight approach blocked; clear from " + std::to_string(sides) + " of 8 sides");
    }
  }
  EXPECT_TRUE(found);
}

/// By the rule of IsClear, asked of every cell of the map.
bool NothingStandsIn(const Approach& approach, const ElevationMap& map,
                     const SladSettings& settings, const LandingSite& site) {
  const Lander& lander = settings.lander;
  for (int r = 0; r < map.geometry.rows; ++r) {
    for (int c = 0; c < map.geometry.cols; ++c) {
      const double north_m = map.geometry.NorthOfRow(r) - site.p_WS.x();
      const double east_m = map.geometry.EastOfCol(c) - site.p_WS.y();
      const double s = north_m * approach.from.x() + east_m * approach.from.y();
      const double aside = std::abs(north_m * approach.from.y() - east_m * approach.from.x());
      if (s <= site.clear_radius_m || s > approach.length_m ||
          aside > lander.rotor_diameter_m / 2) {
        continue;
      }
      const double free_m = (s - lander.radius_m()) * std::tan(approach.glide_slope_rad) +
                            settings.limits.max_deviation_m;
      const double top_m = double(map.height_m.at(r, c)) - site.height_m.value -
                           3 * std::sqrt(double(map.variance_m2.at(r, c)));
      if ((map.state.at(r, c) != CellState::kUnknown && top_m > free_m) ||
          double(map.thin_top_m.at(r, c)) + 1 - site.height_m.value > free_m) {
        return false;
      }
    }
  }
  return true;
}

TEST(Approach, ACorridorIsClearWhereNoCellStandsInIt) {
  int clear = 0;
  constexpr int kCorridors = 3000;
  for (std::uint64_t seed = 1; seed <= kCorridors; ++seed) {
    RandomStream random(seed, "corridor");
    const int rows = 1 + random.Index(60), cols = 1 + random.Index(60);
    ElevationMap map = MakeMap(rows, cols, 0.15, Flat(), 0.01, seed);
    map.thin_top_m = GridF(rows, cols, kUnknownValue);
    for (int things = random.Index(4); things >= 0; --things) {
      const Cell cell{random.Index(rows), random.Index(cols)};
      if (random.Uniform() < 0.3) {
        map.thin_top_m.at(cell) = random.Uniform() < 0.5 ? HUGE_VALF : 3.0F;
      } else {
        map.height_m.at(cell) = float(random.Uniform(0, 9));
      }
    }
    SladSettings settings;
    settings.lander.rotor_diameter_m = random.Uniform(0.1, 4);
    LandingSite site;
    // Also beside the map.
    site.p_WS = {random.Uniform(-6, 6), random.Uniform(-6, 6), 0};
    site.height_m = {0, 0.03};
    site.clear_radius_m = random.Uniform(0, 1);
    const double bearing_rad =
        random.Uniform() < 0.5 ? random.Index(8) * Rad(45) : random.Uniform(0, 6.28);
    const Approach approach{{std::cos(bearing_rad), std::sin(bearing_rad)},
                            random.Uniform(0, 12),
                            random.Uniform(0.1, 1.5)};
    const bool is_clear = ApproachCorridors(map, settings).IsClear(approach, site);
    ASSERT_EQ(is_clear, NothingStandsIn(approach, map, settings, site)) << seed;
    clear += is_clear ? 1 : 0;
  }
  EXPECT_GT(clear, kCorridors / 10);
  EXPECT_LT(clear, kCorridors * 9 / 10);
}

/// Whether a cell that reaches the skids lies on a level way, so much wider and longer on all
/// sides.
bool SomethingStandsOnWay(const ElevationMap& map, const Eigen::Vector2d& from_W,
                          const Eigen::Vector2d& to_W, double half_width_m, double skids_m,
                          double wider_m) {
  const double length_m = (to_W - from_W).norm();
  const Eigen::Vector2d along = (to_W - from_W) / length_m;
  for (int r = 0; r < map.geometry.rows; ++r) {
    for (int c = 0; c < map.geometry.cols; ++c) {
      const Eigen::Vector2d at =
          Eigen::Vector2d(map.geometry.NorthOfRow(r), map.geometry.EastOfCol(c)) - from_W;
      const double s = at.dot(along), aside = std::abs(at.x() * along.y() - at.y() * along.x());
      if (double(map.height_m.at(r, c)) > skids_m && s >= -wider_m && s <= length_m + wider_m &&
          aside <= half_width_m + wider_m) {
        return true;
      }
    }
  }
  return false;
}

// Columns are counted a cell or two too many; what stands beside the way, at the map's edge also
// where the way passes beside the map, does not block it.
TEST(Approach, ALevelWayIsClearWhereNothingTallStandsOnIt) {
  int clear = 0, blocked = 0, beside_map = 0;
  constexpr int kWays = 3000;
  for (std::uint64_t seed = 1; seed <= kWays; ++seed) {
    RandomStream random(seed, "level way");
    const int rows = 1 + random.Index(60), cols = 1 + random.Index(60);
    ElevationMap map = MakeMap(rows, cols, 0.15, Flat(), 0.01, seed);
    for (int things = random.Index(4); things >= 0; --things) {
      const int row = random.Index(rows);
      const int col = random.Uniform() < 0.5 ? random.Index(cols) : random.Index(2) * (cols - 1);
      map.height_m.at(row, col) = float(random.Uniform(0, 12));
    }
    SladSettings settings;
    settings.lander.rotor_diameter_m = random.Uniform(0.1, 4);
    LandingSite site;
    site.p_WS = {random.Uniform(-9, 9), random.Uniform(-9, 9), 0};
    site.clear_radius_m = 0;
    site.height_m = {NAN, NAN};  // its corridor is clear: the level way alone is asked
    SiteContext context;
    context.p_WB = {random.Uniform(-9, 9), random.Uniform(-9, 9), -6};
    const double bearing_rad = random.Uniform(0, 6.28);
    const Approach approach{
        {std::cos(bearing_rad), std::sin(bearing_rad)}, random.Uniform(0, 6), Rad(45)};
    const Eigen::Vector2d to_W = site.p_WS.head<2>() + approach.length_m * approach.from;
    const double skids_m = HeightFromDown(-6 + settings.lander.skid_centre_B().z());
    const auto stands = [&](double wider_m) {
      return SomethingStandsOnWay(map, context.p_WB.head<2>(), to_W,
                                  settings.lander.rotor_diameter_m / 2, skids_m, wider_m);
    };
    const bool is_clear = ApproachCorridors(map, settings).IsReachable(approach, context, site);
    if (stands(0)) {
      ASSERT_FALSE(is_clear) << seed;
      ++blocked;
    } else if (!stands(6 * map.geometry.cell_m)) {
      ASSERT_TRUE(is_clear) << seed;
      ++clear;
      beside_map += std::max(context.p_WB.y(), to_W.y()) < map.geometry.EastOfCol(0) - 3 ||
                    std::min(context.p_WB.y(), to_W.y()) > map.geometry.EastOfCol(cols - 1) + 3;
    }
  }
  EXPECT_GT(clear, kWays / 10);
  EXPECT_GT(blocked, kWays / 20);
  EXPECT_GT(beside_map, 50);
}

}  // namespace
}  // namespace palace
