#include "engine/journal/sidecar.h"

#include <cstring>

#include "engine/journal/big_endian.h"

namespace palace {
namespace {

constexpr char kMagic[] = "PALACEIX";
constexpr std::uint32_t kVersion = 1;
constexpr std::size_t kHeaderBytes = 12;
constexpr std::size_t kEventBytes = 1 + 8 + 4 + 8 + 8 + 2 + 4;
constexpr std::uint64_t kLargestSidecar = 4ull << 30;

}  // namespace

std::vector<std::uint8_t> SidecarHeader() {
  std::vector<std::uint8_t> out(kMagic, kMagic + 8);
  PutBig(out, kVersion);
  return out;
}

void AppendSidecarChannel(std::vector<std::uint8_t>& out, std::uint16_t id,
                          const std::string& name) {
  out.push_back('C');
  PutBig(out, id);
  PutBig(out, static_cast<std::uint8_t>(name.size()));
  out.insert(out.end(), name.begin(), name.end());
}

void AppendSidecarEvent(std::vector<std::uint8_t>& out, const LogEntry& entry) {
  out.push_back('E');
  PutBig(out, entry.offset);
  PutBig(out, entry.length);
  PutBig(out, entry.number);
  PutBig(out, entry.time.us);
  PutBig(out, entry.channel);
  PutBig(out, entry.crc);
}

Result<Sidecar> ReadSidecar(const std::filesystem::path& path) {
  const Result<LogFile> file = LogFile::Open(path);
  if (!file) {
    return file.error();
  }
  if (file->size() > kLargestSidecar) {
    return InvalidError(path.string() + ": too large for a sidecar");
  }
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(file->size()));
  bytes.resize(file->ReadAt(0, bytes.data(), bytes.size()));
  if (bytes.size() < kHeaderBytes || std::memcmp(bytes.data(), kMagic, 8) != 0 ||
      GetBig<std::uint32_t>(bytes.data() + 8) != kVersion) {
    return InvalidError(path.string() + ": not a sidecar of version 1");
  }
  Sidecar sidecar;
  sidecar.entries.reserve(bytes.size() / kEventBytes);
  std::size_t at = kHeaderBytes;
  while (at < bytes.size()) {
    const std::uint8_t* p = bytes.data() + at;
    const std::size_t left = bytes.size() - at;
    if (p[0] == 'C' && left >= 4 && left >= 4u + p[3]) {
      if (GetBig<std::uint16_t>(p + 1) != sidecar.channels.size()) {
        break;
      }
      sidecar.channels.emplace_back(p + 4, p + 4 + p[3]);
      at += 4u + p[3];
    } else if (p[0] == 'E' && left >= kEventBytes) {
      LogEntry entry;
      entry.offset = GetBig<std::uint64_t>(p + 1);
      entry.length = GetBig<std::uint32_t>(p + 9);
      entry.number = GetBig<std::int64_t>(p + 13);
      entry.time = {GetBig<std::int64_t>(p + 21)};
      entry.channel = GetBig<std::uint16_t>(p + 29);
      entry.crc = GetBig<std::uint32_t>(p + 31);
      entry.has_crc = true;
      const std::uint64_t end = sidecar.entries.empty()
                                    ? 0
                                    : sidecar.entries.back().offset + sidecar.entries.back().length;
      if (entry.channel >= sidecar.channels.size() || entry.offset < end) {
        break;
      }
      sidecar.entries.push_back(entry);
      at += kEventBytes;
    } else {
      break;
    }
  }
  sidecar.unread_bytes = bytes.size() - at;
  return sidecar;
}

}  // namespace palace
