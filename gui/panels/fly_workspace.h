// Fly: the workspace of a live landing, from the first map to touchdown.
#pragma once

#include "gui/panels/fly_layout.h"
#include "gui/panels/fly_state.h"

namespace palace {

/// Draws the whole workspace below the shared frame and moves the focus to the hold button once
/// a site is armed.
void DrawFlyWorkspace(const EngineSnapshot& snap, const FlyLayout& layout, FlyState& state,
                      UiFrame& ui);
/// True when the layout must be computed with descent = true.
bool ShowsDescent(const EngineSnapshot& snap);

}  // namespace palace
