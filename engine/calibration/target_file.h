// TARGET.toml: the description of a calibration target that a person edits.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "engine/core/result.h"
#include "engine/model/calibration_target.h"

namespace palace {

/// One table:
///   [target]  kind = "dots" | "chessboard", columns, rows (dots or inner corners), pitch_m,
///             dots: dot_diameter_m, and where the board has larger dots that tell which way round
///             it is held: marks = [[column, row], ...], mark_diameter_m
/// Unknown and missing keys and impossible values are errors that name file, line, key, value,
/// limit and remedy. `name` is the file name for errors.
Result<CalibrationTarget> ParseTargetText(std::string_view text, const std::string& name);
Result<CalibrationTarget> LoadTargetFile(const std::filesystem::path& path);
/// The same format.
std::string TargetToText(const CalibrationTarget& target);

}  // namespace palace
