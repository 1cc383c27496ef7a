// Panels of the Fly workspace. Each is a free function over const data; see the .cpp of its name.
#pragma once

#include <array>

#include "gui/panels/fly_layout.h"
#include "gui/panels/fly_state.h"

namespace palace {

/// What the screen shows as decided: the preview while one exists, else what is applied.
const TerrainDecision* ShownDecision(const EngineSnapshot& snap);
/// The armed site, else the highlighted candidate, else the best one not refused; null without any.
const LandingSite* SiteInView(const EngineSnapshot& snap, std::uint64_t highlighted);
/// By hand: any candidate of a proposal; a refused one also while searching, for a second look.
bool MaySelect(const EngineSnapshot& snap, std::uint64_t site_id);
/// The mission is past APPROVED: the descent panels are shown.
bool IsDescentView(const EngineSnapshot& snap);
/// Marks that all maps share.
MapMarks MarksOf(const EngineSnapshot& snap, std::uint64_t highlighted);
/// The safe-distance map with its ranges, as the map row and the re-check panel show it.
MapView SafeDistanceMap(const EngineSnapshot& snap, const UiFrame& ui);

void DrawLeftCameraPanel(const EngineSnapshot& snap, const Rect& rect, CameraState& state,
                         const MapProbe& probe, std::uint64_t highlighted, UiFrame& ui);
void DrawRightCameraPanel(const EngineSnapshot& snap, const Rect& rect, const MapProbe& probe,
                          UiFrame& ui);
void DrawVehiclePanel(const EngineSnapshot& snap, const Rect& rect, bool narrow, UiFrame& ui);
void DrawView3dPanel(const EngineSnapshot& snap, const Rect& rect, View3dState& state, UiFrame& ui);
/// Five maps: items "map/elevation", "map/slope", "map/roughness", "map/cost", "map/safe_distance".
void DrawMapRowPanel(const EngineSnapshot& snap, const std::array<Rect, 5>& rects, float side,
                     std::uint64_t highlighted, bool letters, MapRowState& state, UiFrame& ui);
/// A click arms ("site/A"): SelectSite.
void DrawSiteListPanel(const EngineSnapshot& snap, const FlyLayout& layout, SiteListState& state,
                       UiFrame& ui);
void DrawEvidencePanel(const EngineSnapshot& snap, const Rect& rect, bool folded, bool narrow,
                       std::uint64_t highlighted, UiFrame& ui);
/// Hold button "approve", button "refuse", list of guards behind "show_checks".
void DrawApprovePanel(const EngineSnapshot& snap, const Rect& rect, bool narrow, bool focused,
                      ApproveState& state, UiFrame& ui);
/// From APPROVED on: "hold_here", after a wave-off "acknowledge_wave_off".
void DrawLandingPanel(const EngineSnapshot& snap, const Rect& rect, UiFrame& ui);
void DrawSiteRecheckPanel(const EngineSnapshot& snap, const Rect& rect, bool narrow,
                          MapProbe& probe, UiFrame& ui);
void DrawLimitsInForcePanel(const EngineSnapshot& snap, const Rect& rect, bool narrow, UiFrame& ui);
void DrawTrackerPanel(const EngineSnapshot& snap, const Rect& rect, UiFrame& ui);
void DrawChannelStripPanel(const EngineSnapshot& snap, const Rect& rect, UiFrame& ui);
/// Tabs "tab/Descent" and "tab/Maps", and six plots.
void DrawPlotTabs(const EngineSnapshot& snap, const Rect& rect, PlotTab& tab, UiFrame& ui);
void DrawDescentPlotsPanel(const EngineSnapshot& snap, const std::array<Rect, 6>& rects,
                           PlotHover& hover, UiFrame& ui);

}  // namespace palace
