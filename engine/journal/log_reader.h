// LogFile and the scan: reads LCM event logs, whole or damaged.
//
// liblcm's own reader stops at the first damage and crashes on some lengths; this one bounds every
// length by the file, finds the next event after damage, and says what it skipped.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <stop_token>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/wire/wire_message.h"

namespace palace {

inline constexpr std::uint32_t kLogSync = 0xEDA1DA01;
inline constexpr std::size_t kLogHeaderBytes = 28;
inline constexpr std::uint32_t kLogLongestChannel = 63;
inline constexpr std::uint32_t kLogLargestData = 64u << 20;

/// A file opened for reading at any offset. Refuses folders, pipes and devices.
class LogFile {
 public:
  static Result<LogFile> Open(const std::filesystem::path& path);
  ~LogFile();
  LogFile(LogFile&& other) noexcept;
  LogFile& operator=(LogFile&& other) noexcept;
  std::uint64_t size() const { return size_; }
  const std::filesystem::path& path() const { return path_; }
  /// Bytes read, fewer at the end of the file or on a bad sector.
  std::size_t ReadAt(std::uint64_t offset, void* buffer, std::size_t size) const;

 private:
  LogFile() = default;
  std::filesystem::path path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

/// Where an event lies. `crc` is known only from a sidecar.
struct LogEntry {
  std::uint64_t offset = 0;  ///< of the sync word
  std::uint32_t length = 0;  ///< of header, channel and data together
  std::uint16_t channel = 0;
  bool has_crc = false;
  bool suspect = false;   ///< damage follows directly; its own bytes may be short
  std::uint32_t crc = 0;  ///< CRC-32C of header, channel and data
  std::int64_t number = 0;
  Timestamp time;
};

/// A stretch that holds no readable event.
struct LogGap {
  std::uint64_t offset = 0;
  std::uint64_t bytes = 0;
};

/// What is wrong with a log.
struct LogReport {
  std::uint64_t file_bytes = 0;
  std::uint64_t events = 0;
  std::uint64_t suspect = 0;
  std::uint64_t skipped_bytes = 0;
  std::vector<LogGap> gaps;  ///< the first 1000
  std::uint64_t gap_count = 0;
  std::uint64_t time_regressions = 0;  ///< events stamped before their predecessor
  std::uint64_t number_jumps = 0;      ///< event numbers that do not rise by one
  std::uint64_t checksum_errors = 0;   ///< against the sidecar
  std::uint64_t missing_events = 0;    ///< in the sidecar, not in the log
  std::uint64_t unchecked = 0;         ///< events that no checksum is known of
  std::string sidecar_problem{};       ///< why the sidecar does not check all; empty when it does
  bool cancelled = false;
  bool damaged() const {
    return skipped_bytes > 0 || suspect > 0 || checksum_errors > 0 || missing_events > 0;
  }
};

struct LogScan {
  std::vector<LogEntry> entries;
  std::vector<std::string> channels;  ///< by LogEntry::channel
  LogReport report;
};

/// Reads every header from `from` on, continuing `scan`. `progress` may be empty; it gets the share
/// done, 0..1. Stops early, marked cancelled, when stop is requested.
void ScanLog(const LogFile& file, std::uint64_t from, LogScan& scan, std::stop_token stop = {},
             const std::function<void(double)>& progress = {});

/// The event's message, when its bytes are still what the entry says: header, channel and, where
/// known, checksum.
Result<WireMessage> ReadEvent(const LogFile& file, const LogEntry& entry,
                              const std::vector<std::string>& channels);

}  // namespace palace
