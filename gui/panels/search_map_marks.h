// What the search map shows of ground, vehicle, sites and courses; what is done with it is
// search_map.h.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Dense>

#include "engine/model/snapshot.h"
#include "gui/widgets/ui_frame.h"

namespace palace {

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

/// Squares that were looked at, the limit of the search, the courses to a selected site, sites, the
/// vehicle with what it sees, and where it goes or would look.
void DrawSearchGround(const EngineSnapshot& snap, const MapGround& ground, UiFrame& ui);
/// "N" and an arrow at the bottom right.
void DrawNorth(const Rect& scene, UiFrame& ui);
double SeenArea_m2(const SeenGround& seen);
/// "Approach 045°: wind 0.92, sun not known, turn 0.60"; empty without a selected site.
std::string HeadingWords(const EngineSnapshot& snap);

}  // namespace palace
