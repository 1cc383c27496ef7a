// Options that the experiments on rendered fields share.
#pragma once

#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/model/settings/settings.h"

namespace CLI {
class App;
}

namespace palace {

struct FieldOptions {
  double field_of_view_deg = 60;
  std::vector<std::string> set{};
};

/// --fov-deg and --set.
void AddFieldOptions(CLI::App& app, FieldOptions& options);
/// The standard ones with --set applied.
Result<Settings> SettingsOf(const FieldOptions& options);

}  // namespace palace
