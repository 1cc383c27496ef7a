// Tune: every limit beside what it does to the picture, the maps and the chosen site.
//
// When a moved limit applies, and whether applying drops a site, is what the engine says
// (SessionPart::limits_apply, apply_drops). The history has one entry a gesture.
#pragma once

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "engine/model/limit_sweep.h"
#include "engine/model/snapshot.h"
#include "gui/panels/terrain_views.h"
#include "gui/panels/tune/preset_panel.h"
#include "gui/panels/tune/setting_history.h"
#include "gui/widgets/plot.h"
#include "gui/widgets/slider_row.h"

namespace palace {

enum class TuneTab { kApply, kSweep, kCells, kHistory };

/// Which limit is swept: the one moved last, until another is chosen.
struct SweepChoice {
  std::string limit = "slad.max_slope_deg";  ///< MaySweep
  std::size_t after_steps = 0;               ///< of the history that it has followed
};

struct TuneState {
  SliderState sliders;
  LimitDrag map_drag;
  OverlayCache overlay;
  char search[48] = {};
  bool changed_only = false;
  std::set<std::string> folded = {"Stereo", "Tracker", "Mission"};
  int first_row = 0;     ///< scrolled past
  std::string followed;  ///< row with the focus that the list has scrolled to
  SettingHistory history;
  MapProbe probe;
  TuneTab tab = TuneTab::kApply;  ///< narrow windows
  PresetState preset;
  SweepChoice swept;
  std::shared_ptr<const LimitSweep> sweep;  ///< the newest, perhaps of another limit; null: none
  PlotHover sweep_hover;
  LimitsApply told = LimitsApply::kAtOnce;  ///< when a moved limit applied, in the last frame
  double withheld_until_s = 0;              ///< UI clock: until then no press moves a limit
};

/// What waits to be read: a press that was meant as a preview applies nothing.
bool IsWithheld(const TuneState& state, const UiFrame& ui);

/// What a limit would do, counted once a frame.
struct TuneFacts {
  const TerrainDecision* shown = nullptr;    ///< preview while previewing, else applied
  const TerrainDecision* applied = nullptr;  ///< may be null
  const LandingSite* best_shown = nullptr;   ///< of these two, of what is not refused
  const LandingSite* best_applied = nullptr;
  bool previewing = false;
  int changed = 0;  ///< from the defaults
  int pending = 0;  ///< previewed, not applied
};
TuneFacts FactsOf(const EngineSnapshot& snap);

/// Name of the preset, as people know it: "r50-field"; "defaults" where none was loaded.
std::string PresetName(const TuneState& state);
/// Of the limits in force: "r50-field", "r50-field + 2 changes"; where none was loaded "defaults",
/// or how many are not: "2 changed".
std::string LimitsName(const TuneState& state, const Settings& applied);

void DrawTuneWorkspace(const EngineSnapshot& snap, const Rect& body, TuneState& state, UiFrame& ui);

void DrawLimitsPanel(const EngineSnapshot& snap, const Rect& rect, TuneState& state, UiFrame& ui);
void DrawTuneCamera(const EngineSnapshot& snap, const Rect& rect, TuneState& state, UiFrame& ui);
void DrawTuneMap(const EngineSnapshot& snap, const Rect& rect, MapKind kind, bool colour_bar,
                 TuneState& state, UiFrame& ui);
void DrawCompareStrip(const EngineSnapshot& snap, const Rect& rect, TuneState& state, UiFrame& ui);
void DrawCellsPanel(const EngineSnapshot& snap, const Rect& rect, UiFrame& ui);
void DrawChosenPanel(const EngineSnapshot& snap, const Rect& rect, UiFrame& ui);
/// Area and best place over the whole range of one limit. A press on the plot moves the limit.
void DrawSweepPanel(const EngineSnapshot& snap, const Rect& rect, TuneState& state, UiFrame& ui);
void DrawHistoryPanel(const EngineSnapshot& snap, const Rect& rect, const TuneState& state,
                      UiFrame& ui);
void DrawApplyPanel(const EngineSnapshot& snap, const Rect& rect, UiFrame& ui);

}  // namespace palace
