#include "engine/journal/flight_recorder.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <system_error>
#include <utility>

#include "engine/core/text.h"
#include "engine/journal/log_index.h"
#include "engine/wire/convert.h"

namespace palace {
namespace {

constexpr std::uint64_t kReserveBytes = 48u << 20;  // five minutes without pictures
constexpr std::uint64_t kRoomToGoOn = 8u << 20;
constexpr std::size_t kMostMissed = 5000;  // decisions kept in memory while nothing can be written
constexpr double kTryEvery_s = 1;
constexpr double kTellSlowEvery_s = 1;

void Append(std::vector<WireMessage>& to, std::vector<WireMessage> messages) {
  to.insert(to.end(), std::make_move_iterator(messages.begin()),
            std::make_move_iterator(messages.end()));
}

std::uint64_t BytesOf(const std::vector<WireMessage>& messages) {
  std::uint64_t bytes = 0;
  for (const WireMessage& message : messages) {
    bytes += message.payload.size() + 2 * kLogHeaderBytes + message.channel.size();
  }
  return bytes;
}

std::uint64_t PictureBytes(const FrameBundle& bundle) {
  return bundle.stereo ? bundle.stereo->left.pixels().size() + bundle.stereo->right.pixels().size()
                       : 0;
}

/// At most a quarter of a small disk.
SpaceReserve ReserveBeside(const std::filesystem::path& log, const Disk& disk) {
  const std::filesystem::path folder = log.parent_path();
  const std::optional<std::uint64_t> room = disk.free_bytes(folder);
  return room ? SpaceReserve(folder, std::min(kReserveBytes, *room / 4), disk) : SpaceReserve();
}

}  // namespace

FlightRecorder::FlightRecorder(LogWriter writer, ChannelNames channels, const Disk& disk)
    : writer_(std::move(writer)),
      channels_(channels),
      disk_(disk),
      outputs_(channels),
      reserve_(ReserveBeside(writer_.path(), disk)) {}

Result<std::unique_ptr<FlightRecorder>> FlightRecorder::Open(const std::filesystem::path& folder,
                                                             const std::string& stamp,
                                                             ChannelNames channels,
                                                             const Disk& disk) {
  const std::filesystem::path flight = folder / stamp;
  std::error_code failed;
  const bool made = std::filesystem::create_directories(flight, failed);
  if (failed) {
    return UnavailableError(flight.string() + ": cannot be made (" + failed.message() +
                            "); choose a folder that can be written with --record DIR, or fly "
                            "with --no-record");
  }
  Result<LogWriter> writer = LogWriter::Create(flight / "flight.lcm", disk);
  if (!writer) {
    if (made) {
      std::filesystem::remove(flight, failed);
    }
    return writer.error();
  }
  return std::unique_ptr<FlightRecorder>(
      new FlightRecorder(std::move(*writer), std::move(channels), disk));
}

WireMessage FlightRecorder::Told(const std::string& text) const {
  return EncodeEvent({last_, EventKind::kAlarm, "Recording: " + text}, channels_);
}

void FlightRecorder::Hear(const RecordItem& item) {
  // A flight begins with the first thing heard; a live vehicle's clock is not known before.
  if (!item.bundle || (!any_ && item.bundle->time == Timestamp{})) {
    return;
  }
  const bool first = !std::exchange(any_, true);
  if (!first) {
    const std::uint64_t slim = BytesOf(EncodeBundle(WithoutPictures(*item.bundle), channels_));
    space_.Add(SecondsBetween(last_, item.bundle->time), slim + PictureBytes(*item.bundle), slim);
  }
  last_ = item.bundle->time;
}

FlightRecorder::Messages FlightRecorder::Before(const RecordItem& item) {
  Messages messages;
  for (const EngineCommand& command : std::exchange(waiting_, {})) {
    messages.push_back(EncodeCommand(command, last_, channels_));
  }
  pairs_too_slow_ += item.pairs_left_out;
  if (pairs_too_slow_ > 0 && std::abs(SecondsBetween(told_slow_, last_)) >= kTellSlowEvery_s) {
    told_slow_ = last_;
    messages.push_back(Told(std::to_string(std::exchange(pairs_too_slow_, 0)) +
                            " pairs of pictures were not written, the disk is too slow"));
  }
  return messages;
}

FlightRecorder::Messages FlightRecorder::After(const RecordItem& item) {
  Messages messages;
  for (const VehicleMessage& message : item.sent) {
    messages.push_back(EncodeVehicleMessage(message, last_, channels_));
  }
  for (const Event& note : item.notes) {
    messages.push_back(EncodeEvent({last_, note.kind, note.text}, channels_));
  }
  if (item.snapshot && any_) {
    Append(messages, outputs_.Encode(*item.snapshot));
    if (!item.bundle) {
      messages.pop_back();  // STATION_STATUS is of a bundle
    }
  }
  return messages;
}

::palace::Status FlightRecorder::Record(const RecordItem& item) {
  Hear(item);
  waiting_.insert(waiting_.end(), item.commands.begin(), item.commands.end());
  if (!any_ && item.sent.empty() && item.notes.empty()) {
    return Ok();
  }
  Messages before = any_ ? Before(item) : Messages();
  Messages after = After(item);
  if (!problem_.empty() && !MayTryAgain()) {
    pairs_left_out_ += item.bundle && item.bundle->stereo ? 1 : 0;
    Miss(std::move(before), std::move(after));
    return UnavailableError(Path() + ": " + problem_);
  }
  const ::palace::Status written = WritePass(item, before, after);
  if (!written) {
    if (problem_.empty()) {
      stopped_at_ = last_;
    }
    problem_ = writer_.problem().empty() ? "a message is too large" : writer_.problem();
    Miss(std::move(before), std::move(after));
    return written;
  }
  problem_.clear();
  missed_.clear();
  passes_missed_ = 0;
  return Ok();
}

::palace::Status FlightRecorder::WritePass(const RecordItem& item, Messages before,
                                           const Messages& after) {
  const FrameBundle* bundle = any_ ? item.bundle.get() : nullptr;
  std::shared_ptr<FrameBundle> resumed;
  if (!problem_.empty()) {
    Messages missed = TakeMissed();
    Append(missed, std::move(before));
    before = std::move(missed);
    if (bundle != nullptr) {
      // A replay cannot re-live what is not there: from here it follows the record.
      resumed = std::make_shared<FrameBundle>(*bundle);
      resumed->discontinuity = true;
      bundle = resumed.get();
    }
  }
  Thin(before);
  const bool pictures = bundle != nullptr && KeepsPictures(*bundle);
  ::palace::Status done = WriteAll(before, bundle, pictures, after);
  if (!done && pictures) {
    ++pairs_left_out_;
    done = WriteAll(before, bundle, false, after);
  }
  if (!done && reserve_.bytes() > 0) {
    reserve_.Release();
    before.push_back(Told("the disk is full, the last minutes are of the space set aside"));
    done = WriteAll(before, bundle, false, after);
  }
  return done;
}

::palace::Status FlightRecorder::WriteAll(const Messages& before, const FrameBundle* bundle,
                                          bool pictures, const Messages& after) {
  const LogMark start = writer_.mark();
  Messages seen;
  if (bundle != nullptr) {
    seen = EncodeBundle(pictures ? *bundle : WithoutPictures(*bundle), channels_);
  }
  for (const Messages* part : {&before, static_cast<const Messages*>(&seen), &after}) {
    for (const WireMessage& message : *part) {
      if (::palace::Status written = writer_.Write(message); !written) {
        writer_.CutBackTo(start);
        return written;
      }
    }
  }
  ::palace::Status flushed = writer_.Flush();
  if (!flushed) {
    writer_.CutBackTo(start);
  }
  return flushed;
}

/// How many pictures the disk has room for now; a change is told in the log.
void FlightRecorder::Thin(Messages& before) {
  const std::filesystem::path folder = writer_.path().parent_path();
  const std::optional<std::uint64_t> room = disk_.free_bytes(folder);
  const int was = space_.every();
  if (!room || space_.Decide(*room) == was) {
    return;
  }
  const std::string now = ThinningWords(space_.every());
  before.push_back(Told(!now.empty() ? "the disk is nearly full, " + now
                                     : "all pictures again; " + std::to_string(pairs_left_out_) +
                                           " pairs are left out"));
  if (space_.every() == 1 && reserve_.bytes() == 0) {
    reserve_ = ReserveBeside(writer_.path(), disk_);
  }
}

bool FlightRecorder::KeepsPictures(const FrameBundle& bundle) {
  if (!bundle.stereo) {
    return false;
  }
  const auto every = static_cast<std::uint64_t>(space_.every());
  const bool keeps = every != 0 && pairs_ % every == 0;
  ++pairs_;
  pairs_left_out_ += keeps ? 0 : 1;
  return keeps;
}

bool FlightRecorder::MayTryAgain() {
  if (std::abs(SecondsBetween(tried_at_, last_)) < kTryEvery_s) {
    return false;
  }
  tried_at_ = last_;
  return disk_.free_bytes(writer_.path().parent_path()).value_or(kRoomToGoOn) >= kRoomToGoOn;
}

/// Keeps what was decided in a pass that cannot be written.
void FlightRecorder::Miss(Messages before, Messages after) {
  ++passes_missed_;
  Append(before, std::move(after));
  const auto is_decision = [&](const WireMessage& message) {
    return message.channel == channels_.site_decision || message.channel == channels_.command ||
           message.channel == channels_.abort || message.channel == channels_.event ||
           message.channel == channels_.slad_settings;
  };
  for (WireMessage& message : before) {
    if (is_decision(message) && missed_.size() < kMostMissed) {
      missed_.push_back(std::move(message));
    }
  }
}

FlightRecorder::Messages FlightRecorder::TakeMissed() {
  Messages messages = {
      Told(WithNumbers("goes on after %.1f s; %.0f passes are missing, what was "
                       "decided in them follows",
                       SecondsBetween(stopped_at_, last_), static_cast<double>(passes_missed_)))};
  Append(messages, missed_);
  return messages;
}

::palace::Status FlightRecorder::Close() {
  ::palace::Status written = Ok();
  if (any_ || writer_.events() > 0) {
    reserve_.Release();
    Messages last = problem_.empty() ? Messages() : TakeMissed();
    Append(last, Before({}));
    if (pairs_left_out_ > 0) {
      last.push_back(Told(std::to_string(pairs_left_out_) + " pairs of pictures are left out"));
    }
    written = WriteAll(last, nullptr, false, {});
  }
  const ::palace::Status closed = writer_.Close();
  if (writer_.events() == 0) {
    const std::filesystem::path log = writer_.path();
    std::error_code ignored;
    std::filesystem::remove(log, ignored);
    std::filesystem::remove(SidecarPath(log), ignored);
    std::filesystem::remove(log.parent_path(), ignored);
  }
  return written ? closed : written;
}

std::string FlightRecorder::Path() const { return writer_.path().string(); }

RecordState FlightRecorder::State() const {
  RecordState state;
  state.pictures_every = space_.every();
  state.pairs_left_out = pairs_left_out_;
  state.problem = problem_;
  const auto room = disk_.free_bytes(writer_.path().parent_path());
  if (room && any_) {
    state.minutes_left = space_.SecondsIn(*room + reserve_.bytes()) / 60;
  }
  return state;
}

}  // namespace palace
