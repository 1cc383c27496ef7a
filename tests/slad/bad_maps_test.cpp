// Maps and settings that make no sense: a clear answer, never a lucky site, never a crash.

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "engine/slad/slad.h"
#include "engine/slad/terrain/elevation_map_builder.h"
#include "tests/slad/worlds.h"

namespace palace {
namespace {

using testing::Flat;
using testing::MakeMap;
using testing::WithMode;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr std::array kModes = {SladMode::kThesis, SladMode::kModern};

SiteContext Overhead() {
  SiteContext context;
  context.p_WB = {0, 0, -15};
  context.X_WC = {CameraRotationFromTilt(Rad(-90)), context.p_WB};
  context.camera = testing::ThesisCamera();
  return context;
}

/// Every cell counted once; sites on measured, finite, clear ground, all figures finite; without a
/// site a reason.
SiteSelection ExpectHonest(const ElevationMap& map, const SladSettings& settings) {
  const HazardMaps hazards = EvaluateHazards(map, settings);
  const RejectedCells& n = hazards.rejected;
  EXPECT_EQ(
      n.slope + n.roughness + n.unknown + n.flagged + n.doubtful + n.footprint + hazards.safe_cells,
      map.geometry.rows * map.geometry.cols);
  SiteSelection selection = SelectSites(map, hazards, settings, Overhead());
  EXPECT_EQ(selection.sites.empty(), !selection.none_reason.empty());
  const bool modern = settings.mode == SladMode::kModern;
  for (const LandingSite& site : selection.sites) {
    EXPECT_EQ(hazards.reasons.at(site.cell), kHazardNone);
    EXPECT_TRUE(std::isfinite(map.height_m.at(site.cell)));
    EXPECT_TRUE(!modern || map.state.at(site.cell) == CellState::kMeasured);
    EXPECT_TRUE(site.p_WS.allFinite()) << site.p_WS.transpose();
    EXPECT_TRUE(site.normal_W.allFinite()) << site.normal_W.transpose();
    for (const double figure :
         {site.slope_rad.value, site.roughness_m.value, site.height_m.value, site.safe_distance_m,
          site.clearance_m, site.cost, site.distance_m}) {
      EXPECT_TRUE(std::isfinite(figure)) << figure;
    }
    EXPECT_GE(site.safe_distance_m, site.clear_radius_m);
    EXPECT_LE(std::abs(site.height_m.value), 1e5) << "no ground lies there";
    EXPECT_TRUE(!modern ||
                (std::isfinite(site.safe_probability) && site.safe_probability <= 1 &&
                 std::isfinite(site.step_m.value) && std::isfinite(site.height_m.three_sigma)));
  }
  return selection;
}

struct BadMap {
  const char* name;
  std::function<ElevationMap()> make;
  const char* modern;  ///< none_reason; "site" where there is one; "any" where either is honest
  const char* thesis;
};

ElevationMap FlatMap(int rows = 60, int cols = 60, double cell_m = 0.15) {
  return MakeMap(rows, cols, cell_m, Flat(2));
}
ElevationMap WithHeight(float height_m, bool everywhere = false) {
  ElevationMap map = FlatMap();
  map.height_m.at(10, 50) = height_m;
  if (everywhere) {
    map.height_m = GridF(60, 60, height_m);
  }
  return map;
}
ElevationMap WithVariance(float variance_m2, bool everywhere = false) {
  ElevationMap map = FlatMap();
  map.variance_m2.at(10, 50) = variance_m2;
  if (everywhere) {
    map.variance_m2 = GridF(60, 60, variance_m2);
  }
  return map;
}

std::vector<BadMap> BadMaps() {
  const auto nothing = [](double, double) { return std::nan(""); };
  const auto size = [=](int rows, int cols) { return [=] { return FlatMap(rows, cols); }; };
  return {
      {"no_cells", size(0, 0), "empty map", "empty map"},
      {"no_rows", size(0, 9), "empty map", "empty map"},
      {"one_cell", size(1, 1), "100 % unknown", "100 % unknown"},
      {"one_row", size(1, 90), "100 % unknown", "100 % unknown"},
      {"one_col", size(90, 1), "100 % unknown", "100 % unknown"},
      {"two_by_two", size(2, 2), "any", "100 % too near a hazard"},
      {"three_by_three", size(3, 3), "100 % too near a hazard", "100 % too near a hazard"},
      {"two_rows", size(2, 300), "100 % too near a hazard", "100 % too near a hazard"},
      {"unknown", [=] { return MakeMap(60, 60, 0.15, nothing); }, "100 % unknown", "100 % unknown"},
      {"unknown_one", [=] { return MakeMap(1, 1, 0.15, nothing); }, "100 % unknown",
       "100 % unknown"},
      {"noise", [] { return MakeMap(60, 60, 0.15, Flat(), 10, 3); }, "any", "any"},
      {"steep", [] { return MakeMap(60, 60, 0.15, testing::Slope(Rad(60), 1)); }, "100 % slope",
       "100 % slope"},
      {"wall", [] { return MakeMap(60, 60, 0.15, testing::Slope(Rad(89.99), 1)); }, "100 % slope",
       "100 % slope"},
      {"chequered",
       [] {
         return MakeMap(60, 60, 0.15, [](double n, double e) {
           const bool black = (int(std::floor(n / 0.15)) + int(std::floor(e / 0.15))) % 2 == 0;
           return black ? std::nan("") : 1.0;
         });
       },
       "any", "any"},
      {"nan_cell", [] { return WithHeight(kNan); }, "any", "site"},
      {"nan_heights", [] { return WithHeight(kNan, true); }, "100 % unknown", "100 % unknown"},
      {"infinite_cell", [] { return WithHeight(kInfinity); }, "any", "site"},
      {"minus_infinite_cell", [] { return WithHeight(-kInfinity); }, "any", "site"},
      {"infinite_heights", [] { return WithHeight(kInfinity, true); }, "100 % unknown",
       "100 % unknown"},
      {"high_cell", [] { return WithHeight(1e9F); }, "site", "site"},
      {"highest_cell", [] { return WithHeight(3e38F); }, "any", "any"},
      {"high_ground", [] { return WithHeight(1e9F, true); }, "any", "any"},
      {"nan_variance", [] { return WithVariance(kNan); }, "any", "site"},
      {"nan_variances", [] { return WithVariance(kNan, true); }, "100 % unknown", "any"},
      {"negative_variance", [] { return WithVariance(-1); }, "any", "site"},
      {"negative_variances", [] { return WithVariance(-1, true); }, "any", "any"},
      {"zero_variances", [] { return WithVariance(0, true); }, "site", "site"},
      {"infinite_variance", [] { return WithVariance(kInfinity); }, "any", "site"},
      {"infinite_variances", [] { return WithVariance(kInfinity, true); }, "any", "any"},
      {"huge_variances", [] { return WithVariance(1e30F, true); }, "any", "any"},
      {"no_frames",
       [] {
         ElevationMap map = FlatMap();
         map.frame_count = Grid<std::uint16_t>(60, 60, 0);
         return map;
       },
       "site", "site"},
      {"kilometre_cells", [] { return FlatMap(30, 30, 1000); },
       "cells of 1e+03 m, limits 0.001 m to one lander, 3.6 m: too few points, or too large an "
       "area for the map's rows "
       "and columns",
       "cells of 1e+03 m, limits 0.001 m to one lander, 3.6 m: too few points, or too large an "
       "area for the map's rows "
       "and columns"},
      {"widest_cells", [] { return FlatMap(30, 30, 1e9); },
       "cells of 1e+09 m, limits 0.001 m to one lander, 3.6 m: too few points, or too large an "
       "area for the map's rows "
       "and columns",
       "cells of 1e+09 m, limits 0.001 m to one lander, 3.6 m: too few points, or too large an "
       "area for the map's rows "
       "and columns"},
      {"millimetre_cells", [] { return FlatMap(60, 60, 1e-3); }, "100 % too near a hazard",
       "100 % too near a hazard"},
      {"nanometre_cells", [] { return FlatMap(60, 60, 1e-9); },
       "cells of 1e-09 m, limits 0.001 m to one lander, 3.6 m: too few points, or too large an "
       "area for the map's rows "
       "and columns",
       "cells of 1e-09 m, limits 0.001 m to one lander, 3.6 m: too few points, or too large an "
       "area for the map's rows "
       "and columns"},
  };
}

/// What is said of a map: "site", or why there is none, up to the sizes of map and lander.
std::string Answer(const ElevationMap& map, const SladSettings& settings) {
  const SiteSelection selection = ExpectHonest(map, settings);
  if (!selection.sites.empty()) {
    return "site";
  }
  const std::size_t sizes = selection.none_reason.find("; the map holds ");
  const double across_m = std::min(map.geometry.rows, map.geometry.cols) * map.geometry.cell_m;
  EXPECT_TRUE(sizes == std::string::npos ||
              across_m < 2 * settings.lander.clear_radius_m() + map.geometry.cell_m);
  return selection.none_reason.substr(0, sizes);
}

TEST(BadMaps, GetAClearAnswerAndNeverALuckySite) {
  for (const BadMap& row : BadMaps()) {
    for (const SladMode mode : kModes) {
      for (const SiteRanking choice : {SiteRanking::kFarthest, SiteRanking::kCost}) {
        SCOPED_TRACE(std::string(row.name) + (mode == SladMode::kModern ? " modern" : " thesis"));
        SladSettings settings = WithMode(mode);
        settings.choice.ranking = choice;
        const std::string want = mode == SladMode::kModern ? row.modern : row.thesis;
        const std::string answer = Answer(row.make(), settings);
        EXPECT_TRUE(want == "any" || answer == want) << answer << ", not " << want;
      }
    }
  }
}

struct BadSetting {
  const char* name;
  std::function<void(SladSettings&, double)> set;
  bool none_at_zero;  ///< no site even at 0
};

// Such settings cannot be typed, dragged or loaded; a program may still ask with them.
TEST(BadSettings, GetNoSiteAndAreNamed) {
  const std::vector<BadSetting> rows = {
      {"slad.lander_base_size_m", [](auto& s, double v) { s.lander.base_size_m = v; }, true},
      {"slad.max_rock_size_m", [](auto& s, double v) { s.lander.max_rock_size_m = v; }, false},
      {"slad.nav_error_m", [](auto& s, double v) { s.lander.nav_error_m = v; }, false},
      {"slad.max_slope_deg", [](auto& s, double v) { s.limits.max_slope_deg = v; }, false},
      {"slad.max_deviation_m", [](auto& s, double v) { s.limits.max_deviation_m = v; }, false},
      {"slad.max_step_m", [](auto& s, double v) { s.limits.max_step_m = v; }, false},
      {"slad.min_safe_probability", [](auto& s, double v) { s.limits.min_safe_probability = v; },
       false},
      {"slad.site_spacing_m", [](auto& s, double v) { s.choice.spacing_m = v; }, false},
      {"slad.rotor_diameter_m", [](auto& s, double v) { s.lander.rotor_diameter_m = v; }, false},
      {"slad.gear_length_m", [](auto& s, double v) { s.lander.gear_length_m = v; }, false},
      {"slad.gear_width_m", [](auto& s, double v) { s.lander.gear_width_m = v; }, false},
      {"slad.belly_clearance_m", [](auto& s, double v) { s.lander.belly_clearance_m = v; }, false},
      {"slad.up_tilt_deg", [](auto& s, double v) { s.lander.up_tilt_deg = v; }, false},
      {"slad.up_azimuth_deg", [](auto& s, double v) { s.lander.up_azimuth_deg = v; }, false},
  };
  for (const BadSetting& row : rows) {
    for (const double value : {-1.0, -1e30, double(kNan), double(kInfinity), 0.0}) {
      for (const SladMode mode : kModes) {
        SCOPED_TRACE(std::string(row.name) + " = " + std::to_string(value));
        SladSettings settings = WithMode(mode);
        row.set(settings, value);
        const std::string answer = Answer(FlatMap(), settings);
        if (value != 0 || row.none_at_zero) {
          EXPECT_EQ(answer.rfind(row.name, 0), 0U) << answer;
        }
      }
    }
  }
}

TEST(BadSettings, LanderLargerThanTheMapHasNoRoom) {
  for (const SladMode mode : kModes) {
    for (const double size_m : {9.5, 20.0, 1e4, 1e9, 1e30}) {
      SladSettings settings = WithMode(mode);
      settings.lander.base_size_m = size_m;
      EXPECT_EQ(Answer(FlatMap(), settings), "100 % too near a hazard") << size_m;
    }
  }
}

TEST(BadSettings, NoSiteAskedForIsSaid) {
  for (const int kept : {0, -3}) {
    SladSettings settings;
    settings.choice.sites_kept = kept;
    EXPECT_EQ(Answer(FlatMap(), settings).rfind("slad.sites_kept", 0), 0U);
  }
}

struct RefusedSetting {
  const char* name;
  double value;
};

TEST(BadSettings, AreRefusedWithTheirLimits) {
  for (const RefusedSetting& row :
       std::initializer_list<RefusedSetting>{{"slad.lander_base_size_m", 0},
                                             {"slad.lander_base_size_m", -3.6},
                                             {"slad.max_rock_size_m", 0},
                                             {"slad.grid_rows", 0},
                                             {"slad.grid_cols", -100},
                                             {"slad.grid_rows", 4097},
                                             {"slad.cell_m", 0},
                                             {"slad.cell_m", 1e9},
                                             {"slad.max_slope_deg", -10},
                                             {"slad.max_deviation_m", 0},
                                             {"slad.data_size_cells", -1},
                                             {"slad.sites_kept", 0},
                                             {"slad.nav_error_m", std::nan("")},
                                             {"slad.gear_width_m", HUGE_VAL}}) {
    Settings settings;
    const Status set = SetSettingValue(settings, row.name, row.value);
    ASSERT_FALSE(set) << row.name;
    EXPECT_NE(set.error().message.find(row.name), std::string::npos) << set.error().message;
    EXPECT_NE(set.error().message.find("limits"), std::string::npos) << set.error().message;
    EXPECT_EQ(settings, Settings{});
  }
}

TEST(BadBounds, ReversedAreExchangedAndEmptyOnesHaveNoRoom) {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 100 * 100; ++i) {
    points.emplace_back(-7.5 + 0.15 * (i / 100), -7.5 + 0.15 * (i % 100), 0);
  }
  for (const SladMode mode : kModes) {
    SladSettings settings = WithMode(mode);
    settings.grid.bounds = BoundsMode::kGiven;
    settings.grid.data_size_cells = 2;
    const ElevationMap straight = ElevationFromPoints(points, nullptr, settings, {});
    std::swap(settings.grid.x_min_m, settings.grid.x_max_m);
    std::swap(settings.grid.y_min_m, settings.grid.y_max_m);
    const ElevationMap reversed = ElevationFromPoints(points, nullptr, settings, {});
    EXPECT_EQ(straight.geometry, reversed.geometry);
    EXPECT_EQ(Answer(straight, settings), Answer(reversed, settings));
    settings.grid.x_min_m = settings.grid.x_max_m = settings.grid.y_min_m = settings.grid.y_max_m =
        3;
    const ElevationMap empty = ElevationFromPoints(points, nullptr, settings, {});
    EXPECT_NE(Answer(empty, settings), "site");
  }
}

TEST(BadPoints, NoneOneAndManyOnOnePlaceGiveNoSite) {
  const std::vector<std::vector<Eigen::Vector3d>> clouds = {
      {},
      {{0, 0, 0}},
      std::vector<Eigen::Vector3d>(1000, Eigen::Vector3d(3, 4, -5)),
      {{double(kNan), 0, 0}, {0, double(kInfinity), 0}},
      {{0, 0, 0}, {1e9, 1e9, 0}, {-1e9, 1e9, 5}}};
  for (const SladMode mode : kModes) {
    for (std::size_t i = 0; i < clouds.size(); ++i) {
      SCOPED_TRACE(i);
      const SladSettings settings = WithMode(mode);
      EXPECT_NE(Answer(ElevationFromPoints(clouds[i], nullptr, settings, {}), settings), "site");
    }
  }
}

TEST(BadMaps, LayersOfOtherSizesAreRefused) {
  const ElevationMap good = FlatMap();
  const HazardMaps hazards = EvaluateHazards(good, SladSettings{});
  for (int layer = 0; layer < 4; ++layer) {
    ElevationMap map = good;
    switch (layer) {
      case 0:
        map.variance_m2 = GridF(59, 60);
        break;
      case 1:
        map.frame_count = Grid<std::uint16_t>();
        break;
      case 2:
        map.state = Grid<CellState>(60, 61);
        break;
      default:
        map.flags = Grid<std::uint8_t>(1, 1);
    }
    const SiteSelection selection = SelectSites(map, hazards, SladSettings{}, Overhead());
    EXPECT_TRUE(selection.sites.empty());
    EXPECT_EQ(selection.none_reason, "the map's layers differ in size");
  }
}

}  // namespace
}  // namespace palace
