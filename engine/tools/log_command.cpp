#include "engine/tools/log_command.h"

#include <cstdio>
#include <iostream>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "engine/journal/export.h"
#include "engine/journal/log_tools.h"
#include "engine/tools/log_import.h"
#include "engine/tools/log_rerun.h"
#include "engine/wire/channels.h"

namespace palace {
namespace {

constexpr int kWhole = 0;
constexpr int kNothingReadable = 1;
constexpr int kDamaged = 3;
constexpr int kNotAllChecked = 4;

struct LogOptions {
  std::string log;
  std::string out;
  std::string channels_file;
  double from_s = 0;
  double to_s = 1e12;
};

int Fail(const Error& error) {
  std::cerr << "palacectl log: " << error.message << "\n";
  return error.code == ErrorCode::kUsage ? 2 : kNothingReadable;
}

Result<ChannelNames> Channels(const LogOptions& options) {
  return options.channels_file.empty() ? Result<ChannelNames>(ChannelNames())
                                       : LoadChannels(options.channels_file);
}

void PrintReport(const LogReport& r) {
  std::printf("%llu events in %llu bytes", static_cast<unsigned long long>(r.events),
              static_cast<unsigned long long>(r.file_bytes));
  const auto known = static_cast<unsigned long long>(r.events - r.unchecked);
  std::printf(known > 0 ? ", checksums of %llu in the sidecar\n" : ", no checksums\n", known);
  if (!r.sidecar_problem.empty()) {
    std::printf("  %s\n", r.sidecar_problem.c_str());
  }
  const auto line = [](const char* what, std::uint64_t count) {
    if (count > 0) {
      std::printf("  %-42s %llu\n", what, static_cast<unsigned long long>(count));
    }
  };
  line("bytes skipped as damaged", r.skipped_bytes);
  line("gaps", r.gap_count);
  line("suspect events (damage follows directly)", r.suspect);
  line("events that differ from their checksum", r.checksum_errors);
  line("events recorded but missing", r.missing_events);
  line("steps back in time", r.time_regressions);
  line("jumps in event numbers", r.number_jumps);
  for (const LogGap& gap : r.gaps) {
    std::printf("  gap at byte %llu, %llu bytes\n", static_cast<unsigned long long>(gap.offset),
                static_cast<unsigned long long>(gap.bytes));
  }
}

/// What `info` saw, which looks at headers only.
int Impression(const LogReport& report) {
  std::printf(report.damaged() ? "damaged, the rest is readable\n"
                               : "no damage seen; palacectl log verify reads every event\n");
  return report.damaged() ? kDamaged : kWhole;
}

/// "whole" only where every event was compared with its checksum, and none is missing by number.
int Verdict(const LogReport& report) {
  const bool lacks_events = report.number_jumps > 0;
  if (report.damaged()) {
    std::printf("damaged, the rest is readable\n");
  } else if (lacks_events) {
    std::printf(
        "what is here is readable, but event numbers jump: events are missing, or not in order\n");
  } else if (report.unchecked == 0) {
    std::printf("whole\n");
  } else {
    std::printf("no damage seen, but %llu of %llu events could not be checked\n",
                static_cast<unsigned long long>(report.unchecked),
                static_cast<unsigned long long>(report.events));
  }
  return report.damaged() || lacks_events ? kDamaged
         : report.unchecked == 0          ? kWhole
                                          : kNotAllChecked;
}

int Describe(const LogOptions& options, bool verify) {
  const Result<ChannelNames> channels = Channels(options);
  if (!channels) {
    return Fail(channels.error());
  }
  const Result<LogDescription> log = DescribeLog(options.log, verify, *channels);
  if (!log) {
    return Fail(log.error());
  }
  PrintReport(log->report);
  if (!verify) {
    std::printf("%.3f s, %llu bundles\n", log->duration_s,
                static_cast<unsigned long long>(log->bundles));
    if (log->parts.size() > 1) {
      std::printf("the vehicle's clock began anew; parts (--part N):");
      for (std::size_t i = 0; i < log->parts.size(); ++i) {
        std::printf("%s %zu: %.1f s", i > 0 ? "," : "", i + 1, log->parts[i].duration_s);
      }
      std::printf("\n");
    }
    for (const Event& fault : log->faults) {
      std::printf("%9.1f s  %s\n", SecondsBetween(log->first, fault.time), fault.text.c_str());
    }
    std::printf("%-24s %10s %14s %9s\n", "channel", "events", "bytes", "Hz");
    for (const ChannelSummary& row : log->channels) {
      std::printf("%-24s %10llu %14llu %9.2f\n", row.name.c_str(),
                  static_cast<unsigned long long>(row.events),
                  static_cast<unsigned long long>(row.bytes), row.rate_hz);
    }
  }
  return verify ? Verdict(log->report) : Impression(log->report);
}

/// A readable but damaged log keeps its exit code whatever is made of it; so does one of which
/// something had to be left out.
int HealthOf(const std::string& log, std::uint64_t left_out) {
  if (left_out > 0) {
    std::printf(
        "%llu events are damaged or of another version, and left out; see palacectl log verify "
        "%s\n",
        static_cast<unsigned long long>(left_out), log.c_str());
    return kDamaged;
  }
  const Result<LogDescription> description = DescribeLog(log, false);
  return description && description->report.damaged() ? kDamaged : kWhole;
}

int Export(const LogOptions& options) {
  const Result<ChannelNames> channels = Channels(options);
  if (!channels) {
    return Fail(channels.error());
  }
  std::error_code none;
  const bool replaces =
      std::filesystem::exists(std::filesystem::path(options.out) / "status.csv", none);
  const Result<ExportedLog> exported = ExportCsv(options.log, options.out, *channels);
  if (!exported) {
    return Fail(exported.error());
  }
  if (replaces) {
    std::cerr << "palacectl: warning: an earlier export in " << options.out << " was replaced\n";
  }
  bool decided = false;
  for (const ExportedTable& table : exported->tables) {
    std::printf("%s: %llu rows\n", table.file.c_str(), static_cast<unsigned long long>(table.rows));
    const std::string name = table.file.filename().string();
    decided = decided || (table.rows > 0 && (name == "sites.csv" || name == "status.csv"));
  }
  if (!decided) {
    std::printf(
        "No station recorded this log, so it holds no maps, sites or decisions. To decide it now: "
        "palacectl log rerun %s --out DIR\n",
        options.log.c_str());
  }
  return HealthOf(options.log, exported->left_out);
}

int Finish(const LogOptions& options, const Result<CopiedLog>& copied) {
  if (!copied) {
    return Fail(copied.error());
  }
  std::printf("%s: %llu events\n", options.out.c_str(),
              static_cast<unsigned long long>(copied->events));
  return HealthOf(options.log, copied->left_out);
}

}  // namespace

void AddLogCommand(CLI::App& app, int& exit_code) {
  CLI::App* log =
      app.add_subcommand("log", "Look into, check, cut, repair, export, rerun and import a log");
  log->require_subcommand(1);
  const auto options = std::make_shared<LogOptions>();
  const auto verb = [&](const char* name, const char* help) {
    CLI::App* command = log->add_subcommand(name, help);
    command->add_option("LOG", options->log, "An LCM event log")->required();
    return command;
  };
  const auto with_out = [&](CLI::App* command, const char* help) {
    command->add_option("--out", options->out, help)->required();
  };

  CLI::App* info = verb("info", "What it holds: channels, rates, duration, damage");
  info->add_option("--channels", options->channels_file, "Channel names (TOML)");
  info->callback([options, &exit_code] { exit_code = Describe(*options, false); });

  CLI::App* verify =
      verb("verify",
           "Compare every event with its checksum. Exit 0 whole, 3 damaged or lacking events but "
           "read, 4 readable but not all could be checked, 1 nothing readable");
  verify->callback([options, &exit_code] { exit_code = Describe(*options, true); });

  CLI::App* export_verb = verb("export", "Estimates, truth, decisions, sites, settings as CSV");
  with_out(export_verb, "Folder for the tables");
  export_verb->add_option("--channels", options->channels_file, "Channel names (TOML)");
  export_verb->callback([options, &exit_code] { exit_code = Export(*options); });

  AddLogRerun(*log, exit_code);
  AddLogImport(*log, exit_code);

  CLI::App* repair = verb("repair", "Write every readable event to a new log");
  with_out(repair, "The new log");
  repair->callback([options, &exit_code] {
    exit_code = Finish(*options, RepairLog(options->log, options->out));
  });

  CLI::App* cut = verb("cut", "Write a stretch of time to a new log");
  with_out(cut, "The new log");
  cut->add_option("--from-s", options->from_s, "Start, seconds after the first event");
  cut->add_option("--to-s", options->to_s, "End, seconds after the first event");
  cut->callback([options, &exit_code] {
    exit_code =
        Finish(*options, CutLog(options->log, options->out, options->from_s, options->to_s));
  });
}

}  // namespace palace
