#include "engine/wire/lcm_link.h"

#include <utility>

#include "engine/wire/channel_rules.h"
#include "engine/wire/convert.h"

namespace palace {
namespace {
constexpr int kMostAtOnce = 1000;  ///< a flood must not keep Poll from returning
}

LcmLink::LcmLink(std::shared_ptr<Bus> bus, ChannelNames channels)
    : bus_(std::move(bus)), channels_(channels), outputs_(channels) {}

void LcmLink::Send(const VehicleMessage& message) {
  // Holds and aborts carry no time of their own: they are stamped with the newest seen.
  if (const auto* estimate = std::get_if<PositionEstimate>(&message)) {
    newest_us_ = estimate->time.us;
  } else if (const auto* approval = std::get_if<Approval>(&message)) {
    newest_us_ = approval->approved_at.us;
  }
  Publish(EncodeVehicleMessage(message, {newest_us_}, channels_));
}

void LcmLink::Announce(const EngineSnapshot& snapshot) {
  newest_us_ = snapshot.time.us;
  for (const WireMessage& message : outputs_.Encode(snapshot)) {
    Publish(message);
  }
}

void LcmLink::Publish(const WireMessage& message) {
  const Status published = bus_->Publish(message);
  ++(published ? sent_ : unsent_);
}

VehicleServer::VehicleServer(std::shared_ptr<Bus> bus, VehicleLink& vehicle, ChannelNames channels)
    : bus_(std::move(bus)), vehicle_(vehicle), channels_(std::move(channels)) {}

Result<std::unique_ptr<VehicleServer>> VehicleServer::Create(std::shared_ptr<Bus> bus,
                                                             VehicleLink& vehicle,
                                                             ChannelNames channels) {
  std::unique_ptr<VehicleServer> server(
      new VehicleServer(std::move(bus), vehicle, std::move(channels)));
  VehicleServer* self = server.get();
  for (const std::string& channel : self->channels_.ToVehicle()) {
    const Status subscribed = self->bus_->Subscribe(
        channel, [self](const WireMessage& message) { self->Take(message); },
        LimitsOf(self->channels_, channel));
    if (!subscribed) {
      return subscribed.error();
    }
  }
  return server;
}

void VehicleServer::Take(const WireMessage& message) {
  const Result<VehicleMessage> decoded = DecodeVehicleMessage(message, channels_);
  if (!decoded) {
    ++refused_;
    return;
  }
  ++received_;
  vehicle_.Send(*decoded);
}

Status VehicleServer::Poll(int timeout_ms) {
  Result<bool> handled = bus_->Handle(timeout_ms);
  for (int more = kMostAtOnce; handled && *handled && more > 0; --more) {
    handled = bus_->Handle(0);
  }
  if (!handled) {
    return handled.error();
  }
  return Ok();
}

Status VehicleServer::Publish(const FrameBundle& bundle) {
  for (const WireMessage& message : EncodeBundle(bundle, channels_)) {
    const Status published = bus_->Publish(message);
    if (!published) {
      return published;
    }
  }
  return Ok();
}

}  // namespace palace
