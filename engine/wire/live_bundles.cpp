#include "engine/wire/live_bundles.h"

#include <algorithm>
#include <utility>

#include "engine/core/plain_text.h"

namespace palace {
namespace {

constexpr std::pair<std::string ChannelNames::*, ChannelId> kWatched[] = {
    {&ChannelNames::camera_left, ChannelId::kCameraLeft},
    {&ChannelNames::camera_right, ChannelId::kCameraRight},
    {&ChannelNames::vehicle_pose, ChannelId::kVehiclePose},
    {&ChannelNames::imu, ChannelId::kImu},
    {&ChannelNames::gps, ChannelId::kGps},
    {&ChannelNames::laser_range, ChannelId::kLaserRange},
    {&ChannelNames::vehicle_status, ChannelId::kVehicleStatus}};

constexpr auto kLeft = static_cast<std::size_t>(ChannelId::kCameraLeft);
constexpr auto kRight = static_cast<std::size_t>(ChannelId::kCameraRight);

}  // namespace

LiveBundles::LiveBundles(ChannelNames channels, bool follow_simulation)
    : channels_(std::move(channels)),
      follow_simulation_(follow_simulation),
      assembler_(channels_, {.drop_repeated = true,
                             .accepts = [this](const std::string& channel, Timestamp stamp) {
                               return Accepts(channel, stamp);
                             }}) {}

bool LiveBundles::Accepts(const std::string& channel, Timestamp stamp) {
  if (channel == channels_.authority || channel == channels_.truth) {
    return clock_.CanBe(stamp, taken_s_);  // no measurements: no word in what time it is
  }
  // These two come often, and a vehicle without them cannot be flown to a site.
  const bool votes = channel == channels_.vehicle_pose || channel == channels_.vehicle_status;
  const VehicleClock::Heard heard = clock_.Hear(stamp, taken_s_, votes);
  stepped_ = heard == VehicleClock::Heard::kStepped;
  return heard == VehicleClock::Heard::kFits;
}

void LiveBundles::Take(const WireMessage& message, double now_s) {
  stepped_ = false;
  taken_s_ = now_s;
  for (auto& bundle : assembler_.Push(message)) {
    MakeReady(std::move(bundle));
  }
  if (stepped_) {
    StartAnewAfterStep();
  }
}

/// What is pending is of the time before; an empty bundle that begins anew parts it from the rest.
void LiveBundles::StartAnewAfterStep() {
  stepped_s_ += clock_.step_s();
  MakeReady(assembler_.TakePending({}));
  assembler_.Reset();
  auto first = std::make_shared<FrameBundle>();
  first->discontinuity = true;
  first->rig = assembler_.rig();
  MakeReady(std::move(first));
}

void LiveBundles::MakeReady(std::shared_ptr<const FrameBundle> bundle) {
  if (ready_) {
    JoinedBundle joined = Join(*ready_, *bundle);
    joined_.pairs_replaced += joined.pair_replaced ? 1 : 0;
    joined_.samples_overflowed += joined.samples_dropped;
    bundle = std::move(joined.bundle);
  }
  ready_ = std::move(bundle);
}

void LiveBundles::NoteOverflow(const BusTraffic& traffic) {
  for (const ChannelTraffic& channel : traffic.channels) {
    for (const auto& [name, id] : kWatched) {
      if (channels_.*name == channel.channel) {
        overflowed_[static_cast<std::size_t>(id)] = channel.overflowed;
      }
    }
  }
}

std::shared_ptr<const FrameBundle> LiveBundles::HandOn(double now_s) {
  auto bundle = std::make_shared<FrameBundle>(ready_ ? *std::exchange(ready_, nullptr)
                                                     : *assembler_.TakePending({}));
  bundle->sequence = sequence_++;
  for (CommandAck& ack : bundle->acks) {
    ack.reason = PlainText(ack.reason, kLongestReason);  // anybody's words, to be read by people
  }
  for (std::size_t i = 0; i < kChannelCount; ++i) {
    bundle->arrival.overtaken[i] += static_cast<int>(overflowed_[i] - overflow_told_[i]);
  }
  overflow_told_ = overflowed_;
  if (bundle->status) {
    clock_.FollowSimulation(follow_simulation_ && bundle->status->simulated);
  }
  // The vehicle's clock is not known before its first message.
  bundle->time = clock_.known() ? clock_.At(now_s) : Timestamp{};
  if (last_time_ && !bundle->discontinuity) {
    bundle->time = std::max(bundle->time, *last_time_);
  }
  bundle->arrival.clock = {.station_s = now_s,
                           .estimating = clock_.estimating(),
                           .drift_ppm = clock_.drift_ppm(),
                           .jitter_s = clock_.jitter_s(),
                           .stepped_s = std::exchange(stepped_s_, 0),
                           .stalled_s = std::exchange(stalled_s_, 0)};
  if (clock_.known()) {
    last_time_ = bundle->time;
  }
  return bundle;
}

Losses LiveBundles::Count() const {
  const AssemblerReport& report = assembler_.report();
  Losses losses = joined_;
  losses.pictures_unpaired = report.pictures_unpaired;
  losses.pairs_without_rig = report.pairs_without_rig;
  losses.bundles_missing = report.bundles_lost;
  losses.samples_missing = report.samples_lost;
  losses.samples_overflowed += report.samples_overflowed;
  for (std::size_t i = 0; i < kChannelCount; ++i) {
    losses.samples_overflowed += i == kLeft || i == kRight ? 0 : overflowed_[i];
  }
  losses.pairs_replaced += std::max(overflowed_[kLeft], overflowed_[kRight]);
  losses.undecodable = report.undecodable_of;
  losses.other_version = report.other_version_of;
  losses.stamps_refused = report.stamps_refused;
  losses.repeated = report.repeated;
  return losses;
}

}  // namespace palace
