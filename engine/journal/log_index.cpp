#include "engine/journal/log_index.h"

#include <algorithm>
#include <unordered_map>

#include "engine/journal/big_endian.h"
#include "engine/journal/checksum.h"
#include "engine/journal/sidecar.h"
#include "engine/wire/sensor_messages.h"

namespace palace {
namespace {

constexpr std::size_t kSpotChecks = 64;

bool HeaderMatches(const LogFile& file, const LogEntry& entry) {
  std::uint8_t head[kLogHeaderBytes];
  if (file.ReadAt(entry.offset, head, sizeof head) != sizeof head ||
      GetBig<std::uint32_t>(head) != kLogSync) {
    return false;
  }
  const std::uint64_t length = kLogHeaderBytes + GetBig<std::uint32_t>(head + 20) +
                               std::uint64_t{GetBig<std::uint32_t>(head + 24)};
  return GetBig<std::int64_t>(head + 4) == entry.number &&
         GetBig<std::int64_t>(head + 12) == entry.time.us && length == entry.length;
}

/// Evenly spread events, and the last, lie where the sidecar says.
bool Fits(const LogFile& file, const std::vector<LogEntry>& entries) {
  if (entries.empty() || entries.front().offset != 0) {
    return false;
  }
  const std::size_t step = std::max<std::size_t>(1, entries.size() / kSpotChecks);
  for (std::size_t i = 0; i < entries.size(); i += step) {
    if (!HeaderMatches(file, entries[i])) {
      return false;
    }
  }
  return HeaderMatches(file, entries.back());
}

Error NothingReadable(const LogFile& file) {
  const std::string path = file.path().string();
  return file.size() == 0
             ? InvalidError(path + ": is empty; nothing was recorded, choose another log")
             : InvalidError(path + ": holds no readable event in " + std::to_string(file.size()) +
                            " bytes; it is no LCM event log, choose another file");
}

/// The event that the sidecar speaks of, but for damage.
bool IsSame(const LogEntry& known, const LogEntry& found) {
  return known.number == found.number && known.time == found.time && known.length == found.length;
}

/// Gives scanned events the checksums the sidecar knows. Numbers tie the two together, so inserted
/// or removed bytes do not matter. A sidecar that agrees with less than half of what both number is
/// of another log, and gives nothing.
void TakeChecksums(const Sidecar& sidecar, LogIndex& index) {
  std::unordered_map<std::int64_t, const LogEntry*> known;
  for (const LogEntry& entry : sidecar.entries) {
    known[entry.number] = &entry;
  }
  std::size_t both = 0, same = 0;
  for (const LogEntry& entry : index.entries) {
    const auto found = known.find(entry.number);
    both += found != known.end() ? 1 : 0;
    same += found != known.end() && IsSame(*found->second, entry) ? 1 : 0;
  }
  if (2 * same < both) {
    index.report.sidecar_problem = "the sidecar is of another log";
    return;
  }
  std::size_t matched = 0;
  for (LogEntry& entry : index.entries) {
    const auto found = known.find(entry.number);
    if (found != known.end()) {
      entry.crc = found->second->crc;
      entry.has_crc = true;
      known.erase(found);
      ++matched;
    }
  }
  index.report.missing_events = sidecar.entries.size() - matched;
}

/// Counts what no checksum is known of, and says why. `path`: of the sidecar.
void TellUnchecked(const std::filesystem::path& path, const Result<Sidecar>& sidecar,
                   LogIndex& index) {
  LogReport& report = index.report;
  for (const LogEntry& entry : index.entries) {
    report.unchecked += entry.has_crc ? 0 : 1;
  }
  if (report.unchecked == 0 || !report.sidecar_problem.empty()) {
    return;
  }
  if (!sidecar) {
    std::error_code error;
    report.sidecar_problem = std::filesystem::exists(path, error)
                                 ? "the sidecar is none, or damaged from its start"
                                 : "there is no sidecar";
  } else if (sidecar->unread_bytes > 0) {
    report.sidecar_problem = "the sidecar is cut or damaged after " +
                             std::to_string(sidecar->entries.size()) + " events";
  } else {
    report.sidecar_problem =
        "the sidecar ends after " + std::to_string(sidecar->entries.size()) + " events";
  }
}

/// Reads every event that a checksum is known of. Where hardly one of many fits, they are the
/// checksums of another log, and nothing was checked.
void CompareChecksums(const LogFile& file, std::stop_token stop, LogIndex& index) {
  constexpr std::uint64_t kMany = 20;
  LogReport& report = index.report;
  std::uint64_t compared = 0;
  std::vector<std::uint8_t> bytes;
  for (const LogEntry& entry : index.entries) {
    if (stop.stop_requested()) {
      report.cancelled = true;
      return;
    }
    if (!entry.has_crc) {
      continue;
    }
    bytes.resize(entry.length);
    const std::size_t got = file.ReadAt(entry.offset, bytes.data(), bytes.size());
    ++compared;
    report.checksum_errors +=
        got != bytes.size() || Crc32c(0, bytes.data(), got) != entry.crc ? 1 : 0;
  }
  if (compared >= kMany && 10 * report.checksum_errors > 9 * compared) {
    report.checksum_errors = report.missing_events = 0;
    report.sidecar_problem = "the sidecar is of another log";
    for (LogEntry& entry : index.entries) {
      entry.has_crc = false;
    }
  }
}

}  // namespace

std::filesystem::path SidecarPath(const std::filesystem::path& log) {
  return log.string() + ".idx";
}

Result<LogIndex> BuildIndex(const LogFile& file, std::stop_token stop) {
  Result<Sidecar> sidecar = ReadSidecar(SidecarPath(file.path()));
  LogIndex index;
  if (sidecar) {
    std::vector<LogEntry> entries = sidecar->entries;
    while (!entries.empty() && entries.back().offset + entries.back().length > file.size()) {
      entries.pop_back();
    }
    if (Fits(file, entries)) {
      index.report.missing_events = sidecar->entries.size() - entries.size();
      index.channels = sidecar->channels;
      index.entries = std::move(entries);
      // What was written after the sidecar's last record: a program that died in between.
      ScanLog(file, index.entries.back().offset + index.entries.back().length, index, stop);
      TellUnchecked(SidecarPath(file.path()), sidecar, index);
      return index;
    }
  }
  ScanLog(file, 0, index, stop);
  if (index.entries.empty()) {
    return NothingReadable(file);
  }
  if (sidecar) {
    TakeChecksums(*sidecar, index);
  }
  TellUnchecked(SidecarPath(file.path()), sidecar, index);
  return index;
}

Result<LogIndex> VerifyLog(const LogFile& file, std::stop_token stop) {
  LogIndex index;
  ScanLog(file, 0, index, stop);
  if (index.entries.empty()) {
    return NothingReadable(file);
  }
  const Result<Sidecar> sidecar = ReadSidecar(SidecarPath(file.path()));
  if (sidecar) {
    TakeChecksums(*sidecar, index);
  }
  CompareChecksums(file, stop, index);
  TellUnchecked(SidecarPath(file.path()), sidecar, index);
  return index;
}

Result<WireMessage> ReadEvent(const LogFile& file, const LogEntry& entry,
                              const std::vector<std::string>& channels) {
  const auto broken = [&](const char* what) {
    return InvalidError(file.path().string() + ": the event at byte " +
                        std::to_string(entry.offset) + " " + what + "; it is skipped");
  };
  const std::string& channel = channels.at(entry.channel);
  const std::size_t head = kLogHeaderBytes + channel.size();
  if (entry.length < head || entry.length > head + kLogLargestData ||
      entry.offset + entry.length > file.size()) {
    return broken("has an impossible length");
  }
  std::vector<std::uint8_t> bytes(entry.length);
  if (file.ReadAt(entry.offset, bytes.data(), bytes.size()) != bytes.size()) {
    return broken("cannot be read");
  }
  if (entry.has_crc && Crc32c(0, bytes.data(), bytes.size()) != entry.crc) {
    return broken("differs from its checksum");
  }
  if (GetBig<std::uint32_t>(bytes.data()) != kLogSync ||
      GetBig<std::uint32_t>(bytes.data() + 20) != channel.size() ||
      GetBig<std::uint32_t>(bytes.data() + 24) != entry.length - head ||
      !std::equal(channel.begin(), channel.end(), bytes.begin() + kLogHeaderBytes,
                  [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; })) {
    return broken("has a damaged header");
  }
  bytes.erase(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(head));
  return WireMessage{channel, entry.time, std::move(bytes)};
}

std::vector<BundleMark> FindBundles(const LogFile& file, const LogIndex& index,
                                    const ChannelNames& channels) {
  const auto id_of = [&](const std::string& name) {
    return static_cast<std::size_t>(std::find(index.channels.begin(), index.channels.end(), name) -
                                    index.channels.begin());
  };
  const std::size_t rig = id_of(channels.camera_rig);
  bool any_rig = false;
  bool closed = false;
  for (std::size_t i = 0; i < index.entries.size() && !closed; ++i) {
    if (index.entries[i].channel != rig) {
      continue;
    }
    const Result<WireMessage> event = ReadEvent(file, index.entries[i], index.channels);
    const Result<RigMessage> message =
        event ? RigFromWire(*event) : Result<RigMessage>(event.error());
    any_rig = any_rig || message.ok();
    closed = message.ok() && message->bundle_end;
    if (message.ok() && !closed) {
      break;
    }
  }
  std::vector<BundleMark> bundles;
  if (!any_rig) {
    return bundles;
  }
  const std::size_t closing = closed ? rig : id_of(channels.camera_right);
  std::size_t first = 0;
  for (std::size_t i = 0; i < index.entries.size(); ++i) {
    if (index.entries[i].channel == closing) {
      bundles.push_back({first, i + 1, index.entries[first].offset, index.entries[i].time});
      first = i + 1;
    }
  }
  return bundles;
}

std::vector<LogPart> FindParts(const std::vector<BundleMark>& bundles) {
  constexpr double kBack_s = 1;
  std::vector<LogPart> parts;
  for (std::size_t i = 0; i < bundles.size(); ++i) {
    if (i == 0 || SecondsBetween(bundles[i - 1].time, bundles[i].time) < -kBack_s) {
      parts.push_back({i, i, 0});
    }
    LogPart& part = parts.back();
    part.end = i + 1;
    part.duration_s =
        std::max(part.duration_s, SecondsBetween(bundles[part.first].time, bundles[i].time));
  }
  return parts;
}

}  // namespace palace
