// LogIndex: every event of a log by number, from its sidecar or by a scan, and where bundles lie.
#pragma once

#include <cstdint>
#include <filesystem>
#include <stop_token>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/journal/log_reader.h"
#include "engine/wire/channels.h"

namespace palace {

using LogIndex = LogScan;

/// From the sidecar when it fits the log, with a scan of what was written after it; else by a scan
/// of the whole log. An Error when not one event is readable.
Result<LogIndex> BuildIndex(const LogFile& file, std::stop_token stop = {});
/// Scans the whole log and checks every event against the sidecar where there is one.
Result<LogIndex> VerifyLog(const LogFile& file, std::stop_token stop = {});

std::filesystem::path SidecarPath(const std::filesystem::path& log);

/// One bundle of a log: events [first, end) rebuild it; the event before `end` closes it.
struct BundleMark {
  std::size_t first = 0;
  std::size_t end = 0;
  std::uint64_t offset = 0;  ///< of the first event
  Timestamp time;            ///< of the closing event
};

/// Bundles end at CAMERA_RIG where it closes bundles (our logs), else at the right picture.
std::vector<BundleMark> FindBundles(const LogFile& file, const LogIndex& index,
                                    const ChannelNames& channels);

/// Bundles [first, end) between which the clock of the vehicle never went back.
struct LogPart {
  std::size_t first = 0;
  std::size_t end = 0;
  double duration_s = 0;
};

/// In order; one, but where the vehicle restarted or its clock was put back by more than a second.
std::vector<LogPart> FindParts(const std::vector<BundleMark>& bundles);

}  // namespace palace
