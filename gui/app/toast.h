// Toast: a sentence for some seconds, at the lower right of a place where it hides no figure.
#pragma once

#include <string>

#include "gui/panels/fly_layout.h"
#include "gui/widgets/draw.h"

namespace palace {

/// On Fly over the 3-D view or search map, above what stands at its foot: plates and scales there,
/// colour bars, readouts and channels stay in sight.
Rect ToastRoom(const FlyLayout& fly, const Style& style);
/// On other workspaces: beside the right column, where buttons that commit are.
Rect ToastRoom(const FrameLayout& frame, const Style& style);

/// As wide as its words and no wider than the room, in as many lines as that takes. Recorded as
/// "toast".
void DrawToast(const Rect& room, const std::string& words, UiFrame& ui);

}  // namespace palace
