// Diagnose: what arrives, how long it takes, what went partly wrong, and what happened.
#pragma once

#include "engine/model/snapshot.h"
#include "gui/widgets/panel_frame.h"

namespace palace {

struct DiagnoseState {
  int event_offset = 0;  ///< newest events scrolled past
};

void DrawDiagnoseWorkspace(const EngineSnapshot& snap, const Rect& body, DiagnoseState& state,
                           UiFrame& ui);

}  // namespace palace
