// Camera overlay: the hazard verdict, the safe contour, site rings to scale, tracker marks.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "gui/widgets/map/projection.h"
#include "gui/widgets/map/site_marks.h"

namespace palace {

/// Contours of the verdict last drawn; kept so that they are traced once per map, not per frame.
struct OverlayCache {
  std::shared_ptr<const ImageU8> verdict;
  std::vector<std::vector<ImVec2>> contours;
};

/// Orange tint and hatch on hazards and unknown ground, contour 1.5 px round what can be landed on.
void DrawVerdict(UiFrame& ui, const Rect& image, std::shared_ptr<const ImageU8> verdict,
                 OverlayCache& cache);

struct SiteOverlay {
  const std::vector<LandingSite>* sites = nullptr;
  std::optional<LandingSite> selected;  ///< armed, or none
  std::uint64_t highlighted = 0;
  bool commanded = false;            ///< approved: filled centre
  std::optional<LandingSite> ghost;  ///< applied or recorded place while previewing
  std::string ghost_words;           ///< "applied A"
};
/// Rings, crosses and letters, projected with the pose of the picture.
void DrawSites(UiFrame& ui, const PictureView& view, const SiteOverlay& overlay);
/// Brackets, search window.
void DrawTracker(UiFrame& ui, const PictureView& view, const TrackerStatus& tracker);
/// Plate "Safe | Over a limit or unknown" at the top left; under it one of the flags that occur.
void DrawVerdictLegend(UiFrame& ui, const Rect& image, unsigned flags = 0);

}  // namespace palace
