// Diagnose: what arrives, how long it takes, what went partly wrong, and what happened.
#pragma once

#include "engine/model/snapshot.h"
#include "gui/widgets/panel_frame.h"

namespace palace {

struct DiagnoseState {
  int event_offset = 0;  ///< newest events scrolled past
};

/// Pitch at which `rows` rows fill the height, between a tight and a comfortable one.
float RowPitch(const Style& style, float height, std::size_t rows);
/// Each guard of the armed site: passes, or why not.
void DrawGuards(const EngineSnapshot& snap, const Rect& rect, UiFrame& ui);
/// All alarms, worst first, with their times.
void DrawAlarmTable(const EngineSnapshot& snap, const Rect& rect, UiFrame& ui);
/// What each camera gave, and what was lost on the way.
void DrawCameraTable(const EngineSnapshot& snap, const Rect& rect, UiFrame& ui);
/// What the last pair says about the cameras: coverage, rows, brightness, scale against the laser.
void DrawStereoHealth(const EngineSnapshot& snap, const Rect& rect, UiFrame& ui);
/// What did not get through the doors, and what each means; and the height that it needs.
void DrawLosses(const EngineSnapshot& snap, const Rect& rect, UiFrame& ui);
float LossesHeight(const EngineSnapshot& snap, const Style& style, float most);
/// What came over the bus, by channel and by sender; and the height that it needs.
void DrawBusTable(const EngineSnapshot& snap, const Rect& rect, UiFrame& ui);
float BusTableHeight(const EngineSnapshot& snap, const Style& style, float most);
/// Figures of the candidates of the newest map.
void DrawSiteTable(const EngineSnapshot& snap, const Rect& rect, UiFrame& ui);
void DrawDiagnoseWorkspace(const EngineSnapshot& snap, const Rect& body, DiagnoseState& state,
                           UiFrame& ui);

}  // namespace palace
