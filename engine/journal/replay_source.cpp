#include "engine/journal/replay_source.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/core/text.h"
#include "engine/core/time.h"
#include "engine/journal/heard_channels.h"
#include "engine/journal/track_reader.h"
#include "engine/wire/convert.h"

namespace palace {
namespace {

using SteadyClock = std::chrono::steady_clock;

constexpr double kCatchUp_s = 0.25;

/// Its events are stamped with the time of their bundle, not of whoever logged a bus.
bool IsStationsOwn(const FlightRecord& record, const std::vector<BundleMark>& bundles) {
  return !record.samples.empty() &&
         std::any_of(bundles.begin(), bundles.end(), [&](const BundleMark& bundle) {
           return bundle.time == record.samples.front().time;
         });
}

const Settings& SettingsAt(const FlightRecord& record, Timestamp time) {
  const Settings* newest = &record.settings_at_start;
  for (const SettingsInForce& each : record.settings) {
    newest = each.from <= time ? &each.settings : newest;
  }
  return *newest;
}

/// Leaves one of each event that is written twice in a row; how many had to go. A log numbers what
/// it heard: what was sent twice has two numbers, and both stay.
std::uint64_t LeaveOneOfEach(const LogFile& file, LogIndex& index) {
  const auto same = [&](const LogEntry& a, const LogEntry& b) {
    if (a.number != b.number || a.time != b.time || a.channel != b.channel ||
        a.length != b.length) {
      return false;
    }
    const Result<WireMessage> first = ReadEvent(file, a, index.channels);
    const Result<WireMessage> second = ReadEvent(file, b, index.channels);
    return first && second && first->payload == second->payload;
  };
  const auto all = index.entries.size();
  index.entries.erase(std::unique(index.entries.begin(), index.entries.end(), same),
                      index.entries.end());
  return all - index.entries.size();
}

SteadyClock::time_point TimePoint(double monotonic_s) {
  const double wait_s = monotonic_s - MonotonicSeconds();
  return SteadyClock::now() +
         std::chrono::duration_cast<SteadyClock::duration>(std::chrono::duration<double>(wait_s));
}

}  // namespace

ReplaySource::ReplaySource(LogFile file, LogIndex index, const ReplayOptions& options)
    : file_(std::move(file)),
      index_(std::move(index)),
      options_(options),
      assembler_(options.channels),
      paused_(options.paused),
      speed_(options.speed),
      speed_reached_(options.speed) {}

Result<std::unique_ptr<ReplaySource>> ReplaySource::Open(const std::filesystem::path& path) {
  return Open(path, ReplayOptions{});
}

Result<std::unique_ptr<ReplaySource>> ReplaySource::Open(const std::filesystem::path& path,
                                                         const ReplayOptions& options) {
  Result<LogFile> file = LogFile::Open(path);
  if (!file) {
    return file.error();
  }
  Result<LogIndex> index = BuildIndex(*file);
  if (!index) {
    return index.error();
  }
  std::unique_ptr<ReplaySource> source(
      new ReplaySource(std::move(*file), std::move(*index), options));
  const ::palace::Status prepared = source->Prepare(path);
  if (!prepared) {
    return prepared.error();
  }
  return source;
}

::palace::Status ReplaySource::Prepare(const std::filesystem::path& path) {
  written_twice_ = LeaveOneOfEach(file_, index_);
  bundles_ = FindBundles(file_, index_, options_.channels);
  if (bundles_.empty()) {
    return InvalidError(path.string() + ": holds " + std::to_string(index_.entries.size()) +
                        " readable events but no stereo bundle; it needs " +
                        options_.channels.camera_rig + " with " + options_.channels.camera_left +
                        " and " + options_.channels.camera_right +
                        " (other names: config/channels.toml)");
  }
  if (const ::palace::Status chosen = ChoosePart(path); !chosen) {
    return chosen;
  }
  ReadTrack();
  // A foreign log may tell its rig once, anywhere: know it before the first pair and after seeks.
  for (const LogEntry& entry : index_.entries) {
    if (index_.channels[entry.channel] == options_.channels.camera_rig) {
      const Result<WireMessage> message = ReadEvent(file_, entry, index_.channels);
      if (message) {
        assembler_.Push(*message);
      }
      if (assembler_.rig()) {
        break;
      }
    }
  }
  assembler_.Reset();
  return Ok();
}

::palace::Status ReplaySource::ChoosePart(const std::filesystem::path& path) {
  const std::vector<LogPart> parts = FindParts(bundles_);
  parts_ = static_cast<int>(parts.size());
  if (options_.part < 0 || options_.part > parts_) {
    return UsageError("--part " + std::to_string(options_.part) + ": " + path.string() + " holds " +
                      (parts_ == 1 ? "one part" : "parts 1 to " + std::to_string(parts_)));
  }
  const auto longest = std::max_element(
      parts.begin(), parts.end(),
      [](const LogPart& a, const LogPart& b) { return a.duration_s < b.duration_s; });
  part_ = options_.part > 0 ? options_.part : static_cast<int>(longest - parts.begin()) + 1;
  const LogPart& part = parts[static_cast<std::size_t>(part_ - 1)];
  next_event_ = bundles_[part.first].first;
  const bool last = part.end == bundles_.size();
  end_event_ = last ? index_.entries.size() : bundles_[part.end].first;
  // What the station made of a bundle follows it.
  first_told_ = part.first == 0 ? 0 : bundles_[part.first].end;
  end_told_ = last ? index_.entries.size() : bundles_[part.end].end;
  bundles_ = {bundles_.begin() + static_cast<std::ptrdiff_t>(part.first),
              bundles_.begin() + static_cast<std::ptrdiff_t>(part.end)};
  return Ok();
}

void ReplaySource::ReadTrack() {
  auto record = std::make_shared<FlightRecord>();
  const ChannelNames& names = options_.channels;
  record->path = file_.path().string();
  record->file_bytes = file_.size();
  record->start_s = static_cast<double>(bundles_.front().time.us) * 1e-6;
  record->duration_s = std::max(0.0, SecondsBetween(bundles_.front().time, bundles_.back().time));
  TrackReader reader(names, *record);
  std::optional<WireMessage> settings;  // in force when the part began
  for (std::size_t i = 0; i < end_told_; ++i) {
    const LogEntry& entry = index_.entries[i];
    const std::string& channel = index_.channels[entry.channel];
    const bool before = i < first_told_;
    if (before ? channel != names.slad_settings : !reader.Wants(channel)) {
      continue;
    }
    Result<WireMessage> message = ReadEvent(file_, entry, index_.channels);
    if (message && before) {
      settings = std::move(*message);
      settings->time = bundles_.front().time;
    } else if (message) {
      if (settings) {
        reader.Add(*std::exchange(settings, std::nullopt));
      }
      reader.Add(*message);
    }
  }
  AddTruth(*record);
  std::stable_sort(record->events.begin(), record->events.end(),
                   [](const Event& a, const Event& b) { return a.time < b.time; });
  const auto heard = FindHeard(index_, bundles_, names);
  record->gaps = FindGaps(heard, bundles_);
  if (IsStationsOwn(*record, bundles_)) {
    record->heard = heard;
  }
  recorded_ = std::move(record);
}

void ReplaySource::AddTruth(FlightRecord& record) const {
  for (RecordedTouchdown& touchdown : record.touchdowns) {
    const auto bundle = std::find_if(bundles_.begin(), bundles_.end(), [&](const BundleMark& mark) {
      return mark.time == touchdown.time;
    });
    if (bundle == bundles_.end()) {
      continue;
    }
    for (std::size_t i = bundle->end; i-- > bundle->first;) {
      if (index_.channels[index_.entries[i].channel] == options_.channels.truth) {
        const Result<WireMessage> message = ReadEvent(file_, index_.entries[i], index_.channels);
        const Result<Truth> truth =
            message ? DecodeTruth(*message) : Result<Truth>(message.error());
        if (truth) {
          const Eigen::Vector3d skid_W =
              truth->X_WB * SettingsAt(record, touchdown.time).slad.lander.skid_centre_B();
          touchdown.true_miss_m = (skid_W - touchdown.p_WS).head<2>().norm();
        }
        break;
      }
    }
  }
}

std::shared_ptr<const FrameBundle> ReplaySource::ReadBundle() {
  std::vector<EngineCommand> commands;
  while (next_event_ < end_event_) {
    const Result<WireMessage> message =
        ReadEvent(file_, index_.entries[next_event_++], index_.channels);
    if (!message) {
      ++events_refused_;
      continue;
    }
    if (message->channel == options_.channels.site_decision) {
      Result<EngineCommand> command = DecodeCommand(*message);
      if (command) {
        commands.push_back(std::move(*command));
      } else {
        ++events_refused_;
      }
      continue;
    }
    const auto done = assembler_.Push(*message);
    if (!done.empty()) {
      auto bundle = std::make_shared<FrameBundle>(*done.front());
      bundle->recorded_commands = std::move(commands);
      return bundle;
    }
  }
  return nullptr;
}

bool ReplaySource::WaitForTurn(std::unique_lock<std::mutex>& lock, std::stop_token stop) {
  while (!stop.stop_requested()) {
    if (AtEnd()) {
      if (!options_.wait_at_end) {
        return false;
      }
      steps_ = 0;
      changed_.wait(lock, stop, [&] { return jump_pending_; });
      continue;
    }
    if (jump_pending_ || steps_ > 0) {
      return true;
    }
    if (paused_) {
      changed_.wait(lock, stop, [&] { return jump_pending_ || steps_ > 0 || !paused_; });
      continue;
    }
    if (speed_ <= 0 || !last_delivery_s_ || !last_time_) {
      return true;
    }
    // Never waits for a stamp from the file: a gap costs longest_gap_s at most.
    const double gap_s = std::clamp(SecondsBetween(*last_time_, bundles_[next_bundle_].time), 0.0,
                                    options_.longest_gap_s);
    const double speed = speed_;
    const double due_s = *last_delivery_s_ + gap_s / speed;
    const bool disturbed = changed_.wait_until(lock, stop, TimePoint(due_s), [&] {
      return jump_pending_ || steps_ > 0 || paused_ || speed_ != speed;
    });
    if (!disturbed && !stop.stop_requested()) {
      return true;
    }
  }
  return false;
}

Result<std::shared_ptr<const FrameBundle>> ReplaySource::Next(std::stop_token stop) {
  std::unique_lock lock(mutex_);
  while (WaitForTurn(lock, stop)) {
    const bool jump = std::exchange(jump_pending_, false);
    steps_ = std::max(0, steps_ - 1);
    const std::uint64_t generation = generation_;
    if (jump) {
      next_event_ = bundles_[next_bundle_].first;
      assembler_.Reset();
      was_jump_ = true;
    }
    lock.unlock();
    std::shared_ptr<const FrameBundle> bundle = ReadBundle();
    lock.lock();
    if (generation != generation_) {
      continue;  // a seek came while reading: that bundle is from the wrong place
    }
    next_bundle_ = static_cast<std::size_t>(
        std::partition_point(bundles_.begin(), bundles_.end(),
                             [&](const BundleMark& mark) { return mark.end <= next_event_; }) -
        bundles_.begin());
    if (!bundle) {
      next_bundle_ = bundles_.size();
      continue;
    }
    return Deliver(std::move(bundle));
  }
  return Error{ErrorCode::kEnd, stop.stop_requested() ? "stopped" : "end of the log"};
}

std::shared_ptr<const FrameBundle> ReplaySource::Deliver(
    std::shared_ptr<const FrameBundle> bundle) {
  const double now_s = MonotonicSeconds();
  double beat_s = now_s;
  if (last_delivery_s_ && last_time_ && !was_jump_ && now_s > *last_delivery_s_) {
    const double step_s = SecondsBetween(*last_time_, bundle->time);
    speed_reached_ = step_s / (now_s - *last_delivery_s_);
    // A little late is made up for at the next bundle, so that lateness does not add up.
    const double due_s = *last_delivery_s_ + step_s / std::max(speed_, 1e-3);
    beat_s = now_s - due_s > 0 && now_s - due_s < kCatchUp_s ? due_s : now_s;
  }
  last_delivery_s_ = beat_s;
  last_time_ = bundle->time;
  if (std::exchange(was_jump_, false)) {
    auto marked = std::make_shared<FrameBundle>(*bundle);
    marked->discontinuity = true;
    return marked;
  }
  return bundle;
}

SourceStatus ReplaySource::Status() const {
  const std::lock_guard lock(mutex_);
  SourceStatus status;
  status.kind = SourceKind::kReplay;
  status.name = file_.path().string();
  status.paused = paused_;
  status.ended = AtEnd();
  status.speed = speed_;
  status.speed_reached = speed_reached_;
  status.start = bundles_.front().time;
  status.position_s = last_time_ ? SecondsBetween(status.start, *last_time_) : 0;
  status.duration_s = recorded_->duration_s;
  status.can_seek = true;
  status.jumps = generation_;
  status.frame_index = next_bundle_;
  status.frame_count = bundles_.size();
  status.part = part_;
  status.parts = parts_;
  std::vector<std::string> damage;
  if (const LogReport& report = index_.report; report.damaged()) {
    damage.push_back(WithNumbers("%.0f bytes unreadable, %.0f events damaged, %.0f missing",
                                 static_cast<double>(report.skipped_bytes),
                                 static_cast<double>(report.suspect + report.checksum_errors),
                                 static_cast<double>(report.missing_events)));
  }
  if (written_twice_ > 0) {
    damage.push_back(
        WithNumbers("%.0f events written twice, taken once", static_cast<double>(written_twice_)));
  }
  if (const std::uint64_t refused = events_refused_; refused > 0) {
    damage.push_back(WithNumbers("%.0f not decoded so far", static_cast<double>(refused)));
  }
  status.damage = Joined(damage);
  return status;
}

void ReplaySource::JumpTo(std::size_t bundle) {
  next_bundle_ = std::min(bundle, bundles_.size() - 1);
  jump_pending_ = true;
  ++generation_;
}

void ReplaySource::Control(const PlaybackControl& control) {
  {
    const std::lock_guard lock(mutex_);
    using Kind = PlaybackControl::Kind;
    switch (control.kind) {
      case Kind::kPlay:
        paused_ = false;
        if (AtEnd()) {
          JumpTo(0);  // played to the end: from the start again
        }
        break;
      case Kind::kPause:
        paused_ = true;
        break;
      case Kind::kStepForward:
        paused_ = true;
        ++steps_;
        break;
      case Kind::kStepBack:
        paused_ = true;
        JumpTo(next_bundle_ >= 2 ? next_bundle_ - 2 : 0);
        break;
      case Kind::kSeek:
        if (std::isfinite(control.value)) {
          const double limit_s = recorded_->duration_s + 1;
          const Timestamp wanted =
              AddSeconds(bundles_.front().time, std::clamp(control.value, 0.0, limit_s));
          JumpTo(static_cast<std::size_t>(
              std::partition_point(bundles_.begin(), bundles_.end(),
                                   [&](const BundleMark& m) { return m.time < wanted; }) -
              bundles_.begin()));
        }
        break;
      case Kind::kSpeed:
        if (std::isfinite(control.value) && control.value >= 0) {
          speed_ = control.value;
        }
        break;
      case Kind::kRunTo:  // of a simulation
        break;
    }
  }
  changed_.notify_all();
}

}  // namespace palace
