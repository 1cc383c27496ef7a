// Map views: what the five maps of a decision show, built in one place for all workspaces.
//
// Ranges of the colours, as the pictures are coloured: slope, roughness and safe distance over so
// many limits (gui/render/map_scale.h), cost 0..1; elevation is fixed once per mission. Shown in
// degrees, centimetres and metres.
#pragma once

#include <cmath>
#include <optional>

#include "engine/model/mission/map_age.h"
#include "engine/model/snapshot.h"
#include "gui/widgets/map/map_image.h"

namespace palace {

enum class MapKind { kElevation, kSlope, kRoughness, kCost, kSafeDistance };

/// Of which decision, and against which limits.
struct MapSource {
  const TerrainDecision* decision = nullptr;  ///< null: all unknown
  const SladSettings* applied = nullptr;  ///< drawn dashed where they differ from the decision's
  const SladSettings* wanted = nullptr;  ///< what dragging a tick starts from; null: the decision's
  std::optional<Cell> cursor{};          ///< the value shown is the one here,
  const LandingSite* site = nullptr;     ///< else the one at this site
  double old_s = NAN;                    ///< age of a map that nothing may rest on any more
};

/// One map with its limit tick. The texture is the one uploaded for the decision shown.
MapView MakeMapView(MapKind kind, const MapSource& source, const PanelTextures& textures);
/// The decision that the screen shows: the preview while one exists, else what is applied; the
/// limits of the other one dashed.
MapSource ShownMap(const EngineSnapshot& snap, double silent_s = 0);
/// Age of that decision's map on the screen; NaN without one.
double ShownMapAge(const EngineSnapshot& snap, double silent_s);

}  // namespace palace
