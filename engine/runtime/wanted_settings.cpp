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

Result<ReplaySettings> SettingsOfReplay(const SettingsRequest& request,
                                        const FlightRecord& record) {
  const Settings& recorded = record.settings_at_start;
  if (request.file.empty() && request.set.empty()) {
    return ReplaySettings{recorded, std::nullopt};
  }
  const Result<Settings> wanted = SettingsOfCommandLine(recorded, request.file, request.set);
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
  for (const SettingInfo& info : SettingTable()) {
    if (GetSetting(replay.settings, info.name) != GetSetting(recorded, info.name)) {
      replay.held.push_back(info.name);
    }
  }
  return replay;
}

}  // namespace palace
