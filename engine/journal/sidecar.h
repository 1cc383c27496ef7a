// The sidecar `<log>.idx`: what the log should hold, with checksums.
//
// "PALACEIX", u32 version 1, then records, big endian:
//   'C' u16 id, u8 length, name      a channel, before its first event
//   'E' u64 offset, u32 length, i64 number, i64 time_us, u16 channel, u32 crc of the event
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/journal/log_reader.h"

namespace palace {

inline constexpr std::uint16_t kMostChannels = 0xFFFF;

std::vector<std::uint8_t> SidecarHeader();
void AppendSidecarChannel(std::vector<std::uint8_t>& out, std::uint16_t id,
                          const std::string& name);
void AppendSidecarEvent(std::vector<std::uint8_t>& out, const LogEntry& entry);

struct Sidecar {
  std::vector<LogEntry> entries;
  std::vector<std::string> channels;
  std::uint64_t unread_bytes = 0;  ///< at its end: a torn record, or damage
};
/// Reads as many whole records as there are: a torn tail is no error. An Error when the file is
/// missing or is no sidecar.
Result<Sidecar> ReadSidecar(const std::filesystem::path& path);

}  // namespace palace
