// The 72 courses to the selected site as a rose round it on the search map: each a ray on the side
// that it comes from, as long as it suits. The ring is a score of 1. Broken in orange: something
// stands there, or the wind comes too much from behind. White: the planned one.
#pragma once

#include <string>

#include "engine/model/snapshot.h"
#include "gui/panels/search_map_marks.h"
#include "gui/widgets/ui_frame.h"

namespace palace {

/// It is drawn: a site is selected, and its courses were judged.
bool HasCourses(const MissionStatus& mission);
void DrawCourses(const MissionStatus& mission, const MapGround& ground, UiFrame& ui);
/// "Approach 045°: wind 0.92, sun not known, turn 0.60"; empty without a selected site.
std::string HeadingWords(const EngineSnapshot& snap);

}  // namespace palace
