// The shared frame of every workspace: top bar, alarm strip, WAVE OFF, status bar.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "engine/model/snapshot.h"
#include "gui/panels/fly_layout.h"
#include "gui/widgets/draw.h"

namespace palace {

/// An alarm that the operator put aside: the very one that stood then.
struct ShelvedAlarm {
  AlarmId kind = AlarmId::kCameraLeft;
  AlarmLevel level = AlarmLevel::kCaution;
  Timestamp since;
};

/// A row of the alarm list.
struct ListedAlarm {
  Alarm alarm;
  bool gone = false;  ///< told no more: over, and answered where it asked for an answer
};

/// Own state of the frame. The app sets what the frame cannot know from the snapshot.
struct FrameState {
  Workspace workspace = Workspace::kFly;
  std::string preset_name = "defaults";  ///< set by the app
  double frame_ms = 0;                   ///< set by the app
  std::string text_note;                 ///< set by the app: a text size that does not fit
  bool history_open = false;             ///< alarm list below the strip
  std::vector<ListedAlarm> listed;       ///< its rows, in the order in which they came to it
  std::vector<ShelvedAlarm> shelved;     ///< as long as they stand as they were shelved
  /// UI clock when a wave-off was asked for last; set by the app, whoever asked.
  double wave_off_sent_s = -std::numeric_limits<double>::infinity();
};

/// Mode block, name, workspace tabs ("tab/Fly" ...), state chain.
void DrawTopBarPanel(const EngineSnapshot& snap, const FrameLayout& layout, FrameState& state,
                     UiFrame& ui);
/// The first alarm: of those that stand the worst, else of those that are over. Shelve ("shelve"),
/// count of the rest. "acknowledge" answers the first that waits for an answer, and names it where
/// it is another. "unshelve" says how many are shelved and brings them back; one that ends, worsens
/// or is raised anew comes back by itself.
void DrawAlarmStripPanel(const EngineSnapshot& snap, const Rect& rect, FrameState& state,
                         UiFrame& ui);
/// Fires WaveOff on press ("wave_off"); stays pressed until the mission left ABORTING.
void DrawWaveOffPanel(const EngineSnapshot& snap, const Rect& rect, FrameState& state, UiFrame& ui);
void DrawStatusBarPanel(const EngineSnapshot& snap, const FrameLayout& layout,
                        const FrameState& state, UiFrame& ui);
/// All of the above, the window's background, and the violet frame of a replay.
void DrawFrameBar(const EngineSnapshot& snap, const FrameLayout& layout, FrameState& state,
                  UiFrame& ui);
/// Call after the workspace: the violet frame and the list of alarms ("acknowledge/gps_error") lie
/// over it. The list opens and closes by the operator's hand alone, and its rows keep their places.
void DrawFrameOverlay(const EngineSnapshot& snap, const FrameLayout& layout, FrameState& state,
                      UiFrame& ui);

}  // namespace palace
