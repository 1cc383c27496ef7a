// LogWriter: an LCM event log with a checked sidecar index.
//
// Event, big endian: u32 sync 0xEDA1DA01, i64 number, i64 time (us), i32 channel length, i32 data
// length, channel, data. The format has no checksum, so `<log>.idx` holds offset, length, time,
// channel and CRC-32C of each event; stock tools ignore it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>

#include "engine/core/result.h"
#include "engine/journal/output_file.h"
#include "engine/wire/wire_message.h"

namespace palace {

/// A place between two events to which a log can be cut back.
struct LogMark {
  std::uint64_t log_bytes = 0;
  std::uint64_t index_bytes = 0;
  std::uint64_t events = 0;
};

/// One log and its sidecar. Not for several threads. Whatever fails, at whichever byte, only whole
/// events stay in the log, and the sidecar speaks of no other.
class LogWriter {
 public:
  /// Refuses to overwrite. kUnavailable naming the path and what to do.
  static Result<LogWriter> Create(const std::filesystem::path& path,
                                  const Disk& disk = SystemDisk());
  /// Into memory; to the operating system when much waits.
  Status Write(const WireMessage& message);
  /// Events that belong before the next one cannot be had any more: its number tells how many.
  void CountLost(std::uint64_t events) { lost_ += events; }
  /// To the operating system. After a failure the log ends where it was flushed last.
  Status Flush();
  Status Close();
  /// Where the log stands; to come back to, take it after a Flush.
  LogMark mark() const { return {log_.size(), index_.size(), events_}; }
  /// Undoes what was written after such a mark.
  void CutBackTo(const LogMark& mark);
  std::uint64_t events() const { return events_; }
  std::uint64_t bytes() const { return log_.size(); }
  const std::filesystem::path& path() const { return log_.path(); }
  /// Why the last write failed, in a few words.
  const std::string& problem() const {
    return log_.problem().empty() ? index_.problem() : log_.problem();
  }

 private:
  LogWriter(OutputFile log, OutputFile index) : log_(std::move(log)), index_(std::move(index)) {}
  void WriteIndex(const WireMessage& message, std::uint64_t offset, std::uint32_t length,
                  std::uint32_t crc);

  /// A channel's number in the sidecar, and the first event that used it.
  struct Channel {
    std::uint16_t id = 0;
    std::uint64_t first_event = 0;
  };
  OutputFile log_;
  OutputFile index_;
  std::map<std::string, Channel> channels_;
  LogMark flushed_;
  std::uint64_t events_ = 0;
  std::uint64_t lost_ = 0;
  std::uint64_t synced_bytes_ = 0;
};

}  // namespace palace
