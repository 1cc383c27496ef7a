#include "engine/wire/lcm_source.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "engine/core/time.h"
#include "engine/wire/channel_rules.h"

namespace palace {
namespace {

constexpr int kPoll_ms = 20;
constexpr int kMostDrained = 5000;  ///< messages taken at once before a bundle is delivered
constexpr double kSlip_s = 1;       ///< time running back this little is ironed out
constexpr double kJump_s = 60;      ///< time running on this much is a jump

}  // namespace

LcmSource::LcmSource(std::shared_ptr<Bus> bus, ChannelNames channels, LcmSourceOptions options)
    : bus_(std::move(bus)),
      channels_(std::move(channels)),
      options_(options),
      assembler_(channels_,
                 {.pair_window_s = AssemblerOptions{}.pair_window_s, .drop_repeated = true}),
      last_delivery_s_(MonotonicSeconds()) {
  status_.kind = SourceKind::kLive;
  status_.name = bus_->url();
}

Result<std::unique_ptr<LcmSource>> LcmSource::Create(std::shared_ptr<Bus> bus,
                                                     ChannelNames channels,
                                                     LcmSourceOptions options) {
  std::unique_ptr<LcmSource> source(new LcmSource(std::move(bus), std::move(channels), options));
  LcmSource* self = source.get();
  for (const std::string& channel : source->channels_.FromVehicle()) {
    const ::palace::Status subscribed = self->bus_->Subscribe(
        channel, [self](WireMessage message) { self->Take(std::move(message)); },
        LimitsOf(self->channels_, channel));
    if (!subscribed) {
      return subscribed.error();
    }
  }
  return source;
}

void LcmSource::Take(WireMessage message) {
  for (auto& bundle : assembler_.Push(message)) {
    ready_.push_back(std::move(bundle));
  }
  if (!assembler_.problem().empty()) {
    refusals_.Add({message.sender, message.channel, assembler_.problem(), message.payload.data(),
                   message.payload.size()},
                  message.time, MonotonicSeconds());
  }
  if (assembler_.newest() && anchor_ != assembler_.newest()) {
    anchor_ = assembler_.newest();
    anchor_s_ = MonotonicSeconds();
  }
}

void LcmSource::Drain() {
  for (int i = 0; i < kMostDrained; ++i) {
    const Result<bool> handled = bus_->Handle(0);
    if (!handled || !*handled) {
      return;
    }
  }
}

Timestamp LcmSource::ClockNow(double now_s) const {
  return anchor_ ? AddSeconds(*anchor_, now_s - anchor_s_) : Timestamp{};
}

std::shared_ptr<const FrameBundle> LcmSource::TakeReady() {
  std::shared_ptr<const FrameBundle> bundle = std::move(ready_.front());
  ready_.pop_front();
  while (!ready_.empty()) {
    JoinedBundle joined = Join(*bundle, *ready_.front());
    ready_.pop_front();
    joined_.pairs_replaced += joined.pair_replaced ? 1 : 0;
    joined_.samples_overflowed += joined.samples_dropped;
    bundle = std::move(joined.bundle);
  }
  return bundle;
}

Result<std::shared_ptr<const FrameBundle>> LcmSource::Next(std::stop_token stop) {
  while (!stop.stop_requested()) {
    if (ready_.empty()) {
      const Result<bool> handled = bus_->Handle(kPoll_ms);
      if (!handled) {
        return handled.error();
      }
    }
    if (!ready_.empty()) {
      Drain();
      return Deliver(TakeReady());
    }
    const double now_s = MonotonicSeconds();
    if (now_s - last_delivery_s_ >= options_.heartbeat_s) {
      return Deliver(assembler_.TakePending(ClockNow(now_s)));
    }
  }
  return Error{ErrorCode::kEnd, "stopped"};
}

std::shared_ptr<const FrameBundle> LcmSource::Deliver(std::shared_ptr<const FrameBundle> bundle) {
  auto delivered = std::make_shared<FrameBundle>(*bundle);
  delivered->sequence = sequence_++;
  for (std::vector<RefusedDatagram> refused : {bus_->TakeRefused(), refusals_.Take()}) {
    std::move(refused.begin(), refused.end(), std::back_inserter(delivered->refused));
  }
  if (last_time_) {
    const double step_s = SecondsBetween(*last_time_, delivered->time);
    delivered->discontinuity |= step_s < -kSlip_s || step_s > kJump_s;
    if (step_s < 0 && !delivered->discontinuity) {
      delivered->time = *last_time_;
    }
  }
  const bool begins = !last_time_ || delivered->discontinuity;
  if (anchor_) {  // the vehicle's clock is not known before its first message
    last_time_ = delivered->time;
  }
  last_delivery_s_ = MonotonicSeconds();
  Losses losses = Count();
  const std::lock_guard lock(mutex_);
  losses_ = std::move(losses);
  if (begins) {
    status_.start = delivered->time;
  }
  status_.position_s = SecondsBetween(status_.start, delivered->time);
  ++status_.frame_index;
  return delivered;
}

SourceStatus LcmSource::Status() const {
  const std::lock_guard lock(mutex_);
  return status_;
}

Losses LcmSource::Lost() const {
  const std::lock_guard lock(mutex_);
  return losses_;
}

Losses LcmSource::Count() const {
  const AssemblerReport& report = assembler_.report();
  Losses losses = joined_;
  losses.pictures_unpaired = report.pictures_unpaired;
  losses.pairs_without_rig = report.pairs_without_rig;
  losses.bundles_missing = report.bundles_lost;
  losses.samples_missing = report.samples_lost;
  losses.samples_overflowed += report.samples_overflowed;
  losses.undecodable = report.undecodable_of;
  losses.other_version = report.other_version_of;
  losses.bus = bus_->traffic();
  losses.datagrams_refused = losses.bus.refused;
  return losses;
}

}  // namespace palace
