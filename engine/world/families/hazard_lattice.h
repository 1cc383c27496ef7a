// Hazards so close to each other that no disc fits between them: the ground of `nowhere` and `one`.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "engine/core/random.h"
#include "engine/world/families/drawing.h"

namespace palace {

/// Places on a turned, jittered square lattice, `half_m` to every side of its middle: from any
/// place there the nearest is at most kLatticeGap_m away, so that every disc of that radius holds
/// one. What is left out is the relief of the families.
std::vector<Eigen::Vector2d> HazardLattice(RandomStream& random,
                                           const Eigen::Vector2d& middle_m = {16, 0},
                                           double half_m = 33);
inline constexpr double kLatticeGap_m = 1.45;

/// Mounds and holes of the relief, each too high or too deep for a step.
struct Mound {
  Blob outline;
  double up_m;    ///< negative: a hole
  double bank_m;  ///< width of its side
};
Mound DrawMound(RandomStream& random, const Eigen::Vector2d& place_m);

/// What stands at those places: a share of those where it may be are stones, for the family to
/// make.
struct MoundsAndStones {
  std::vector<Mound> mounds;
  std::vector<Eigen::Vector2d> stones_at;
};
MoundsAndStones DrawHazards(RandomStream& random, const std::vector<Eigen::Vector2d>& places,
                            double share,
                            const std::function<bool(const Eigen::Vector2d&)>& may_be_stone);

/// Height of all mounds at a place, found quickly among many.
class MoundField {
 public:
  explicit MoundField(std::vector<Mound> mounds);
  double Height(double north_m, double east_m) const;

 private:
  std::vector<Mound> mounds_;
  std::vector<std::vector<std::uint32_t>> near_;  ///< by squares of kSquare_m
};

}  // namespace palace
