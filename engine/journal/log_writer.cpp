#include "engine/journal/log_writer.h"

#include "engine/journal/big_endian.h"
#include "engine/journal/checksum.h"
#include "engine/journal/log_index.h"
#include "engine/journal/sidecar.h"

namespace palace {
namespace {
constexpr std::uint64_t kSyncEveryBytes = 16u << 20;
}

Result<LogWriter> LogWriter::Create(const std::filesystem::path& path) {
  Result<OutputFile> log = OutputFile::Create(path);
  if (!log) {
    return log.error();
  }
  Result<OutputFile> index = OutputFile::Create(SidecarPath(path));
  if (!index) {
    // Nothing half-written stays behind.
    static_cast<void>(log->Close().ok());
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
    return index.error();
  }
  LogWriter writer(std::move(*log), std::move(*index));
  const std::vector<std::uint8_t> header = SidecarHeader();
  const Status written = writer.index_.Append(header.data(), header.size());
  if (!written) {
    return written.error();
  }
  return Result<LogWriter>(std::move(writer));
}

Status LogWriter::Write(const WireMessage& message) {
  PALACE_CHECK(!message.channel.empty() && message.channel.size() <= kLogLongestChannel,
               message.channel);
  if (message.payload.size() > kLogLargestData) {
    return InvalidError(path().string() + ": a message of " +
                        std::to_string(message.payload.size()) + " bytes on " + message.channel +
                        " exceeds 64 MiB; send smaller pictures");
  }
  std::vector<std::uint8_t> head;
  head.reserve(kLogHeaderBytes + message.channel.size());
  PutBig(head, kLogSync);
  PutBig(head, static_cast<std::int64_t>(events_));
  PutBig(head, message.time.us);
  PutBig(head, static_cast<std::int32_t>(message.channel.size()));
  PutBig(head, static_cast<std::int32_t>(message.payload.size()));
  head.insert(head.end(), message.channel.begin(), message.channel.end());

  const std::uint64_t offset = log_.size();
  Status written = log_.Append(head.data(), head.size());
  if (written) {
    written = log_.Append(message.payload.data(), message.payload.size());
  }
  if (!written) {
    // Only whole events stay: what reached the file of this one is cut off again.
    log_.CutBack(std::min(offset, log_.size()));
    return written;
  }
  const std::uint32_t crc =
      Crc32c(Crc32c(0, head.data(), head.size()), message.payload.data(), message.payload.size());
  const auto length = static_cast<std::uint32_t>(head.size() + message.payload.size());
  const Status indexed = WriteIndex(message, offset, length, crc);
  ++events_;
  if (!indexed) {
    return indexed;
  }
  if (log_.size() - synced_bytes_ >= kSyncEveryBytes) {
    synced_bytes_ = log_.size();
    return log_.Sync();
  }
  return Ok();
}

Status LogWriter::WriteIndex(const WireMessage& message, std::uint64_t offset, std::uint32_t length,
                             std::uint32_t crc) {
  std::vector<std::uint8_t> record;
  const auto [channel, is_new] =
      channel_ids_.try_emplace(message.channel, static_cast<std::uint16_t>(channel_ids_.size()));
  if (is_new) {
    PALACE_CHECK(channel_ids_.size() < kMostChannels);
    AppendSidecarChannel(record, channel->second, message.channel);
  }
  LogEntry entry;
  entry.offset = offset;
  entry.length = length;
  entry.number = static_cast<std::int64_t>(events_);
  entry.time = message.time;
  entry.channel = channel->second;
  entry.crc = crc;
  AppendSidecarEvent(record, entry);
  return index_.Append(record.data(), record.size());
}

Status LogWriter::Flush() {
  // The log first: the sidecar must not speak of events that are not there.
  const Status log = log_.Flush();
  return log ? index_.Flush() : log;
}

Status LogWriter::Close() {
  const Status log = log_.Close();
  const Status index = index_.Close();
  return log ? index : log;
}

}  // namespace palace
