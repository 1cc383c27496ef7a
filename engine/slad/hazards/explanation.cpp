#include "engine/slad/hazards/explanation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/core/text.h"
#include "engine/core/units.h"
#include "engine/slad/hazards/ground_classes.h"
#include "engine/slad/hazards/hazard_layers.h"
#include "engine/slad/hazards/site_figures.h"

namespace palace {
namespace {

bool IsHazard(const HazardMaps& hazards, Cell cell) {
  return !hazards.geometry.Contains(cell) || hazards.reasons.at(cell) != kHazardNone;
}

/// Of equally near ones the northernmost, then westernmost.
NearestHazard FindNearestHazard(const HazardMaps& hazards, Cell from) {
  const GridGeometry& g = hazards.geometry;
  // The map's distance may run to the side of a cell or to its middle, and is rounded.
  const double known_m = static_cast<double>(hazards.safe_distance_m.at(from));
  const int reach =
      std::min(static_cast<int>(known_m / g.cell_m) + 2, std::max(g.rows, g.cols) + 1);
  Cell nearest = from;
  int best = std::numeric_limits<int>::max();
  for (int dr = -reach; dr <= reach; ++dr) {
    for (int dc = -reach; dc <= reach; ++dc) {
      const Cell cell{from.row + dr, from.col + dc};
      if (dr * dr + dc * dc < best && IsHazard(hazards, cell)) {
        best = dr * dr + dc * dc;
        nearest = cell;
      }
    }
  }
  NearestHazard found;
  found.distance_m = g.cell_m * std::sqrt(best);
  found.bearing_rad = std::atan2(nearest.col - from.col, from.row - nearest.row);
  found.bearing_rad += found.bearing_rad < 0 ? 2 * std::numbers::pi : 0;
  const bool inside = g.Contains(nearest);
  found.cell = inside ? std::optional(nearest) : std::nullopt;
  found.reasons = inside ? hazards.reasons.at(nearest) : std::uint8_t{kHazardUnknown};
  found.flags = inside && !hazards.flags.empty() ? hazards.flags.at(nearest) : std::uint8_t{0};
  return found;
}

std::string WhyUnknown(CellState state) {
  switch (state) {
    case CellState::kUnknown:
      return "Never measured";
    case CellState::kFilled:
      return "A filled hole, not measured";
    case CellState::kBorder:
      return "A filled rim, not measured";
    case CellState::kMeasured:
      break;
  }
  return "Too little known around it";
}

std::string Sentence(const ExplainedTerm& term, const std::string& where) {
  const TermWords words = WordsOf(term);
  return words.name + where + " " + words.value + ", " + words.limit;
}

ExplainedTerm* Find(CellExplanation& e, CellTerm wanted) {
  const auto at = std::find_if(e.terms.begin(), e.terms.end(),
                               [&](const ExplainedTerm& t) { return t.term == wanted; });
  return at == e.terms.end() ? nullptr : &*at;
}

/// The term whose share of its limit is largest among those a hazard bit may stand for.
ExplainedTerm* Worse(ExplainedTerm* a, ExplainedTerm* b) {
  const auto share = [](const ExplainedTerm* t) {
    return t != nullptr && t->limit > 0 ? t->figure.value / t->limit : -1.0;
  };
  return share(b) > share(a) ? b : a;
}

void Decide(CellExplanation& e, ExplainedTerm* term, const std::string& where) {
  if (term != nullptr) {
    term->decided = true;
    e.verdict = Sentence(*term, where);
  }
}

/// A cell that is a hazard itself.
void DecideHazard(CellExplanation& e) {
  const unsigned reasons = e.reasons;
  if ((reasons & kHazardSlope) != 0) {
    Decide(e, Find(e, CellTerm::kSlope), "");
  } else if ((reasons & (kHazardRoughness | kHazardStep)) != 0) {
    ExplainedTerm* rough =
        (reasons & kHazardRoughness) != 0 ? Find(e, CellTerm::kRoughness) : nullptr;
    ExplainedTerm* step = (reasons & kHazardStep) != 0 ? Find(e, CellTerm::kStep) : nullptr;
    Decide(e, Worse(rough, step), " here");
  } else if ((reasons & kHazardUnknown) != 0) {
    e.verdict = WhyUnknown(e.state);
  } else if ((reasons & kHazardFlagged) != 0) {
    e.verdict = "Flagged: " + FlagWords(e.flags);
  } else {
    Decide(e, Find(e, CellTerm::kProbability), "");
  }
}

/// " under the lander", " under a lander 0.3 m north" where a touchdown beside the cell breaks it.
std::string WhoBreaks(const HazardMaps& hazards, const SladSettings& settings, Cell cell) {
  const Cell worst = WorstTouchdown(hazards, settings, cell);
  if (worst == cell) {
    return " under the lander";
  }
  const double north = cell.row - worst.row, east = worst.col - cell.col;
  return WithNumbers(" under a lander %.1f m ", hazards.geometry.cell_m * std::hypot(north, east)) +
         DirectionWord(std::atan2(east, north));
}

/// A cell that is none: is there room for the lander, and does every touchdown keep the limits?
void DecideRoom(const HazardMaps& hazards, const SladSettings& settings, CellExplanation& e) {
  e.nearest = FindNearestHazard(hazards, e.cell);
  ExplainedTerm* room = Find(e, CellTerm::kHazardDistance);
  if (room->over) {
    Decide(e, room, "");
    e.verdict += "; " + WhereWords(*e.nearest);
    return;
  }
  if (!CanBearLander(hazards, e.cell)) {
    const auto over = std::find_if(e.terms.begin(), e.terms.end(),
                                   [](const ExplainedTerm& term) { return term.over; });
    // On its limit to the last bit a term may read as inside.
    Decide(e, over != e.terms.end() ? &*over : Find(e, CellTerm::kProbability),
           WhoBreaks(hazards, settings, e.cell));
    return;
  }
  e.can_bear = true;
  e.verdict = "Safe; nearest hazard: " + WhereWords(*e.nearest);
}

double AgeOf(const ElevationMap& map, Cell cell) {
  if (map.frame_count.at(cell) == 0) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return map.age_s.empty() ? 0.0 : static_cast<double>(map.age_s.at(cell));
}

}  // namespace

CellExplanation ExplainCell(const ElevationMap& map, const HazardMaps& hazards,
                            const SladSettings& settings, Cell cell) {
  CellExplanation e;
  e.cell = cell;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  e.height_m = {nan, nan};
  e.age_s = nan;
  e.reasons = kHazardUnknown;
  if (map.height_m.empty() || hazards.reasons.empty() || !map.geometry.Contains(cell) ||
      !hazards.geometry.Contains(cell)) {
    e.verdict = "Outside the map";
    return e;
  }
  e.state = map.state.at(cell);
  e.height_m = {static_cast<double>(map.Measured().at(cell)),
                3 * std::sqrt(static_cast<double>(map.variance_m2.at(cell)))};
  e.frames = map.frame_count.at(cell);
  e.age_s = AgeOf(map, cell);
  e.flags = hazards.flags.empty() ? std::uint8_t{0} : hazards.flags.at(cell);
  e.reasons = hazards.reasons.at(cell);
  LandingSite site;
  TakeFigures(hazards, settings, cell, site);
  e.terms = TermsOf(site, settings);
  if (e.reasons != kHazardNone) {
    DecideHazard(e);
  } else {
    DecideRoom(hazards, settings, e);
  }
  return e;
}

}  // namespace palace
