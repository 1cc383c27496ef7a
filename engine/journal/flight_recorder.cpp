#include "engine/journal/flight_recorder.h"

#include <algorithm>
#include <cmath>
#include <exception>
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
constexpr std::size_t kMostWaiting = 64;   // commands before anything was heard; it may grow
constexpr double kTryEvery_s = 1;
constexpr double kTellSlowEvery_s = 1;

void Append(std::vector<WireMessage>& to, std::vector<WireMessage> messages) {
  to.insert(to.end(), std::make_move_iterator(messages.begin()),
            std::make_move_iterator(messages.end()));
}

std::uint64_t BytesOf(const LogMark& mark) { return mark.log_bytes + mark.index_bytes; }

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
      reserve_(ReserveBeside(writer_.path(), disk)) {
  // What may have to be kept when memory is short finds its place.
  missed_.reserve(kMostMissed);
  waiting_.reserve(kMostWaiting);
}

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
  step_s_ = first ? 0 : SecondsBetween(last_, item.bundle->time);
  last_ = item.bundle->time;
}

/// Commands wait until all of this is made.
void FlightRecorder::Before(const RecordItem& item, Messages& messages) {
  for (const EngineCommand& command : waiting_) {
    messages.push_back(EncodeCommand(command, last_, channels_));
  }
  pairs_too_slow_ += item.pairs_left_out;
  if (pairs_too_slow_ > 0 && std::abs(SecondsBetween(told_slow_, last_)) >= kTellSlowEvery_s) {
    told_slow_ = last_;
    messages.push_back(Told(std::to_string(std::exchange(pairs_too_slow_, 0)) +
                            " pairs of pictures were not written, the disk is too slow"));
  }
  waiting_.clear();
}

void FlightRecorder::After(const RecordItem& item, Messages& messages) {
  for (const VehicleMessage& message : item.sent) {
    messages.push_back(EncodeVehicleMessage(message, last_, channels_));
  }
  for (const Event& note : item.notes) {
    messages.push_back(EncodeEvent(
        {.time = last_, .kind = note.kind, .text = note.text, .level = note.level}, channels_));
  }
  if (item.snapshot && any_) {
    Append(messages, outputs_.Encode(*item.snapshot));
    if (!item.bundle) {
      messages.pop_back();  // STATION_STATUS is of a bundle
    }
  }
}

/// What throws is memory: what was decided then is written with the next pass.
::palace::Status FlightRecorder::Record(const RecordItem& item) {
  Messages before, after;
  const auto miss = [&](const char* problem) {
    if (!waiting_.empty()) {
      before.clear();
    }
    Stop(problem);
    Miss(before, after);
  };
  try {
    return TryRecord(item, before, after);
  } catch (const std::exception& error) {
    miss(error.what());
    throw;
  } catch (...) {
    miss("unknown exception");
    throw;
  }
}

::palace::Status FlightRecorder::TryRecord(const RecordItem& item, Messages& before,
                                           Messages& after) {
  Hear(item);
  waiting_.insert(waiting_.end(), item.commands.begin(), item.commands.end());
  if (!any_ && item.sent.empty() && item.notes.empty()) {
    return Ok();
  }
  if (any_) {
    Before(item, before);
  }
  After(item, after);
  if (!problem_.empty() && !MayTryAgain()) {
    pairs_left_out_ += item.bundle && item.bundle->stereo ? 1 : 0;
    Miss(before, after);
    return UnavailableError(Path() + ": " + problem_);
  }
  const ::palace::Status written = WritePass(item, before, after);
  if (!written) {
    Stop(writer_.problem().empty() ? "a message is too large" : writer_.problem());
    Miss(before, after);
    return written;
  }
  problem_.clear();
  missed_.clear();
  passes_missed_ = missed_dropped_ = 0;
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
  bool pictures = bundle != nullptr && KeepsPictures(*bundle);
  ::palace::Status done = WriteAll(before, bundle, pictures, after);
  if (!done && pictures) {
    ++pairs_left_out_;
    pictures = false;
    done = WriteAll(before, bundle, false, after);
  }
  if (!done && reserve_.bytes() > 0) {
    reserve_.Release();
    before.push_back(Told("the disk is full, the last minutes are of the space set aside"));
    done = WriteAll(before, bundle, false, after);
  }
  if (done && bundle != nullptr) {
    Count(*bundle, pictures);
  }
  return done;
}

/// What a pass takes on the disk: everything since the bundle before, the sidecar too.
void FlightRecorder::Count(const FrameBundle& bundle, bool pictures) {
  const std::uint64_t now = BytesOf(writer_.mark());
  const std::uint64_t of_pictures = PictureBytes(bundle);
  const std::uint64_t slim = now - bytes_before_ - (pictures ? of_pictures : 0);
  bytes_before_ = now;
  if (problem_.empty()) {  // else it holds what was missed meanwhile
    space_.Add(step_s_, slim + of_pictures, slim);
  }
}

::palace::Status FlightRecorder::WriteAll(const Messages& before, const FrameBundle* bundle,
                                          bool pictures, const Messages& after) {
  const LogMark start = writer_.mark();
  try {
    ::palace::Status written = WriteEach(before, bundle, pictures, after);
    if (!written) {
      writer_.CutBackTo(start);
    }
    return written;
  } catch (...) {
    writer_.CutBackTo(start);
    throw;
  }
}

::palace::Status FlightRecorder::WriteEach(const Messages& before, const FrameBundle* bundle,
                                           bool pictures, const Messages& after) {
  Messages seen;
  if (bundle != nullptr) {
    seen = EncodeBundle(pictures ? *bundle : WithoutPictures(*bundle), channels_);
  }
  for (const Messages* part : {&before, static_cast<const Messages*>(&seen), &after}) {
    for (const WireMessage& message : *part) {
      if (::palace::Status written = writer_.Write(message); !written) {
        return written;
      }
    }
  }
  return writer_.Flush();
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

void FlightRecorder::Stop(const std::string& problem) {
  if (problem_.empty()) {
    stopped_at_ = last_;
  }
  problem_ = problem;
}

/// Keeps what was decided in a pass that cannot be written, and empties both.
void FlightRecorder::Miss(Messages& before, Messages& after) {
  ++passes_missed_;
  for (Messages* part : {&before, &after}) {
    for (WireMessage& message : *part) {
      if (RankOf(message) > 0) {
        Keep(std::move(message));
      }
    }
    part->clear();
  }
}

/// What is kept longer while nothing can be written; 0: not kept.
int FlightRecorder::RankOf(const WireMessage& message) const {
  const std::string& channel = message.channel;
  const bool decides = channel == channels_.site_decision || channel == channels_.command ||
                       channel == channels_.abort;
  return decides ? 3 : channel == channels_.slad_settings ? 2 : channel == channels_.event ? 1 : 0;
}

void FlightRecorder::Keep(WireMessage message) {
  if (missed_.size() >= kMostMissed) {
    ++missed_dropped_;
    const auto least = std::min_element(
        missed_.begin(), missed_.end(),
        [&](const WireMessage& a, const WireMessage& b) { return RankOf(a) < RankOf(b); });
    if (RankOf(*least) > RankOf(message)) {
      return;
    }
    missed_.erase(least);
  }
  missed_.push_back(std::move(message));
}

FlightRecorder::Messages FlightRecorder::TakeMissed() {
  std::string text =
      WithNumbers("goes on after %.1f s; %.0f passes are missing, what was decided in them follows",
                  SecondsBetween(stopped_at_, last_), static_cast<double>(passes_missed_));
  if (missed_dropped_ > 0) {
    text += ", but for " + std::to_string(missed_dropped_) + " messages that memory did not hold";
  }
  Messages messages = {Told(text)};
  Append(messages, missed_);
  return messages;
}

::palace::Status FlightRecorder::Close() {
  ::palace::Status written = Ok();
  if (any_ || writer_.events() > 0) {
    reserve_.Release();
    Messages last = problem_.empty() ? Messages() : TakeMissed();
    Before({}, last);
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
