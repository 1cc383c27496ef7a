// Mouse and keys for Dear ImGui where no window's backend brings them (scripts, tests), and
// questions about keys. The one place that knows that 1.86 (Debian 12) reads arrays by the
// keyboard's own numbers, while 1.89 and later (Debian 13) take events and know keys by name only.
#pragma once

#include <imgui.h>

namespace palace {

/// Once for an ImGui context, before its first frame, after its backend if there is one. From then
/// on a frame sees all that was fed before it, however much that is.
void StartFedInput();

void FeedMousePosition(ImVec2 position);
void FeedMouseButton(int button, bool down);
void FeedMouseWheel(float steps);
void FeedKey(ImGuiKey key, bool down);
void FeedModifiers(bool shift, bool ctrl);

/// Went down in this frame; `repeat`: or has been down for long enough to count again.
bool KeyPressed(ImGuiKey key, bool repeat);
bool KeyDown(ImGuiKey key);

}  // namespace palace
