#include "engine/model/mission/limit_row.h"

#include <algorithm>
#include <cstdio>

#include "engine/core/check.h"
#include "engine/core/rounding.h"
#include "engine/core/units.h"
#include "engine/model/cell_explanation.h"
#include "engine/model/site_standing.h"
#include "engine/model/size_words.h"

namespace palace {
namespace {

constexpr double kFull = 10;  // of a limit that any value is beyond

/// A term of the site's verdict as a row, without its numbers.
LimitRow RowFor(CellTerm term) {
  switch (term) {
    case CellTerm::kSlope:
      return {.id = LimitId::kSlope, .label = "Slope", .unit = "°", .shown_per_unit = kDegPerRad};
    case CellTerm::kRoughness:
      return {.id = LimitId::kRoughness, .label = "Roughness", .unit = "cm", .shown_per_unit = 100};
    case CellTerm::kStep:
      return {.id = LimitId::kStep, .label = "Largest step", .unit = "cm", .shown_per_unit = 100};
    case CellTerm::kProbability:
      return {
          .id = LimitId::kProbability, .label = "Safe as seen", .is_least = true, .decimals = 3};
    case CellTerm::kHazardDistance:
      return {.id = LimitId::kClearRadius, .label = "Clear radius", .is_least = true, .unit = "m"};
  }
  PALACE_CHECK(false);
}

std::string NumberOf(double value, const LimitRow& row) {
  if (!std::isfinite(value)) {
    return "––";
  }
  char text[48];
  std::snprintf(text, sizeof text, "%.*f", row.decimals, value * row.shown_per_unit);
  return text;
}

std::string Words(double value, const LimitRow& row) {
  const std::string unit = std::isfinite(value) ? row.unit : "";
  return NumberOf(value, row) + (unit.empty() || unit == "°" ? unit : " " + unit);
}

}  // namespace

const char* EnforcedByWord(EnforcedBy by) {
  switch (by) {
    case EnforcedBy::kNobody:
      return "for information";
    case EnforcedBy::kGuard:
      return "guard";
    case EnforcedBy::kHold:
      return "hold";
    case EnforcedBy::kAlarm:
      return "alarm";
    case EnforcedBy::kVehicle:
      return "vehicle";
  }
  PALACE_CHECK(false);
}

LimitRow Judged(LimitRow row) {
  const bool beyond = row.is_least ? row.value < row.limit : row.value > row.limit;
  row.over = row.enforced_by != EnforcedBy::kNobody && beyond;
  return row;
}

double ShareUsed(const LimitRow& row) {
  if (!std::isfinite(row.value)) {
    return NAN;
  }
  if (row.id == LimitId::kProbability) {
    return (1 - row.value) / std::max(1 - row.limit, 1e-9);
  }
  const double used = row.is_least ? row.limit : row.value;
  const double whole = row.is_least ? row.value : row.limit;
  return whole > 0 ? std::min(used / whole, kFull) : used > 0 ? kFull : 0;
}

std::string ValueWords(const LimitRow& row) {
  if (const double below = KnownBelow(row); !std::isnan(below)) {
    return "under " + Words(below, row);
  }
  const double value = row.over ? ShownBeyond(row.value * row.shown_per_unit,
                                              row.limit * row.shown_per_unit, row.decimals) /
                                      row.shown_per_unit
                                : row.value;
  return std::isfinite(value) && row.three_sigma > 0
             ? NumberOf(value, row) + " ± " + Words(row.three_sigma, row)
             : Words(value, row);
}
std::string LimitWords(const LimitRow& row) { return Words(row.limit, row); }

const LimitRow* FindLimit(const std::vector<LimitRow>& rows, LimitId id) {
  const auto row =
      std::find_if(rows.begin(), rows.end(), [&](const LimitRow& r) { return r.id == id; });
  return row == rows.end() ? nullptr : &*row;
}

std::vector<LimitRow> SiteLimits(const LandingSite& site, const SladSettings& settings) {
  std::vector<LimitRow> rows;
  for (const ExplainedTerm& term : TermsOf(site, settings)) {
    LimitRow row = RowFor(term.term);
    row.value = term.figure.value;
    row.three_sigma = term.figure.three_sigma > 0 ? term.figure.three_sigma : NAN;
    row.limit = term.limit;
    row.enforced_by = EnforcedBy::kGuard;
    row.over = term.over && std::isfinite(row.value);
    rows.push_back(row);
  }
  // In modern mode a cell that was not measured is a hazard, so that the clear radius holds none.
  const bool modern = settings.mode == SladMode::kModern;
  rows.push_back(Judged({.id = LimitId::kUnknownCells,
                         .label = "Unknown cells",
                         .value = static_cast<double>(site.unknown_cells),
                         .limit = 0,
                         .decimals = 0,
                         .enforced_by = modern ? EnforcedBy::kGuard : EnforcedBy::kNobody}));
  rows.push_back(Judged({.id = LimitId::kApproach,
                         .label = "Approach blocked",
                         .value = site.corridor_clear ? 0.0 : 1.0,
                         .limit = 0,
                         .decimals = 0,
                         .enforced_by = EnforcedBy::kGuard}));
  // Beyond it the site is provisional; what is enforced then is its confirmation (G8), not this.
  rows.push_back(Judged({.id = LimitId::kHeightNoise,
                         .label = "Height noise, 3σ",
                         .value = site.height_m.three_sigma,
                         .limit = settings.limits.max_deviation_m,
                         .unit = "cm",
                         .shown_per_unit = 100}));
  // Where nobody asked for it (surveys) there is no such row. Less is enough where the way down
  // shows the rest.
  if (!std::isnan(site.air_seen_m)) {
    const bool on_way = site.air_seen_m < kLeastAirSeen_m && IsAirShown(site);
    rows.push_back(Judged({.id = LimitId::kAirSeen,
                           .label = "Air over it seen",
                           .value = site.air_seen_m,
                           .limit = kLeastAirSeen_m,
                           .is_least = true,
                           .unit = "m",
                           .enforced_by = on_way ? EnforcedBy::kNobody : EnforcedBy::kGuard}));
  }
  return rows;
}

}  // namespace palace
