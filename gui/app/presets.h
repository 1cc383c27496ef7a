// Presets on disk, for the choice of a preset in Tune.
#pragma once

#include <filesystem>

#include "engine/core/result.h"
#include "engine/model/settings/settings.h"
#include "gui/panels/tune/preset_panel.h"

namespace palace {

/// Where a first preset is offered: limits.toml in ConfigFolder, or, without one, in the current
/// folder.
std::filesystem::path FirstPresetPath();

/// What is at `path`, against the limits as they are now.
PresetLook LookAt(const std::filesystem::path& path, const Settings& now);

/// Writes the limits, making the folder. An existing file only with `replace`.
Status SavePresetFile(const std::filesystem::path& path, const Settings& settings, bool replace);

}  // namespace palace
