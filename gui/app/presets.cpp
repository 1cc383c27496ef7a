#include "gui/app/presets.h"

#include <system_error>

#include "engine/core/files.h"
#include "engine/runtime/settings_io.h"

namespace palace {
namespace fs = std::filesystem;

fs::path FirstPresetPath() { return ConfigFolder() / "limits.toml"; }

PresetLook LookAt(const fs::path& path, const Settings& now) {
  PresetLook look;
  look.path = path.string();
  std::error_code ignored;
  look.exists = fs::exists(path, ignored);
  const Result<Settings> loaded = LoadSettingsFile(path, now);
  if (!loaded) {
    look.problem = loaded.error().message;
    return look;
  }
  for (const SettingInfo& info : SettingTable()) {
    const double before = GetSetting(now, info.name), after = GetSetting(*loaded, info.name);
    if (before != after) {
      look.differences.push_back({info.name, before, after});
    }
  }
  return look;
}

Status SavePresetFile(const fs::path& path, const Settings& settings, bool replace) {
  std::error_code ignored;
  if (!replace && fs::exists(path, ignored)) {
    return InvalidError(path.string() + " is there already; replace it, or give another name");
  }
  if (path.has_parent_path()) {
    if (const Status made = MakeFolder(path.parent_path()); !made) {
      return made;
    }
  }
  return SaveSettingsFile(path, settings);
}

}  // namespace palace
