// Why a cell of the hazard maps is safe or not: every term with its value, limit and band, and the
// one that decided.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/model/elevation_map.h"
#include "engine/model/landing_site.h"
#include "engine/model/settings/settings.h"

namespace palace {

enum class CellTerm : std::uint8_t {
  kSlope,           ///< rad
  kRoughness,       ///< m
  kStep,            ///< m
  kProbability,     ///< 0..1, of what is seen
  kHazardDistance,  ///< m, against the clear radius
};

/// One term of one cell, in SI. Modern mode: roughness and step are the largest under a lander that
/// stands on the cell.
struct ExplainedTerm {
  CellTerm term = CellTerm::kSlope;
  Figure figure;         ///< NaN unknown; three_sigma 0 or NaN: no band is known
  double limit = 0;      ///< a largest value, of probability and distance a least one
  bool over = false;     ///< the wrong side of the limit
  bool decided = false;  ///< what the cell counts under
};

/// The hazard nearest to a cell that is no hazard itself.
struct NearestHazard {
  std::optional<Cell> cell;  ///< empty: the edge of the map
  double distance_m = 0;     ///< between cell centres
  double bearing_rad = 0;    ///< from the cell, from north clockwise, 0..2 pi
  std::uint8_t reasons = 0;  ///< its HazardReason bits; of the edge kHazardUnknown
  std::uint8_t flags = 0;    ///< its TerrainFlag bits
  /// Something seen, not merely something not known.
  bool IsSeen() const;
};

struct CellExplanation {
  Cell cell;
  CellState state = CellState::kUnknown;
  Figure height_m;           ///< up-positive
  int frames = 0;            ///< fused into the cell
  double age_s = 0;          ///< since it was measured, at the time of the map; NaN never
  std::uint8_t flags = 0;    ///< TerrainFlag bits
  std::uint8_t reasons = 0;  ///< HazardReason bits of the cell itself
  bool can_bear = false;     ///< a lander could be sent to this cell
  std::vector<ExplainedTerm> terms;
  std::optional<NearestHazard> nearest{};
  std::string verdict;  ///< one sentence: what decided, with value and limit
};

/// What the probability of a safe touchdown must reach where heights are known to `sigma_m`, a
/// rock's size averaged, and `hidden_things` rocks and holes are expected unseen (NaN: none):
///   min(min_safe_probability, 1 - (sigma / 5 cm)^2) max(exp(-hidden_things), kOffered)
/// The worse the ground is seen, the less certain can even level ground be: among simulated
/// touchdowns its chance of being unsafe grew with the square of sigma. A place may be a few times
/// worse than that, and hide as much as ground of which nothing is known; what passes so is
/// provisional until it has been seen. In metres, not in shares of a limit: a stricter limit must
/// never ask for less.
double RequiredSafeProbability(const SladSettings& settings, double sigma_m, double hidden_things);
/// The share that what may hide takes from the probability and from what is asked of it alike,
/// max(exp(-hidden_things), kOffered). So a person is shown both without it: the probability as
/// far as the ground is seen, against a limit that does not move with what hides.
double ForgivenHidden(double hidden_things);
/// Sigma at which any probability would do.
inline constexpr double kProvisionalSigma_m = 0.05;
/// Ground of which nothing is known hides a rock or hole with 0.15 (hidden_things.h). Where
/// something stands out that may be one, more hides, and the place is not offered.
inline constexpr double kOffered = 0.8;

/// The terms of a site against the limits, in the order of CellTerm. Thesis mode has no step and no
/// probability. None is marked as the one that decided.
std::vector<ExplainedTerm> TermsOf(const LandingSite& site, const SladSettings& settings);
/// Inside its limit, but with the limit within the band. False where no band is known.
bool BandCrossesLimit(const ExplainedTerm& term);

/// A term in words: "Slope", "2.1°", "± 0.3°", "max 10°". A value that is not known is "––", a band
/// that is not known empty.
struct TermWords {
  std::string name, value, spread, limit;
};
TermWords WordsOf(const ExplainedTerm& term);

/// "measured", "filled", "border", "unknown".
const char* CellStateWord(CellState state);
/// "roughness, 1.1 m south-west", "thin structure, 1.9 m south", "map edge, 0.8 m west".
std::string WhereWords(const NearestHazard& nearest);
/// "thin structure, motion"; empty when there is none.
std::string FlagWords(unsigned flags);
/// What hazard reason bits say of a cell, worst first: "slope", "roughness, step".
std::string ReasonWords(unsigned reasons);
/// "north", "south-west": the nearest of eight, for a direction from north clockwise.
const char* DirectionWord(double bearing_rad);

}  // namespace palace
