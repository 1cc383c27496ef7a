#include "engine/faults/faulted_source.h"

#include <utility>

#include "engine/wire/convert.h"

namespace palace {
namespace {

constexpr double kHeartbeat_s = 0.2;
constexpr double kSlack_s = 1e-6;
constexpr double kSlip_s = 1;   ///< time running back this little is ironed out
constexpr double kJump_s = 60;  ///< time running on this much is a jump

}  // namespace

FaultedSource::FaultedSource(std::shared_ptr<Source> source, std::shared_ptr<VehicleLink> link,
                             std::uint64_t seed)
    : source_(std::move(source)),
      link_(std::move(link)),
      pictures_(seed),
      vehicle_(seed),
      messages_(seed),
      assembler_({}, {.pair_window_s = AssemblerOptions{}.pair_window_s, .drop_repeated = true}) {}

::palace::Status FaultedSource::Add(const Fault& fault) {
  ::palace::Status sound = CheckFault(fault);
  if (sound) {
    faults_.push_back(fault);
  }
  return sound;
}

Result<std::shared_ptr<const FrameBundle>> FaultedSource::Next(std::stop_token stop) {
  while (ready_.empty()) {
    Result<std::shared_ptr<const FrameBundle>> next = source_->Next(stop);
    if (!next) {
      return next;
    }
    Take(**next);
    if (ready_.empty() && now_s_ - delivered_s_ >= kHeartbeat_s - kSlack_s) {
      return Deliver(assembler_.TakePending(VehicleClock()));
    }
  }
  std::shared_ptr<const FrameBundle> bundle = std::move(ready_.front());
  ready_.pop_front();
  return Deliver(std::move(bundle));
}

void FaultedSource::Take(const FrameBundle& bundle) {
  start_ = start_.value_or(bundle.time);
  now_s_ = SecondsBetween(*start_, bundle.time);
  FrameBundle struck = bundle;
  if (struck.stereo) {
    struck.stereo = pictures_.Apply(struck.stereo, faults_, now_s_);
  }
  vehicle_.Apply(struck, faults_, now_s_);
  for (const WireMessage& message :
       messages_.Apply(EncodeBundle(struck, ChannelNames{}), faults_, now_s_)) {
    for (auto& whole : assembler_.Push(message)) {
      ready_.push_back(std::move(whole));
    }
  }
  if (assembler_.newest() && heard_ != assembler_.newest()) {
    heard_ = assembler_.newest();
    heard_s_ = now_s_;
  }
  const AssemblerReport& report = assembler_.report();
  const std::lock_guard lock(mutex_);
  clock_offset_us_ = vehicle_.clock_offset_us();
  losses_ = source_->Lost();
  losses_.pictures_unpaired += report.pictures_unpaired;
  losses_.pairs_without_rig += report.pairs_without_rig;
  losses_.bundles_missing += report.bundles_lost;
  losses_.samples_missing += report.samples_lost;
  losses_.samples_overflowed += report.samples_overflowed;
  losses_.undecodable = report.undecodable_of;
}

Timestamp FaultedSource::VehicleClock() const {
  return heard_ ? AddSeconds(*heard_, now_s_ - heard_s_) : Timestamp{};
}

std::shared_ptr<const FrameBundle> FaultedSource::Deliver(
    std::shared_ptr<const FrameBundle> bundle) {
  auto delivered = std::make_shared<FrameBundle>(*bundle);
  delivered->sequence = ++sequence_;
  if (last_time_) {
    const double step_s = SecondsBetween(*last_time_, delivered->time);
    delivered->discontinuity |= step_s < -kSlip_s || step_s > kJump_s;
    if (step_s < 0 && !delivered->discontinuity) {
      delivered->time = *last_time_;
    }
  }
  if (heard_) {
    last_time_ = delivered->time;
  }
  delivered_s_ = now_s_;
  return delivered;
}

Losses FaultedSource::Lost() const {
  const std::lock_guard lock(mutex_);
  return losses_;
}

void FaultedSource::Send(const VehicleMessage& message) {
  std::int64_t offset_us = 0;
  {
    const std::lock_guard lock(mutex_);
    offset_us = clock_offset_us_;
  }
  if (link_) {
    link_->Send(OnClock(message, -offset_us));
  }
}

void FaultedSource::Announce(const EngineSnapshot& snapshot) {
  if (link_) {
    link_->Announce(snapshot);
  }
}

}  // namespace palace
