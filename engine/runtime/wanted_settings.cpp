#include "engine/runtime/wanted_settings.h"

#include "engine/runtime/settings_io.h"

namespace palace {
namespace {

Settings WithPerceptionOf(const Settings& wanted, const Settings& recorded) {
  Settings settings = recorded;
  settings.stereo = wanted.stereo;
  settings.tracking = wanted.tracking;
  settings.slad.mode = wanted.slad.mode;
  settings.slad.grid = wanted.slad.grid;
  settings.slad.fusion = wanted.slad.fusion;
  return settings;
}

}  // namespace

Result<Settings> WantedSettings(const SettingsRequest& request, const Settings& base) {
  Settings settings = base;
  if (!request.file.empty()) {
    Result<Settings> loaded = LoadSettingsFile(request.file, settings);
    if (!loaded) {
      return loaded;
    }
    settings = *loaded;
  }
  for (const std::string& assignment : request.set) {
    Result<Settings> changed = ApplySettingText(settings, assignment);
    if (!changed) {
      return UsageError("--set " + assignment + ": " + changed.error().message);
    }
    settings = *changed;
  }
  if (const Status good = CheckSettings(settings, "--set"); !good) {
    return UsageError(good.error().message);
  }
  return settings;
}

Result<ReplaySettings> SettingsOfReplay(const SettingsRequest& request,
                                        const FlightRecord& record) {
  const Settings& recorded = record.settings_at_start;
  const Result<Settings> wanted = WantedSettings(request, recorded);
  if (!wanted) {
    return wanted.error();
  }
  if (!record.has_settings) {
    return ReplaySettings{*wanted, std::nullopt};
  }
  ReplaySettings replay{WithPerceptionOf(*wanted, recorded), std::nullopt};
  if (!(*wanted == recorded)) {
    replay.redecide_with = *wanted;
  }
  return replay;
}

}  // namespace palace
