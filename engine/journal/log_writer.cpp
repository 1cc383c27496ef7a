#include "engine/journal/log_writer.h"

#include <algorithm>
#include <vector>

#include "engine/journal/big_endian.h"
#include "engine/journal/checksum.h"
#include "engine/journal/log_index.h"
#include "engine/journal/sidecar.h"

namespace palace {
namespace {
constexpr std::size_t kMostWaiting = 1u << 20;
constexpr std::uint64_t kSyncEveryBytes = 6u << 20;  // a second of a recorded flight
}  // namespace

Result<LogWriter> LogWriter::Create(const std::filesystem::path& path, const Disk& disk) {
  Result<OutputFile> log = OutputFile::Create(path, disk);
  if (!log) {
    return log.error();
  }
  Result<OutputFile> index = OutputFile::Create(SidecarPath(path), disk);
  if (!index) {
    // Nothing half-written stays behind.
    static_cast<void>(log->Close().ok());
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
    return index.error();
  }
  LogWriter writer(std::move(*log), std::move(*index));
  const std::vector<std::uint8_t> header = SidecarHeader();
  writer.index_.Append(header.data(), header.size());
  if (const Status begun = writer.index_.Flush(); !begun) {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
    std::filesystem::remove(SidecarPath(path), ignored);
    return begun.error();
  }
  writer.flushed_ = writer.mark();
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
  PutBig(head, static_cast<std::int64_t>(events_ + lost_));
  PutBig(head, message.time.us);
  PutBig(head, static_cast<std::int32_t>(message.channel.size()));
  PutBig(head, static_cast<std::int32_t>(message.payload.size()));
  head.insert(head.end(), message.channel.begin(), message.channel.end());

  const std::uint64_t offset = log_.size();
  log_.Append(head.data(), head.size());
  log_.Append(message.payload.data(), message.payload.size());
  const std::uint32_t crc =
      Crc32c(Crc32c(0, head.data(), head.size()), message.payload.data(), message.payload.size());
  const auto length = static_cast<std::uint32_t>(head.size() + message.payload.size());
  WriteIndex(message, offset, length, crc);
  ++events_;
  return log_.waiting() >= kMostWaiting ? Flush() : Ok();
}

void LogWriter::WriteIndex(const WireMessage& message, std::uint64_t offset, std::uint32_t length,
                           std::uint32_t crc) {
  std::vector<std::uint8_t> record;
  const auto [channel, is_new] = channels_.try_emplace(
      message.channel, Channel{static_cast<std::uint16_t>(channels_.size()), events_});
  if (is_new) {
    PALACE_CHECK(channels_.size() < kMostChannels);
    AppendSidecarChannel(record, channel->second.id, message.channel);
  }
  LogEntry entry;
  entry.offset = offset;
  entry.length = length;
  entry.number = static_cast<std::int64_t>(events_ + lost_);
  entry.time = message.time;
  entry.channel = channel->second.id;
  entry.crc = crc;
  AppendSidecarEvent(record, entry);
  index_.Append(record.data(), record.size());
}

Status LogWriter::Flush() {
  // The log first: the sidecar must not speak of events that are not there.
  Status done = log_.Flush();
  done = done ? index_.Flush() : done;
  if (!done) {
    CutBackTo(flushed_);
    return done;
  }
  flushed_ = mark();
  if (log_.size() - synced_bytes_ >= kSyncEveryBytes) {
    synced_bytes_ = log_.size();
    return log_.Sync();
  }
  return Ok();
}

void LogWriter::CutBackTo(const LogMark& mark) {
  log_.CutBack(mark.log_bytes);
  index_.CutBack(mark.index_bytes);
  events_ = mark.events;
  flushed_ = mark;
  synced_bytes_ = std::min(synced_bytes_, mark.log_bytes);
  std::erase_if(channels_,
                [&](const auto& channel) { return channel.second.first_event >= mark.events; });
}

Status LogWriter::Close() {
  const Status flushed = Flush();
  const Status log = log_.Close();
  const Status index = index_.Close();
  return !flushed ? flushed : log ? index : log;
}

}  // namespace palace
