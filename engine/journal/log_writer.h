// LogWriter and FlightRecorder: LCM event logs with a checked sidecar index.
//
// Event, big endian: u32 sync 0xEDA1DA01, i64 number, i64 time (us), i32 channel length, i32 data
// length, channel, data. The format has no checksum, so `<log>.idx` holds offset, length, time,
// channel and CRC-32C of each event; stock tools ignore it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/result.h"
#include "engine/runtime/record_sink.h"
#include "engine/wire/channels.h"
#include "engine/wire/output_encoder.h"
#include "engine/wire/wire_message.h"

namespace palace {

/// An open file whose every write is checked. Closes on destruction.
class OutputFile {
 public:
  static Result<OutputFile> Create(const std::filesystem::path& path);
  ~OutputFile();
  OutputFile(OutputFile&& other) noexcept;
  OutputFile& operator=(OutputFile&& other) noexcept;
  /// Into the buffer; written when the buffer is full.
  Status Append(const void* data, std::size_t size);
  /// To the operating system: survives the death of the program.
  Status Flush();
  /// To the disk: survives the loss of power.
  Status Sync();
  Status Close();
  /// Cuts the file back to `size` bytes after a failed write, so that no torn event stays.
  void CutBack(std::uint64_t size);
  std::uint64_t size() const { return size_; }
  const std::filesystem::path& path() const { return path_; }

 private:
  OutputFile() = default;
  std::filesystem::path path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
  std::vector<std::uint8_t> buffer_;
};

/// One log and its sidecar. Not for several threads.
class LogWriter {
 public:
  /// Refuses to overwrite. kUnavailable naming the path and what to do.
  static Result<LogWriter> Create(const std::filesystem::path& path);
  Status Write(const WireMessage& message);
  Status Flush();
  Status Close();
  std::uint64_t events() const { return events_; }
  std::uint64_t bytes() const { return log_.size(); }
  const std::filesystem::path& path() const { return log_.path(); }

 private:
  LogWriter(OutputFile log, OutputFile index) : log_(std::move(log)), index_(std::move(index)) {}
  Status WriteIndex(const WireMessage& message, std::uint64_t offset, std::uint32_t length,
                    std::uint32_t crc);

  OutputFile log_;
  OutputFile index_;
  std::map<std::string, std::uint16_t> channel_ids_;
  std::uint64_t events_ = 0;
  std::uint64_t synced_bytes_ = 0;
};

/// Writes `<folder>/<stamp>/flight.lcm`. Per pass of the engine, in this order: the commands that
/// were applied before the bundle (SITE_DECISION), the bundle (CAMERA_RIG last), what was sent to
/// the vehicle, then the outputs (STATION_STATUS last). Everything carries the bundle's time.
class FlightRecorder final : public RecordSink {
 public:
  /// A flight without a single bundle leaves no file and no folder behind.
  /// `stamp` names the flight, e.g. "2026-03-01_14-02-11"; the caller knows the time, this does
  /// not.
  static Result<std::unique_ptr<FlightRecorder>> Open(const std::filesystem::path& folder,
                                                      const std::string& stamp,
                                                      ChannelNames channels = {});
  ::palace::Status Record(const RecordItem& item) override;
  ::palace::Status Close() override;
  std::string Path() const override;

 private:
  FlightRecorder(LogWriter writer, ChannelNames channels)
      : writer_(std::move(writer)), channels_(channels), outputs_(channels) {}
  std::vector<WireMessage> TakeWaiting(Timestamp now);
  ::palace::Status WriteAll(const std::vector<WireMessage>& messages);

  LogWriter writer_;
  ChannelNames channels_;
  OutputEncoder outputs_;
  Timestamp last_;
  bool any_ = false;
  /// Given and sent while time stood still: they go before the next bundle, where a replay applies
  /// the commands.
  std::vector<EngineCommand> waiting_;
  std::vector<VehicleMessage> waiting_sent_;
};

}  // namespace palace
