// Settings files: TOML a person edits, every value checked against the table of settings.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "engine/model/settings/settings.h"

namespace palace {

/// Reads `[slad] max_slope_deg = 10` and its like over `base`. Unknown sections and keys, wrong
/// types and values out of range are errors that name file, line, key, value and limit.
/// `[slad] up_vector_ned = [n, e, d]` is accepted in place of up_tilt_deg and up_azimuth_deg.
Result<Settings> LoadSettingsFile(const std::filesystem::path& path, const Settings& base);

/// The same from text; `name` stands for the file in messages.
Result<Settings> ParseSettings(std::string_view text, const std::string& name,
                               const Settings& base);

/// Rules between two values, asked once all are read: given bounds run from low to high.
Status CheckSettings(const Settings& settings, const std::string& name);

/// Applies one "slad.max_slope_deg=8" or "slad.mode=thesis", as --set gives it.
Result<Settings> ApplySettingText(const Settings& base, std::string_view assignment);

/// Settings as a command line gives them: those of `base`, under those of a file (none where
/// empty), under each "name=value" of --set in order; then the rules between two values.
Result<Settings> SettingsOfCommandLine(const Settings& base, const std::filesystem::path& file,
                                       const std::vector<std::string>& assignments);

/// A settings file with every value, its unit and range as comments. LoadSettingsFile reads it back
/// to equal settings.
std::string SettingsToToml(const Settings& settings);

/// Writes through a temporary file in the same folder, so that no half-written preset remains.
Status SaveSettingsFile(const std::filesystem::path& path, const Settings& settings);

}  // namespace palace
