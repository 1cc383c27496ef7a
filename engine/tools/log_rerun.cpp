#include "engine/tools/log_rerun.h"

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/journal/replay_source.h"
#include "engine/runtime/engine.h"
#include "engine/runtime/wanted_settings.h"
#include "engine/survey/rerun_files.h"
#include "engine/wire/channels.h"

namespace palace {
namespace {

constexpr std::size_t kReasonsTold = 4;

struct RerunOptions {
  std::string log, out, maps, channels_file;
  int part = 0;
  SettingsRequest settings;
};

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
  std::printf("%s: %llu frames, %llu maps", options.out.c_str(), number(counts.frames),
              number(counts.maps));
  if (counts.judged_again > 0) {
    std::printf(", %llu judged again under other settings", number(counts.judged_again));
  }
  std::printf(", %llu without a site, %llu written\n", number(counts.without_site),
              number(counts.written));
  if (counts.recorded > 0) {
    std::printf("%llu of %llu recorded decisions are the same, to the bit%s\n",
                number(counts.equal), number(counts.recorded),
                moved ? " (settings were changed)" : "");
  } else {
    std::printf("the log holds no decisions to compare with\n");
  }
}

/// Of a log from which no map came; the most frequent reason first.
void PrintWhyNothing(const RerunFiles::Counts& counts) {
  std::vector<std::pair<std::uint64_t, std::string>> reasons;
  for (const auto& [why, frames] : counts.why_no_map) {
    reasons.emplace_back(frames, why);
  }
  std::stable_sort(reasons.begin(), reasons.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::cerr << "palacectl log rerun: no frame gave a map, so nothing was decided";
  for (std::size_t i = 0; i < std::min(reasons.size(), kReasonsTold); ++i) {
    std::cerr << (i == 0 ? ": " : "; ") << reasons[i].first << " of " << counts.frames
              << " frames: " << reasons[i].second;
  }
  std::cerr << '\n';
}

Result<int> Rerun(const RerunOptions& options) {
  const Result<MapTimes> maps =
      options.maps.empty() ? Result<MapTimes>(MapTimes{}) : ParseMapTimes(options.maps);
  if (!maps) {
    return maps.error();
  }
  ReplayOptions replay;
  replay.speed = 0;
  replay.part = options.part;
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
  const Result<ReplaySettings> settings = SettingsOfReplay(options.settings, record);
  if (!settings) {
    return settings.error();
  }
  std::error_code none;
  const bool replaces =
      std::filesystem::exists(std::filesystem::path(options.out) / "decisions.csv", none);
  Result<RerunFiles> files = RerunFiles::Open(options.out, *maps);
  if (!files) {
    return files.error();
  }
  EngineParts parts;
  parts.source = source;
  parts.record = source->recorded();
  parts.settings = settings->settings;
  parts.redecide_with = settings->redecide_with;
  parts.held_settings = settings->held;
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
  if (replaces) {
    std::cerr << "palacectl: warning: an earlier rerun in " << options.out << " was replaced\n";
  }
  Print(options, files->counts(), settings->redecide_with.has_value());
  const std::string damage = source->Status().damage;
  if (!damage.empty()) {
    std::cerr << "palacectl log rerun: " << options.log << ": " << damage << '\n';
  }
  if (files->counts().maps == 0) {
    PrintWhyNothing(files->counts());
    return 1;
  }
  return damage.empty() ? 0 : 3;
}

}  // namespace

void AddLogRerun(CLI::App& log, int& exit_code) {
  CLI::App* verb = log.add_subcommand(
      "rerun", "Through the pipeline again: every map's sites and every decision as CSV");
  const auto options = std::make_shared<RerunOptions>();
  verb->add_option("LOG", options->log, "An LCM event log")->required();
  verb->add_option("--out", options->out, "Folder for sites.csv, decisions.csv and maps")
      ->required();
  verb->add_option("--settings", options->settings.file,
                   "Settings (TOML) over the recorded ones: limits are judged beside them, what "
                   "maps are made with holds from the start");
  verb->add_option("--set", options->settings.set,
                   "One setting, e.g. slad.max_slope_deg=8; repeatable")
      ->take_all();
  verb->add_option("--maps", options->maps,
                   "Fused maps as GeoTIFF: last, or \"every N s\" of the flight's time; metres, "
                   "slope in radians, NaN unknown");
  verb->add_option("--part", options->part,
                   "Of a log in which the vehicle restarted, the part; else the longest")
      ->check(CLI::PositiveNumber);
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
