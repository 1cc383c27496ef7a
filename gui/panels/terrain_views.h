// Terrain views: the pictures under one decision, as Tune and Review show them.
#pragma once

#include <optional>
#include <string>

#include "engine/model/snapshot.h"
#include "gui/panels/map_probe.h"
#include "gui/panels/map_views.h"
#include "gui/widgets/map/camera_overlay.h"
#include "gui/widgets/map/map_image.h"

namespace palace {

/// A verdict is drawn on the picture of its own map only, give or take one missed map.
inline constexpr double kVerdictOld_s = 0.35;
/// How much older the decision's map is than the picture shown, s; NaN without either.
double AgeBehindPicture(const EngineSnapshot& snap, const TerrainDecision* decision);
/// The decision's verdict over the picture; nothing when its map is older than the picture.
void DrawCurrentVerdict(UiFrame& ui, const Rect& image, const EngineSnapshot& snap,
                        const TerrainDecision* decision, OverlayCache& cache);
/// What the overlay means; "Last map 4.2 s old" when it is not drawn.
void DrawVerdictPlate(UiFrame& ui, const Rect& image, const EngineSnapshot& snap,
                      const TerrainDecision* decision, LegendPlace& legend);

/// What is drawn over a left picture.
struct LeftPicture {
  const TerrainDecision* decision = nullptr;
  const TerrainDecision* ghost = nullptr;  ///< its best site is dashed where it differs
  const char* ghost_word = "applied";
  bool preview = false;
  std::string plate;  ///< fact at the bottom right
  const MapProbe* probe = nullptr;
  bool track_view = false;  ///< then the fact at the bottom right is the trackers'
};

/// The left picture at its own aspect inside `area`, with verdict, rings, legend and scale bar.
/// Hatch where no picture is known.
void DrawLeftPicture(UiFrame& ui, const Rect& area, const EngineSnapshot& snap,
                     const LeftPicture& look, OverlayCache& cache);
/// The right picture, without overlay but for the probe.
void DrawPlainPicture(UiFrame& ui, const Rect& area, const EngineSnapshot& snap,
                      ImTextureID texture, const std::string& plate,
                      const MapProbe* probe = nullptr);

/// Why there is no map: "No map yet", or why none is made here.
std::string NoMapWords(const EngineSnapshot& snap);
/// Why there is no picture: what the engine misses.
std::string NoPictureWords(const EngineSnapshot& snap);
/// Marks the site that is selected or flown to, beside the best of what is shown: in every
/// workspace, whatever the newest map says of it. `Marks`: SiteOverlay or MapMarks.
template <typename Marks>
void MarkLanding(const EngineSnapshot& snap, Marks& marks) {
  const MissionStatus& mission = snap.flight->mission;
  if (!mission.armed) {
    return;
  }
  marks.landing = mission.armed;
  marks.landing_commanded = mission.state >= MissionState::kApproved;
  const bool same = marks.selected && marks.selected->id == mission.armed->id;
  marks.commanded = marks.commanded || (same && marks.landing_commanded);
}

/// Another place, or the same place under another clear radius: worth two rings.
bool SitesDiffer(const LandingSite& a, const LandingSite& b);
/// Best site of a decision that the operator has not refused; null when it has none.
const LandingSite* BestSite(const EngineSnapshot& snap, const TerrainDecision* decision);
/// Area of the safe cells, m^2; NaN without a map.
double SafeArea(const TerrainDecision* decision);
/// "A"; of null "none".
std::string LetterOf(const LandingSite* site);

}  // namespace palace
