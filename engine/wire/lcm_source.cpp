#include "engine/wire/lcm_source.h"

#include <algorithm>
#include <utility>

#include "engine/core/time.h"

namespace palace {
namespace {

constexpr int kPoll_ms = 20;
constexpr int kMostDrained = 5000;  ///< messages taken at once before a bundle is delivered
constexpr int kPictureQueue = 16;
constexpr int kSampleQueue = 512;
constexpr double kSlip_s = 1;   ///< time running back this little is ironed out
constexpr double kJump_s = 60;  ///< time running on this much is a jump
constexpr double kLate_s = 0.5;
constexpr double kStale_s = 2.0;

template <typename T>
void Prepend(std::vector<T>& to, const std::vector<T>& older) {
  to.insert(to.begin(), older.begin(), older.end());
}

/// The newer bundle with the older one's samples before its own.
std::shared_ptr<const FrameBundle> Join(const FrameBundle& older, const FrameBundle& newer) {
  auto joined = std::make_shared<FrameBundle>(newer);
  joined->discontinuity = older.discontinuity || newer.discontinuity;
  Prepend(joined->poses, older.poses);
  Prepend(joined->imu, older.imu);
  Prepend(joined->gps, older.gps);
  Prepend(joined->laser, older.laser);
  Prepend(joined->acks, older.acks);
  Prepend(joined->truth, older.truth);
  if (!joined->status) {
    joined->status = older.status;
  }
  if (!joined->stereo) {
    joined->stereo = older.stereo;
    joined->pose_at_exposure = older.pose_at_exposure;
  }
  return joined;
}

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
    const bool picture =
        channel == self->channels_.camera_left || channel == self->channels_.camera_right;
    const ::palace::Status subscribed = self->bus_->Subscribe(
        channel, [self](WireMessage message) { self->Take(std::move(message)); },
        picture ? kPictureQueue : kSampleQueue);
    if (!subscribed) {
      return subscribed.error();
    }
  }
  return source;
}

void LcmSource::Take(WireMessage message) {
  const AssemblerReport before = assembler_.report();
  for (auto& bundle : assembler_.Push(message)) {
    ready_.push_back(std::move(bundle));
  }
  const AssemblerReport& after = assembler_.report();
  const double now_s = MonotonicSeconds();
  const std::lock_guard lock(mutex_);
  report_ = after;
  if (after.repeated != before.repeated || after.undecodable != before.undecodable) {
    return;
  }
  Arrival& arrival = arrivals_[message.channel];
  arrival.first_s = arrival.count == 0 ? now_s : arrival.first_s;
  arrival.last_s = now_s;
  ++arrival.count;
  if (assembler_.newest() && anchor_ != assembler_.newest()) {
    anchor_ = assembler_.newest();
    anchor_s_ = now_s;
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
      std::shared_ptr<const FrameBundle> bundle = std::move(ready_.front());
      ready_.pop_front();
      while (!ready_.empty()) {
        bundle = Join(*bundle, *ready_.front());
        ready_.pop_front();
      }
      return Deliver(std::move(bundle));
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
  const std::lock_guard lock(mutex_);
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

AssemblerReport LcmSource::Report() const {
  const std::lock_guard lock(mutex_);
  return report_;
}

std::vector<ChannelHealth> LcmSource::Health() const {
  const double now_s = MonotonicSeconds();
  const std::lock_guard lock(mutex_);
  std::vector<ChannelHealth> rows;
  for (const std::string& channel : channels_.FromVehicle()) {
    ChannelHealth row;
    row.name = channel;
    row.age_s = NAN;
    const auto found = arrivals_.find(channel);
    if (found != arrivals_.end()) {
      const Arrival& arrival = found->second;
      using State = ChannelHealth::State;
      row.count = arrival.count;
      row.age_s = now_s - arrival.last_s;
      row.state = row.age_s > kStale_s  ? State::kStale
                  : row.age_s > kLate_s ? State::kLate
                                        : State::kFresh;
      const double span_s = arrival.last_s - arrival.first_s;
      row.rate_hz = span_s > 0 ? static_cast<double>(arrival.count - 1) / span_s : 0;
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace palace
