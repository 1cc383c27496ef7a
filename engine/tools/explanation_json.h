// The engine's answers to "why" as JSON: SI units, angles in degrees as in all files, null unknown.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "engine/core/result.h"
#include "engine/model/cell_explanation.h"

namespace palace {

/// Margin to every limit by name: value, three_sigma, limit, margin (positive inside) and the
/// words.
nlohmann::ordered_json MarginsJson(const LandingSite& site, const SladSettings& settings);
/// One cell: verdict, state, frames, age, height, flags, terms, nearest hazard.
nlohmann::ordered_json CellJson(const CellExplanation& cell);
/// "12,40": a cell of the map, row and column from 0. Refuses anything else.
Result<Cell> ParseCell(const std::string& text);

}  // namespace palace
