// Camera overlay: the hazard verdict, the safe contour, site rings to scale, tracker marks.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "gui/widgets/map/projection.h"
#include "gui/widgets/map/site_marks.h"

namespace palace {

/// Where the legend stood last, among the ways and corners it may stand in.
struct LegendPlace {
  std::size_t ways = 0;  ///< that there were; 0: nowhere yet
  std::size_t way = 0, corner = 0;
};

/// Contours of the verdict last drawn; kept so that they are traced once per map, not per frame.
struct OverlayCache {
  std::shared_ptr<const ImageU8> verdict;
  std::vector<std::vector<ImVec2>> contours;
  LegendPlace legend;
};

/// Orange tint and hatch over a limit and where nothing is known, a sparse hatch where only a
/// neighbour is a hazard, contour 1.5 px round what can be landed on.
void DrawVerdict(UiFrame& ui, const Rect& image, std::shared_ptr<const ImageU8> verdict,
                 OverlayCache& cache);

struct SiteOverlay {
  const std::vector<LandingSite>* sites = nullptr;
  /// Letters select by a click, refused ones are struck through; null: they are marks only.
  const MissionStatus* mission = nullptr;
  std::optional<LandingSite> selected;  ///< armed, else the best
  std::uint64_t highlighted = 0;
  bool commanded = false;              ///< approved: filled centre
  std::optional<LandingSite> landing;  ///< selected or flown to, where that is another one
  bool landing_commanded = false;
  std::string landing_word;          ///< "Landing on"
  std::optional<LandingSite> ghost;  ///< applied or recorded place while previewing
  std::string ghost_words;           ///< "applied A"
};
/// Rings, crosses and letters, projected with the pose of the picture.
void DrawSites(UiFrame& ui, const PictureView& view, const SiteOverlay& overlay);
/// Brackets, search window. Of many features only the first: more would hide the picture.
inline constexpr std::size_t kFeaturesDrawn = 24;
void DrawTracker(UiFrame& ui, const PictureView& view, const TrackerStatus& tracker);
/// An item of this name keeps its place: the plate below stands elsewhere.
inline constexpr const char* kTrackLegend = "track_legend";
/// Plate "Safe to land on | Over a limit or unknown | Too near a hazard" in a corner where it hides
/// no letter and no ring of a site, the top left if it can; under it one of the flags that occur.
/// In small pictures without the flags, or as "Safe | Over | Near", if only these hide none; where
/// a ring fills the picture, over the ring. It stays where it stood last while that is as good as
/// any other place: `place`. Item "legend". Call after DrawSites.
void DrawVerdictLegend(UiFrame& ui, const Rect& image, unsigned flags, LegendPlace& place);

}  // namespace palace
