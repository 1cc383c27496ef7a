// What the search map shows of ground, vehicle, sites and courses; what is done with it is
// search_map.h.
#pragma once

#include <vector>

#include <Eigen/Dense>

#include "engine/model/snapshot.h"
#include "gui/widgets/map/letter_places.h"
#include "gui/widgets/style.h"
#include "gui/widgets/ui_frame.h"

namespace palace {

inline constexpr ImU32 kLookedAt = Rgb(0x374250);  ///< on picture::kUnknown

/// Where places lie on the screen: north up.
struct MapGround {
  Rect rect;
  Eigen::Vector2d middle;
  double per_px;  // metres

  ImVec2 At(const Eigen::Vector2d& place) const {
    return {rect.x + rect.w / 2 + static_cast<float>((place.y() - middle.y()) / per_px),
            rect.y + rect.h / 2 - static_cast<float>((place.x() - middle.x()) / per_px)};
  }
  Eigen::Vector2d Place(ImVec2 at) const {
    return {middle.x() - static_cast<double>(at.y - rect.y - rect.h / 2) * per_px,
            middle.y() + static_cast<double>(at.x - rect.x - rect.w / 2) * per_px};
  }
  std::vector<ImVec2> At(const std::vector<Eigen::Vector2d>& places) const;
};

/// Squares that were looked at, the limit of the search, the courses to a selected site, the
/// vehicle with what it sees, and where it goes or would look.
void DrawSearchGround(const EngineSnapshot& snap, const MapGround& ground, UiFrame& ui);
/// The letters of the sites, none over another and each in `within`; while one is selected that one
/// alone. `offers`: a click on a letter selects its site ("letter/search_map/B"). `places`: where
/// they stand, from frame to frame.
void DrawSearchSites(const EngineSnapshot& snap, const MapGround& ground, const Rect& within,
                     bool offers, std::vector<LetterPlace>& places, UiFrame& ui);
/// "N" and an arrow at the bottom right.
void DrawNorth(const Rect& scene, UiFrame& ui);
double SeenArea_m2(const SeenGround& seen);

}  // namespace palace
