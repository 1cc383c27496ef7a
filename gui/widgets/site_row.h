// Site row: cut-out of the picture, letter, clear distance, status and one reason for its rank.
#pragma once

#include "gui/widgets/map/projection.h"

namespace palace {

struct SiteRowLook {
  bool selected = false;
  bool narrow = false;   ///< 44 units high, reason only
  bool enabled = true;   ///< a click arms
  bool refused = false;  ///< by the operator
};

struct SiteRowAnswer {
  bool clicked = false;
  bool focused = false;  ///< by keyboard
};

/// "site/A".
inline std::string SiteItemName(char letter) { return std::string("site/") + letter; }

/// Draws the row (item "site/<letter>"). `view` maps the site into the left camera's texture;
/// empty: the cut-out is unknown.
SiteRowAnswer DrawSiteRow(UiFrame& ui, const Rect& rect, const LandingSite& site,
                          const std::optional<PictureView>& view, ImTextureID texture,
                          const SiteRowLook& look);

}  // namespace palace
