#include "engine/tools/log_rerun.h"

#include <cstdio>
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/journal/replay_source.h"
#include "engine/runtime/engine.h"
#include "engine/runtime/settings_io.h"
#include "engine/survey/rerun_files.h"
#include "engine/wire/channels.h"

namespace palace {
namespace {

struct RerunOptions {
  std::string log, out, settings_file, maps, channels_file;
  std::vector<std::string> set;
};

/// What was recorded at the start, with the file and the single values over it.
Result<Settings> WantedSettings(const RerunOptions& options, const Settings& recorded) {
  Settings settings = recorded;
  if (!options.settings_file.empty()) {
    Result<Settings> loaded = LoadSettingsFile(options.settings_file, settings);
    if (!loaded) {
      return loaded;
    }
    settings = *loaded;
  }
  for (const std::string& assignment : options.set) {
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

/// What the ranges, the fused map and the tracker are made with comes from `wanted` from the start;
/// limits, lander and choice stay as recorded, and `wanted` is judged beside them.
Settings WithPerceptionOf(const Settings& wanted, const Settings& recorded) {
  Settings settings = recorded;
  settings.stereo = wanted.stereo;
  settings.tracking = wanted.tracking;
  settings.slad.mode = wanted.slad.mode;
  settings.slad.grid = wanted.slad.grid;
  settings.slad.fusion = wanted.slad.fusion;
  return settings;
}

/// The record's sample of that very time; null where the log holds none.
const FlightRecordSample* SampleAt(const FlightRecord& record, Timestamp time, std::size_t& next) {
  while (next < record.samples.size() && record.samples[next].time < time) {
    ++next;
  }
  const bool found = next < record.samples.size() && record.samples[next].time == time;
  return found ? &record.samples[next] : nullptr;
}

void Print(const RerunOptions& options, const RerunFiles::Counts& counts, bool moved) {
  const auto number = [](std::uint64_t n) { return static_cast<unsigned long long>(n); };
  std::printf("%s: %llu frames, %llu maps, %llu without a site, %llu written\n",
              options.out.c_str(), number(counts.frames), number(counts.maps),
              number(counts.maps_without_site), number(counts.maps_written));
  if (counts.recorded > 0) {
    std::printf("%llu of %llu recorded decisions are the same, to the bit%s\n",
                number(counts.equal), number(counts.recorded),
                moved ? " (limits were changed)" : "");
  } else {
    std::printf("the log holds no decisions to compare with\n");
  }
}

Result<int> Rerun(const RerunOptions& options) {
  const Result<MapTimes> maps =
      options.maps.empty() ? Result<MapTimes>(MapTimes{}) : ParseMapTimes(options.maps);
  if (!maps) {
    return maps.error();
  }
  ReplayOptions replay;
  replay.speed = 0;
  if (!options.channels_file.empty()) {
    const Result<ChannelNames> channels = LoadChannels(options.channels_file);
    if (!channels) {
      return channels.error();
    }
    replay.channels = *channels;
  }
  Result<std::unique_ptr<ReplaySource>> opened = ReplaySource::Open(options.log, replay);
  if (!opened) {
    return opened.error();
  }
  const std::shared_ptr<ReplaySource> source = std::move(*opened);
  const FlightRecord& record = *source->recorded();
  const Result<Settings> wanted = WantedSettings(options, record.settings_at_start);
  if (!wanted) {
    return wanted.error();
  }
  Result<RerunFiles> files = RerunFiles::Open(options.out, *maps);
  if (!files) {
    return files.error();
  }
  EngineParts parts;
  parts.source = source;
  parts.record = source->recorded();
  parts.settings = WithPerceptionOf(*wanted, record.settings_at_start);
  const bool moved = !(*wanted == record.settings_at_start);
  if (moved) {
    parts.redecide_with = *wanted;
  }
  Engine engine(std::move(parts), /*threaded=*/false);
  std::size_t next = 0;
  while (engine.Step()) {
    const std::shared_ptr<const EngineSnapshot> snapshot = engine.Latest();
    const FlightRecordSample* recorded = SampleAt(record, snapshot->time, next);
    if (const Status done = files->Add(*snapshot, recorded); !done) {
      return done.error();
    }
  }
  if (!engine.error().empty()) {
    return UnavailableError(engine.error());
  }
  if (const Status done = files->Finish(); !done) {
    return done.error();
  }
  Print(options, files->counts(), moved);
  return source->Status().damage.empty() ? 0 : 3;
}

}  // namespace

void AddLogRerun(CLI::App& log, int& exit_code) {
  CLI::App* verb = log.add_subcommand(
      "rerun", "Through the pipeline again: every map's sites and every decision as CSV");
  const auto options = std::make_shared<RerunOptions>();
  verb->add_option("LOG", options->log, "An LCM event log")->required();
  verb->add_option("--out", options->out, "Folder for sites.csv, decisions.csv and maps")
      ->required();
  verb->add_option("--settings", options->settings_file,
                   "Settings (TOML) over the recorded ones: limits are judged beside them, what "
                   "maps are made with holds from the start");
  verb->add_option("--set", options->set, "One setting, e.g. slad.max_slope_deg=8; repeatable")
      ->take_all();
  verb->add_option("--maps", options->maps,
                   "Fused maps as GeoTIFF: last, or \"every N s\" of the flight's time");
  verb->add_option("--channels", options->channels_file, "Channel names (TOML)");
  verb->callback([options, &exit_code] {
    const Result<int> done = Rerun(*options);
    if (!done) {
      std::cerr << "palacectl log rerun: " << done.error().message << '\n';
    }
    exit_code = done ? *done : done.error().code == ErrorCode::kUsage ? 2 : 1;
  });
}

}  // namespace palace
