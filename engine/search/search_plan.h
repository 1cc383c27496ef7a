// Where to look next from a hover, while no site is selected: pure functions of what was looked at.
//
// Looks are weighed by the ground that they show first over the time that they take:
//   new_m2 / (turn + flight + kLook_s + unseen ground under the way / kUnseen_mps)
// over turns by eighths where it hovers, and level ways to eight sides, to the near and far edge of
// what is seen from here, each with eight headings. The best that may be flown is the next one;
// of equals the first in that order. The one that was proposed before stays until another is worth
// kBetter times as much: a person reads and presses it, and headings waver.
//
// Source: greedy next-best-view (Connolly 1985; Bircher et al. 2016 weigh gain against cost so).
#pragma once

#include <functional>
#include <optional>

#include <Eigen/Dense>

#include "engine/model/command.h"
#include "engine/model/mission/fly_area.h"
#include "engine/model/mission/seen_ground.h"
#include "engine/search/ground_view.h"

namespace palace {

struct SearchLook {
  FlyTo to;
  double new_m2 = 0;   ///< ground of the area that it shows first
  double takes_s = 0;  ///< the time that it was weighed by
};

struct SearchGround {
  const SeenGround& seen;
  const GroundView& view;
  const FlyArea* area = nullptr;  ///< null: kSearched_m round where it began
};

/// Ground of the area that was not looked at yet.
double LeftToSee_m2(const SearchGround& ground);

/// `may_fly`: asked of ways with the best first. `before`: what was proposed last; null: nothing.
/// Empty where no look shows kLeastNew_m2 of new ground or none may be flown.
std::optional<SearchLook> NextLook(const SearchGround& ground, const FlyTo& now,
                                   const std::function<bool(const FlyTo&)>& may_fly,
                                   const FlyTo* before = nullptr);
inline constexpr double kLeastNew_m2 = 20;
inline constexpr double kBetter = 1.2;

}  // namespace palace
