// What palacectl log does: describe, cut and repair a log.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/journal/log_index.h"
#include "engine/model/mission/mission_status.h"
#include "engine/wire/channels.h"

namespace palace {

struct ChannelSummary {
  std::string name;
  std::uint64_t events = 0;
  std::uint64_t bytes = 0;
  double rate_hz = 0;  ///< 0 for a single event
};

struct LogDescription {
  LogReport report;
  std::vector<ChannelSummary> channels;  ///< by name
  std::uint64_t bundles = 0;
  std::vector<LogPart> parts;
  Timestamp first;
  Timestamp last;
  double duration_s = 0;
  std::vector<Event> faults;  ///< of a simulated flight: injected, and ended
};

/// `verify`: scans every byte and checks sums; else trusts a fitting sidecar.
Result<LogDescription> DescribeLog(const std::filesystem::path& log, bool verify,
                                   const ChannelNames& channels = {});

struct CopiedLog {
  std::uint64_t events = 0;
  std::uint64_t left_out = 0;  ///< wanted, but the bytes differ from their checksum
};

/// Writes every readable event to a new log with a fresh sidecar, which has its name only when it
/// is whole. Errors: `out` exists, cannot be written, or would hold nothing.
Result<CopiedLog> RepairLog(const std::filesystem::path& log, const std::filesystem::path& out);

/// Likewise the events from `from_s` to `to_s`, seconds after the first event: whole passes of the
/// engine where times are those of bundles. An error as well where the log has none of that time.
Result<CopiedLog> CutLog(const std::filesystem::path& log, const std::filesystem::path& out,
                         double from_s, double to_s);

}  // namespace palace
