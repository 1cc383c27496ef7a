// The shared frame of every workspace: top bar, alarm strip, WAVE OFF, status bar.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "engine/model/snapshot.h"
#include "gui/panels/fly_layout.h"
#include "gui/widgets/draw.h"

namespace palace {

/// Own state of the frame. The app sets what the frame cannot know from the snapshot.
struct FrameState {
  Workspace workspace = Workspace::kFly;
  bool frozen = false;                   ///< display only, set by the app
  std::string preset_name = "defaults";  ///< set by the app
  double frame_ms = 0;                   ///< set by the app
  bool history_open = false;             ///< alarm list below the strip
  std::vector<AlarmId> shelved;          ///< alarms the operator shelved
  double wave_off_sent_s = -std::numeric_limits<double>::infinity();
};

/// Mode block, name, workspace tabs ("tab/Fly" ...), state chain.
void DrawTopBarPanel(const EngineSnapshot& snap, const FrameLayout& layout, FrameState& state,
                     UiFrame& ui);
/// Worst alarm, Acknowledge ("acknowledge"), Shelve ("shelve"), count of the rest.
void DrawAlarmStripPanel(const EngineSnapshot& snap, const Rect& rect, FrameState& state,
                         UiFrame& ui);
/// Fires WaveOff on press ("wave_off"); stays pressed until the mission left ABORTING.
void DrawWaveOffPanel(const EngineSnapshot& snap, const Rect& rect, FrameState& state, UiFrame& ui);
void DrawStatusBarPanel(const EngineSnapshot& snap, const FrameLayout& layout,
                        const FrameState& state, UiFrame& ui);
/// All of the above, the window's background, and the violet frame of a replay.
void DrawFrameBar(const EngineSnapshot& snap, const FrameLayout& layout, FrameState& state,
                  UiFrame& ui);
/// Call after the workspace: the violet frame and the list of alarms lie over it.
void DrawFrameOverlay(const EngineSnapshot& snap, const FrameLayout& layout, FrameState& state,
                      UiFrame& ui);

}  // namespace palace
