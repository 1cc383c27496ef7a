// Panels of the Fly workspace. Each is a free function over const data; see the .cpp of its name.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "gui/panels/fly_layout.h"
#include "gui/panels/fly_state.h"

namespace palace {

/// Fly lists, marks and names the sites of the limits in force alone, whatever is previewed: what a
/// command names is what the mission knows. Null before the first map.
const TerrainDecision* SitesInForce(const EngineSnapshot& snap);
/// The armed site, else the highlighted candidate, else the best one not refused; null without any,
/// and during a wave-off, when no site is proposed.
const LandingSite* SiteInView(const EngineSnapshot& snap, std::uint64_t highlighted);
/// The mission is past APPROVED: the descent panels are shown.
bool IsDescentView(const EngineSnapshot& snap);
/// What Fly draws: in the descent what is in force alone, whatever Tune previews. `snap` itself, or
/// `kept`, which it is copied to.
const EngineSnapshot& AsFlown(const EngineSnapshot& snap, std::optional<EngineSnapshot>& kept);
/// Seconds to the touchdown: "22"; "over 7" while the vehicle waits above the site until it is
/// still, which in gusts takes longer than by the clock.
std::string TimeToGo(const EngineSnapshot& snap);
/// The armed site was approved: the vehicle lands on it, or turned away from it.
bool IsCommanded(const MissionStatus& mission);
/// Marks that all maps share.
MapMarks MarksOf(const EngineSnapshot& snap, std::uint64_t highlighted);

/// Largest rectangle of the picture's shape at the top of the content.
Rect PictureRect(const Rect& content, double aspect);
/// Where the picture lies in its panel.
Rect LeftCameraImage(const EngineSnapshot& snap, const Rect& panel, const Style& style);
void DrawLeftCameraPanel(const EngineSnapshot& snap, const Rect& rect, CameraState& state,
                         const MapProbe& probe, UiFrame& ui);
void DrawRightCameraPanel(const EngineSnapshot& snap, const Rect& rect, const MapProbe& probe,
                          UiFrame& ui);
void DrawVehiclePanel(const EngineSnapshot& snap, const Rect& rect, bool narrow, UiFrame& ui);
/// Where the 3-D picture lies in its panel: it is rendered at this size.
Rect View3dScene(const Rect& panel, const Style& style);
/// A picture of the 3-D scene that is turned by hand: MoveView3d.
void RunOrbit(UiFrame& ui, std::string_view name, const Rect& scene);
/// Items "view_3d", "view/Orbit", "view/Above", "view/Behind": MoveView3d, ShowView3dPreset.
void DrawView3dPanel(const EngineSnapshot& snap, const Rect& rect, UiFrame& ui);
/// Five maps: items "map/elevation", "map/slope", "map/roughness", "map/cost", "map/safe_distance";
/// `named`: their heads name the site whose values they show.
void DrawMapRowPanel(const EngineSnapshot& snap, const std::array<Rect, 5>& rects, float side,
                     bool named, MapRowState& state, UiFrame& ui);
/// "tick_set" and "tick_keep", while a tick waits for its answer; call after all panels.
void DrawTickQuestion(const EngineSnapshot& snap, const Rect& body, MapRowState& state,
                      UiFrame& ui);
/// A click or Enter arms ("site/A"): SelectSite. The row with the focus: HighlightSite.
void DrawSiteListPanel(const EngineSnapshot& snap, const FlyLayout& layout, SiteListState& state,
                       UiFrame& ui);
/// Rows that have no room are counted in its head; item "evidence_rows" brings them into sight.
void DrawEvidencePanel(const EngineSnapshot& snap, const Rect& rect, bool folded, bool narrow,
                       std::uint64_t highlighted, RowScroll& scroll, UiFrame& ui);
/// Hold button "approve", button "refuse", list of guards behind "show_checks". `pin`: a place that
/// was pinned on a map.
void DrawApprovePanel(const EngineSnapshot& snap, const Rect& rect, bool narrow,
                      const std::optional<Eigen::Vector2d>& pin, ApproveState& state, UiFrame& ui);
/// "next_look": the look that the station proposes (FlyTo), from x on or up to there. Right end of
/// what it draws.
float DrawProposedLook(const EngineSnapshot& snap, float x, float y, bool ends_at_x, UiFrame& ui);
/// In a panel's head: "turn_left", "turn_right", "climb", with a pin "look_at_pin" (FlyTo); while
/// such a way is flown "hold_here" alone. At one place whatever the panel's title, which changes
/// with the state (Landing, Look, Approve).
void DrawWaysElsewhere(const EngineSnapshot& snap, const Rect& panel,
                       const std::optional<Eigen::Vector2d>& pin, UiFrame& ui);
/// From APPROVED on: "hold_here", after a wave-off "acknowledge_wave_off".
void DrawLandingPanel(const EngineSnapshot& snap, const Rect& rect, UiFrame& ui);
/// From LANDED on: "new_flight" (of a record: the way out of the review), "review_flight",
/// "open_report".
void DrawLandedPanel(const EngineSnapshot& snap, const Rect& rect, UiFrame& ui);
void DrawSiteRecheckPanel(const EngineSnapshot& snap, const Rect& rect, bool narrow,
                          MapProbe& probe, UiFrame& ui);
/// Every limit that acts now; what is over stands first. "limit_rows" as "evidence_rows".
void DrawLimitsInForcePanel(const EngineSnapshot& snap, const Rect& rect, bool narrow,
                            RowScroll& scroll, UiFrame& ui);
/// Every tracker of the site in a row ("tracker/Plane"), the consensus below them. With the
/// pictures of the one in force, or, where there is no room, in their place: "tracker_pictures".
void DrawTrackerPanel(const EngineSnapshot& snap, const Rect& rect, TrackerPanelState& state,
                      UiFrame& ui);
void DrawChannelStripPanel(const EngineSnapshot& snap, const Rect& rect, UiFrame& ui);
/// Tabs "tab/Descent" and "tab/Maps", and six plots.
void DrawPlotTabs(const EngineSnapshot& snap, const Rect& rect, PlotTab& tab, UiFrame& ui);
/// What the six plots show. The snapshot has a history.
std::array<PlotView, 6> DescentPlots(const EngineSnapshot& snap, const Palette& palette);
void DrawDescentPlotsPanel(const EngineSnapshot& snap, const std::array<Rect, 6>& rects,
                           PlotHover& hover, UiFrame& ui);

}  // namespace palace
