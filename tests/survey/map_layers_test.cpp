// The layers that become files: names, SI units, and what counts as a hazard in them.
#include "engine/survey/map_layers.h"

#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "engine/slad/slad.h"
#include "engine/survey/hazard_layer.h"
#include "tests/slad/worlds.h"

namespace palace {
namespace {

std::shared_ptr<const TerrainDecision> Decide(ElevationMap map) {
  Slad slad;
  slad.Take(std::move(map));
  return slad.Decide(Settings{}, Letters::kOfRecord);
}

std::map<std::string, GridF> ByName(const TerrainDecision& decision) {
  std::map<std::string, GridF> layers;
  for (DecidedLayer& layer : LayersOf(decision)) {
    layers[layer.name] = std::move(layer.cells);
  }
  return layers;
}

TEST(MapLayers, SlopesAreRadiansAndTheRestMetres) {
  constexpr double kSlope_rad = 0.1;
  const auto decision =
      Decide(testing::MakeMap(60, 60, 0.15, testing::Slope(kSlope_rad, 0.7), /*sigma_m=*/0.01));
  auto layers = ByName(*decision);
  EXPECT_EQ(layers.size(), 7u);
  EXPECT_NEAR(layers["slope"].at(30, 30), kSlope_rad, 0.01);
  EXPECT_NEAR(layers["elevation_sigma"].at(30, 30), 0.01, 1e-6);
  EXPECT_EQ(layers["elevation"].at(30, 30), decision->elevation->height_m.at(30, 30));
  EXPECT_EQ(layers["roughness"].at(30, 30), decision->hazards->roughness_m.at(30, 30));
  EXPECT_EQ(layers["safe_distance"].at(30, 30), decision->hazards->safe_distance_m.at(30, 30));
  EXPECT_EQ(layers["cost"].at(30, 30), decision->hazards->cost.at(30, 30));
  EXPECT_EQ(layers["hazard"].at(30, 30), 0);
}

TEST(MapLayers, UnknownStaysUnknownInEachOfThem) {
  const auto decision = Decide(testing::MakeMap(
      60, 60, 0.15, [](double north_m, double) { return north_m > 0 ? std::nan("") : 0.0; }));
  for (const DecidedLayer& layer : LayersOf(*decision)) {
    const bool is_distance = layer.name == "safe_distance";  // 0 on what is not safe
    EXPECT_EQ(std::isnan(layer.cells.at(5, 30)), !is_distance) << layer.name;
    EXPECT_FALSE(std::isnan(layer.cells.at(50, 30))) << layer.name;
  }
}

/// What counts at a cell itself: reasons and flags, not the room around it.
TEST(HazardLayer, IsWhatIsWrongAtTheCellItself) {
  const struct {
    const char* name;
    CellState state;
    unsigned reasons;
    float slope_rad;
    SladMode mode;
    float expected;
  } rows[] = {
      {"safe", CellState::kMeasured, 0, 0, SladMode::kModern, 0},
      {"steep", CellState::kMeasured, kHazardSlope, 1, SladMode::kModern, 1},
      {"filled hole", CellState::kFilled, kHazardUnknown, 0, SladMode::kModern, 0},
      {"border", CellState::kBorder, kHazardUnknown, 0, SladMode::kModern, NAN},
      {"thesis border", CellState::kBorder, kHazardUnknown, 0, SladMode::kThesis, 0},
      {"unknown", CellState::kUnknown, kHazardUnknown, NAN, SladMode::kModern, NAN},
      {"no plane", CellState::kMeasured, kHazardUnknown, NAN, SladMode::kModern, NAN},
      {"flag without a plane", CellState::kMeasured, kHazardFlagged, NAN, SladMode::kModern, 1},
  };
  for (const auto& row : rows) {
    ElevationMap map = testing::MakeMap(1, 1, 1, testing::Flat());
    map.state.at(0, 0) = row.state;
    HazardMaps hazards;
    hazards.reasons = Grid<std::uint8_t>(1, 1, static_cast<std::uint8_t>(row.reasons));
    hazards.slope_rad = GridF(1, 1, row.slope_rad);
    const float found = HazardLayer(map, hazards, row.mode).at(0, 0);
    EXPECT_TRUE(found == row.expected || (std::isnan(found) && std::isnan(row.expected)))
        << row.name << ": " << found;
  }
}

}  // namespace
}  // namespace palace
