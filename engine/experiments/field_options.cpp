#include "engine/experiments/field_options.h"

#include <CLI/CLI.hpp>

#include "engine/core/command_line.h"
#include "engine/runtime/settings_io.h"

namespace palace {

void AddFieldOptions(CLI::App& app, FieldOptions& options) {
  app.add_option("--fov-deg", options.field_of_view_deg, "Horizontal field of view, degrees")
      ->check(FiniteRange(20.0, 100.0))
      ->capture_default_str();
  app.add_option("--set", options.set, "One setting, e.g. slad.nav_error_m=0.3; repeatable");
}

Result<Settings> SettingsOf(const FieldOptions& options) {
  return SettingsOfCommandLine(Settings{}, {}, options.set);
}

}  // namespace palace
