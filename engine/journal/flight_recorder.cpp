#include <system_error>
#include <utility>

#include "engine/journal/log_index.h"
#include "engine/journal/log_writer.h"
#include "engine/wire/convert.h"

namespace palace {

Result<std::unique_ptr<FlightRecorder>> FlightRecorder::Open(const std::filesystem::path& folder,
                                                             const std::string& stamp,
                                                             ChannelNames channels) {
  const std::filesystem::path flight = folder / stamp;
  std::error_code failed;
  const bool made = std::filesystem::create_directories(flight, failed);
  if (failed) {
    return UnavailableError(flight.string() + ": cannot be made (" + failed.message() +
                            "); choose a folder that can be written with --record DIR, or fly "
                            "with --no-record");
  }
  Result<LogWriter> writer = LogWriter::Create(flight / "flight.lcm");
  if (!writer) {
    if (made) {
      std::filesystem::remove(flight, failed);
    }
    return writer.error();
  }
  return std::unique_ptr<FlightRecorder>(
      new FlightRecorder(std::move(*writer), std::move(channels)));
}

::palace::Status FlightRecorder::Record(const RecordItem& item) {
  waiting_.insert(waiting_.end(), item.commands.begin(), item.commands.end());
  // A flight begins with the first thing heard; a live vehicle's clock is not known before.
  const bool nothing_heard = item.bundle && !any_ && item.bundle->time == Timestamp{};
  if (!item.bundle || nothing_heard) {
    waiting_sent_.insert(waiting_sent_.end(), item.sent.begin(), item.sent.end());
    return Ok();
  }
  const Timestamp now = item.bundle->time;
  last_ = now;
  any_ = true;
  std::vector<WireMessage> messages = TakeWaiting(now);
  for (WireMessage& message : EncodeBundle(*item.bundle, channels_)) {
    messages.push_back(std::move(message));
  }
  for (const VehicleMessage& message : item.sent) {
    messages.push_back(EncodeVehicleMessage(message, now, channels_));
  }
  if (item.snapshot) {
    for (WireMessage& message : outputs_.Encode(*item.snapshot)) {
      messages.push_back(std::move(message));
    }
  }
  return WriteAll(messages);
}

std::vector<WireMessage> FlightRecorder::TakeWaiting(Timestamp now) {
  std::vector<WireMessage> messages;
  for (const EngineCommand& command : std::exchange(waiting_, {})) {
    messages.push_back(EncodeCommand(command, now, channels_));
  }
  for (const VehicleMessage& message : std::exchange(waiting_sent_, {})) {
    messages.push_back(EncodeVehicleMessage(message, now, channels_));
  }
  return messages;
}

::palace::Status FlightRecorder::WriteAll(const std::vector<WireMessage>& messages) {
  for (const WireMessage& message : messages) {
    const ::palace::Status written = writer_.Write(message);
    if (!written) {
      return written;
    }
  }
  return writer_.Flush();
}

::palace::Status FlightRecorder::Close() {
  const ::palace::Status written = any_ ? WriteAll(TakeWaiting(last_)) : Ok();
  const ::palace::Status closed = writer_.Close();
  if (!any_) {
    const std::filesystem::path log = writer_.path();
    std::error_code ignored;
    std::filesystem::remove(log, ignored);
    std::filesystem::remove(SidecarPath(log), ignored);
    std::filesystem::remove(log.parent_path(), ignored);
  }
  return written ? closed : written;
}

std::string FlightRecorder::Path() const { return writer_.path().string(); }

}  // namespace palace
