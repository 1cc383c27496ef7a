// Camera overlay: the hazard verdict, the safe contour, site rings to scale, tracker marks.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gui/widgets/map/projection.h"
#include "gui/widgets/map/site_marks.h"
#include "gui/widgets/map/verdict_legend.h"

namespace palace {

/// Contours of the verdict last drawn; kept so that they are traced once per map, not per frame.
struct OverlayCache {
  std::shared_ptr<const ImageU8> verdict;
  std::vector<std::vector<ImVec2>> contours;
  LegendPlace legend;
};

/// Orange tint and hatch over a limit and where nothing is known, a sparse hatch where there is no
/// hazard itself but no place for a lander either, contour 1.5 px round what can be landed on.
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
/// Names of their items: letters, rings.
inline constexpr const char *kSiteMark = "site_mark", *kSiteRing = "ring",
                            *kLandingRing = "landing_ring";
/// Rings, crosses and letters, projected with the pose of the picture.
void DrawSites(UiFrame& ui, const PictureView& view, const SiteOverlay& overlay);
/// Brackets, search window. Of many features only the first: more would hide the picture.
inline constexpr std::size_t kFeaturesDrawn = 24;
void DrawTracker(UiFrame& ui, const PictureView& view, const TrackerStatus& tracker);

}  // namespace palace
