#include "engine/tools/explanation_json.h"

#include <charconv>
#include <cmath>

#include "engine/core/units.h"

namespace palace {
namespace {

using Json = nlohmann::ordered_json;

Json Number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

/// Name in files, with its unit.
const char* FileName(CellTerm term) {
  switch (term) {
    case CellTerm::kSlope:
      return "slope_deg";
    case CellTerm::kRoughness:
      return "roughness_m";
    case CellTerm::kStep:
      return "step_m";
    case CellTerm::kProbability:
      return "safe_as_seen";
    case CellTerm::kHazardDistance:
      break;
  }
  return "safe_distance_m";
}

Json TermsJson(const std::vector<ExplainedTerm>& terms) {
  Json json = Json::object();
  for (const ExplainedTerm& term : terms) {
    const double unit = term.term == CellTerm::kSlope ? kDegPerRad : 1;
    const bool least =
        term.term == CellTerm::kProbability || term.term == CellTerm::kHazardDistance;
    const double inside = least ? term.figure.value - term.limit : term.limit - term.figure.value;
    const TermWords words = WordsOf(term);
    Json& row = json[FileName(term.term)];
    row = {{"value", Number(term.figure.value * unit)},
           {"three_sigma",
            term.figure.three_sigma > 0 ? Number(term.figure.three_sigma * unit) : Json(nullptr)},
           {"limit", Number(term.limit * unit)},
           {"margin", Number(inside * unit)},
           {"words",
            words.value + (words.spread.empty() ? "" : " " + words.spread) + ", " + words.limit}};
    if (term.decided) {
      row["decided"] = true;
    }
  }
  return json;
}

}  // namespace

Json MarginsJson(const LandingSite& site, const SladSettings& settings) {
  return TermsJson(TermsOf(site, settings));
}

Json CellJson(const CellExplanation& cell) {
  Json json = {{"row", cell.cell.row},
               {"col", cell.cell.col},
               {"can_bear", cell.can_bear},
               {"why", cell.verdict},
               {"state", CellStateWord(cell.state)},
               {"frames", cell.frames},
               {"age_s", Number(cell.age_s)},
               {"height_m", Number(cell.height_m.value)},
               {"height_three_sigma_m", Number(cell.height_m.three_sigma)},
               {"flags", FlagWords(cell.flags)},
               {"hazard", ReasonWords(cell.reasons)},
               {"terms", TermsJson(cell.terms)}};
  if (cell.nearest) {
    const NearestHazard& nearest = *cell.nearest;
    json["nearest_hazard"] = {
        {"row", nearest.cell ? Json(nearest.cell->row) : Json(nullptr)},
        {"col", nearest.cell ? Json(nearest.cell->col) : Json(nullptr)},
        {"distance_m", nearest.distance_m},
        {"bearing_deg", Deg(nearest.bearing_rad)},
        {"hazard", nearest.cell ? ReasonWords(nearest.reasons) : std::string("map edge")},
        {"flags", FlagWords(nearest.flags)}};
  }
  return json;
}

Result<Cell> ParseCell(const std::string& text) {
  Cell cell;
  const char* const end = text.data() + text.size();
  const auto row = std::from_chars(text.data(), end, cell.row);
  if (row.ec == std::errc() && row.ptr != end && *row.ptr == ',') {
    const auto col = std::from_chars(row.ptr + 1, end, cell.col);
    if (col.ec == std::errc() && col.ptr == end && cell.row >= 0 && cell.col >= 0) {
      return cell;
    }
  }
  return UsageError("--explain wants row,col of a cell from 0, such as 12,40; got '" + text + "'");
}

}  // namespace palace
