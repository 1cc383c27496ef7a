// Site row: cut-out of the picture, letter, clear distance, status and one reason for its rank.
#pragma once

#include <string_view>

#include "engine/model/site_standing.h"
#include "gui/widgets/map/projection.h"

namespace palace {

struct SiteRowLook {
  bool selected = false;
  bool narrow = false;   ///< 44 units high, reason only
  bool enabled = true;   ///< a click arms
  bool refused = false;  ///< by the operator
  SiteStanding standing = SiteStanding::kProvisional;
  std::string standing_words{};  ///< empty: StandingWord
  bool old_map = false;  ///< nothing may rest on its map any more: it is confirmed no longer
  /// Of a selected site that holds no longer, or not surely: the engine's word and why.
  std::string_view verdict{}, why{};
};

struct SiteRowAnswer {
  bool clicked = false;
  bool focused = false;  ///< by keyboard
};

/// "site/A".
inline std::string SiteItemName(const std::string& letter) { return "site/" + letter; }

/// Draws the row (item "site/<letter>"). `view` maps the site into the left camera's texture;
/// empty: the cut-out is unknown.
SiteRowAnswer DrawSiteRow(UiFrame& ui, const Rect& rect, const LandingSite& site,
                          const std::optional<PictureView>& view, ImTextureID texture,
                          const SiteRowLook& look);

}  // namespace palace
