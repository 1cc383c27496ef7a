// Words about the area that the vehicle is kept to (wording.h).
#include <algorithm>

#include "engine/core/text.h"
#include "engine/mission/wording.h"
#include "engine/model/mission/fly_area.h"

namespace palace::words {

std::string AreaSet(const FlyArea& area, const char* who, const Eigen::Vector3d& p_WB) {
  const std::string outside = p_WB.allFinite() ? OutsideWords(area, p_WB) : "";
  return WithNumbers("Vehicle kept to an area of %.0f m² up to %.0f m, by ", AreaOf_m2(area),
                     area.ceiling_m) +
         who + (outside.empty() ? "" : "; it hovers " + outside);
}

std::string WayLeavesArea(const FlyArea& area, const Eigen::Vector2d& from_W,
                          const Eigen::Vector2d& to_W) {
  const double out_m = LeavesBy_m(area, from_W, to_W);
  if (!(out_m > 0)) {
    return {};
  }
  const bool comes_in = !IsInside(area, from_W);
  if (comes_in && !IsInside(area, to_W)) {
    return WithNumbers("It ends %.1f m outside the area", ToEdge_m(area, to_W));
  }
  return std::string("It leaves the area") + (comes_in ? " again" : "") +
         (out_m < 0.1 ? "" : WithNumbers(" by %.1f m", out_m));
}

std::string WayToSiteLeavesArea(const FlyArea& area, const std::vector<Eigen::Vector3d>& way_W,
                                const std::string& letter) {
  double out_m = 0;
  for (std::size_t k = 1; k < way_W.size(); ++k) {
    out_m = std::max(out_m, LeavesBy_m(area, way_W[k - 1].head<2>(), way_W[k].head<2>()));
  }
  if (!(out_m > 0)) {
    return {};
  }
  const Eigen::Vector2d site = way_W.back().head<2>();
  return IsInside(area, site)
             ? "The way to site " + letter + WithNumbers(" leaves the area by %.1f m", out_m)
             : "Site " + letter +
                   WithNumbers(" lies %.1f m outside the area", ToEdge_m(area, site));
}

}  // namespace palace::words
