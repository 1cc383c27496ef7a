#include "engine/wire/lcm_source.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "engine/core/time.h"
#include "engine/wire/channel_rules.h"

namespace palace {
namespace {

constexpr int kPoll_ms = 20;
/// What waits is taken at once, but a bundle goes on after so long, whatever still comes ...
constexpr double kDrain_s = 0.05;
/// ... and after a stall only when what queued, which is bounded, was read: it is not silence.
constexpr double kDrainAfterStall_s = 0.5;

}  // namespace

LcmSource::LcmSource(std::shared_ptr<Bus> bus, ChannelNames channels, LcmSourceOptions options)
    : bus_(std::move(bus)),
      options_(std::move(options)),
      bundles_(std::move(channels), /*follow_simulation=*/true),
      last_delivery_s_(options_.now_s()) {
  status_.kind = SourceKind::kLive;
  status_.name = bus_->url();
}

Result<std::unique_ptr<LcmSource>> LcmSource::Create(std::shared_ptr<Bus> bus,
                                                     ChannelNames channels,
                                                     LcmSourceOptions options) {
  std::unique_ptr<LcmSource> source(new LcmSource(std::move(bus), channels, std::move(options)));
  LcmSource* self = source.get();
  const std::weak_ptr<const bool> alive = source->alive_;  // the bus may outlive the source
  for (const std::string& channel : channels.FromVehicle()) {
    const ::palace::Status subscribed = self->bus_->Subscribe(
        channel,
        [self, alive](const WireMessage& message) {
          if (!alive.expired()) {
            self->Take(message);
          }
        },
        LimitsOf(channels, channel));
    if (!subscribed) {
      return subscribed.error();
    }
  }
  if (!self->options_.overheard) {
    return source;
  }
  for (const std::string& channel : channels.ToVehicle()) {
    const ::palace::Status subscribed = self->bus_->Subscribe(
        channel,
        [self, alive](const WireMessage& message) {
          if (!alive.expired()) {
            self->options_.overheard(message);
          }
        },
        LimitsOf(channels, channel));
    if (!subscribed) {
      return subscribed.error();
    }
  }
  return source;
}

void LcmSource::NoticeStall(double now_s) {
  const double stalled_s = stall_watch_.Turn(now_s);
  if (stalled_s > 0) {
    bundles_.Stalled(stalled_s, now_s);
    last_stall_s_ = now_s;
  }
}

void LcmSource::Take(const WireMessage& message) {
  const double now_s = options_.now_s();
  NoticeStall(now_s);  // most often this machine stops while it waits for a message
  bundles_.Take(message, now_s);
  if (!bundles_.problem().empty()) {
    refusals_.Add({message.sender, message.channel, bundles_.problem(), message.payload.data(),
                   message.payload.size()},
                  message.time, now_s);
  }
}

void LcmSource::Drain(const std::stop_token& stop, double limit_s) {
  const double end_s = options_.now_s() + limit_s;
  while (!stop.stop_requested() && options_.now_s() < end_s) {
    const Result<bool> handled = bus_->Handle(0);
    if (!handled || !*handled) {
      return;
    }
  }
}

Result<std::shared_ptr<const FrameBundle>> LcmSource::Next(std::stop_token stop) {
  while (!stop.stop_requested()) {
    NoticeStall(options_.now_s());
    const Result<bool> handled = bus_->Handle(bundles_.ready() ? 0 : kPoll_ms);
    if (!handled) {
      return handled.error();
    }
    if (*handled) {
      const bool queued = options_.now_s() - last_stall_s_ < kDrainAfterStall_s;
      Drain(stop, queued ? kDrainAfterStall_s : kDrain_s);
    }
    if (bundles_.ready() || options_.now_s() - last_delivery_s_ >= options_.heartbeat_s) {
      return Deliver();
    }
  }
  return Error{ErrorCode::kEnd, "stopped"};
}

std::shared_ptr<const FrameBundle> LcmSource::Deliver() {
  last_delivery_s_ = options_.now_s();
  const BusTraffic traffic = bus_->traffic();
  bundles_.NoteOverflow(traffic);
  auto bundle = std::make_shared<FrameBundle>(*bundles_.HandOn(last_delivery_s_));
  for (std::vector<RefusedDatagram> refused : {bus_->TakeRefused(), refusals_.Take()}) {
    std::move(refused.begin(), refused.end(), std::back_inserter(bundle->refused));
  }
  Losses losses = bundles_.Count();
  losses.bus = traffic;
  losses.datagrams_refused = losses.bus.refused;
  const bool begins = !start_ || bundle->discontinuity;
  const std::lock_guard lock(mutex_);
  losses_ = std::move(losses);
  if (begins) {
    status_.start = bundle->time;
  }
  if (bundle->time != Timestamp{}) {  // nothing was heard before
    start_ = status_.start;
  }
  status_.position_s = SecondsBetween(status_.start, bundle->time);
  ++status_.frame_index;
  return bundle;
}

SourceStatus LcmSource::Status() const {
  const std::lock_guard lock(mutex_);
  return status_;
}

Losses LcmSource::Lost() const {
  const std::lock_guard lock(mutex_);
  return losses_;
}

}  // namespace palace
