// What greys, dashes and colours on the search map mean: only of what is drawn on it now.
#pragma once

#include "engine/model/snapshot.h"
#include "gui/widgets/ui_frame.h"

namespace palace {

/// In rows as wide as the map, from `bottom` upwards. Returns its upper edge.
float DrawSearchLegend(const EngineSnapshot& snap, const Rect& map, float bottom, UiFrame& ui);

}  // namespace palace
