// Terrain views: maps and the left picture of one decision, as Tune and Review show them.
#pragma once

#include <optional>
#include <string>

#include "engine/model/snapshot.h"
#include "gui/widgets/camera_overlay.h"
#include "gui/widgets/map_image.h"

namespace palace {

enum class MapKind { kElevation, kSlope, kRoughness, kCost, kSafeDistance };

/// One map of `decision` (null: all unknown) with its limit tick. `applied` limits are drawn dashed
/// while they differ. The value is the one under `cursor`, else the one at the best site.
MapView MakeMapView(MapKind kind, const TerrainDecision* decision, ImTextureID texture,
                    const SladSettings* applied, std::optional<Cell> cursor);

/// What is drawn over a left picture.
struct LeftPicture {
  const TerrainDecision* decision = nullptr;
  const TerrainDecision* ghost = nullptr;  ///< its best site is dashed where it differs
  const char* ghost_word = "applied";
  bool preview = false;
  std::string plate;  ///< fact at the bottom right
};

/// The left picture at its own aspect inside `area`, with verdict, rings, legend and scale bar.
/// Hatch where no picture is known.
void DrawLeftPicture(UiFrame& ui, const Rect& area, const EngineSnapshot& snap,
                     const LeftPicture& look, OverlayCache& cache);
/// A picture without overlay.
void DrawPlainPicture(UiFrame& ui, const Rect& area, const EngineSnapshot& snap,
                      ImTextureID texture, const std::string& plate);

/// Best site of a decision, null when it has none.
const LandingSite* BestSite(const TerrainDecision* decision);
/// Area of the safe cells, m^2; NaN without a map.
double SafeArea(const TerrainDecision* decision);
/// "A", "none".
std::string BestLetter(const TerrainDecision* decision);

}  // namespace palace
