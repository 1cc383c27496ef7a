#include "engine/wire/lcm_link.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/wire/channel_rules.h"
#include "engine/wire/convert.h"

namespace palace {
namespace {

constexpr double kAnswerPeriod_s = 1;
constexpr double kOwnAbort_s = 1;  ///< an own wave-off that comes back later was played by somebody
constexpr int kMostAtOnce = 1000;  ///< a flood must not keep Poll from returning

/// "APPROVE on COMMAND", for people.
std::string WordsOf(const VehicleMessage& message, const std::string& channel) {
  const char* what = std::holds_alternative<Approval>(message)           ? "APPROVE"
                     : std::holds_alternative<HoldRequest>(message)      ? "HOLD"
                     : std::holds_alternative<GoRequest>(message)        ? "GO"
                     : std::holds_alternative<PositionEstimate>(message) ? "an estimate"
                                                                         : "ABORT (open by design)";
  return what + (" on " + channel);
}

}  // namespace

LcmLink::LcmLink(std::shared_ptr<Bus> bus, ChannelNames channels, StationTrust trust)
    : bus_(std::move(bus)), channels_(channels), outputs_(channels), session_(std::move(trust)) {}

LcmLink::~LcmLink() {
  if (session_.Holds()) {
    SessionRequest request;
    request.kind = SessionRequest::Kind::kRelease;
    VehicleMessage release = request;
    Seal(release);
    Send(release);
  }
}

void LcmLink::Seal(VehicleMessage& message) {
  const std::lock_guard lock(mutex_);
  session_.Seal(message, {newest_us_}, MonotonicSeconds());
}

void LcmLink::Hear(const FrameBundle& bundle) {
  const double now_s = MonotonicSeconds();
  const std::lock_guard lock(mutex_);
  if (bundle.status) {
    session_.HearVehicle(now_s);
    vehicle_since_s_ = vehicle_since_s_.value_or(now_s);
  }
  if (bundle.authority) {
    session_.Hear(*bundle.authority, now_s);
    knows_authority_ = true;
  }
}

AuthorityStatus LcmLink::Authority() const {
  const double now_s = MonotonicSeconds();
  const std::lock_guard lock(mutex_);
  AuthorityStatus status = session_.Status(now_s);
  status.foreign = foreign_;
  status.foreign.age_s = foreign_.count > 0 ? now_s - foreign_s_ : NAN;
  return status;
}

bool LcmLink::IsOwnAbort(std::uint64_t id, double now_s) const {
  return std::any_of(own_aborts_.begin(), own_aborts_.end(), [&](const SentAbort& sent) {
    return sent.id == id && now_s - sent.at_s <= kOwnAbort_s;
  });
}

void LcmLink::Overhear(const WireMessage& message) {
  const double now_s = MonotonicSeconds();
  const Result<VehicleMessage> decoded = DecodeVehicleMessage(message, channels_);
  if (decoded && std::holds_alternative<SessionRequest>(*decoded)) {
    return;  // the vehicle's report tells who asked, and what became of it
  }
  const std::lock_guard lock(mutex_);
  if (decoded) {
    const auto* abort = std::get_if<AbortRequest>(&*decoded);
    const bool own =
        abort != nullptr ? IsOwnAbort(abort->command_id, now_s) : session_.IsOwn(*decoded, now_s);
    const bool judges = abort != nullptr || knows_authority_ ||
                        (vehicle_since_s_ && now_s - *vehicle_since_s_ > kAuthorityWait_s);
    if (own || session_.IsOfHolder(*decoded) || !judges) {
      return;
    }
  }
  ++foreign_.count;
  foreign_.what =
      decoded ? WordsOf(*decoded, message.channel) : "unreadable bytes on " + message.channel;
  foreign_.from = message.sender;
  foreign_s_ = now_s;
}

void LcmLink::KeepSession() {
  std::optional<SessionRequest> request;
  {
    const std::lock_guard lock(mutex_);
    request = session_.Tick({newest_us_}, MonotonicSeconds());
  }
  if (request) {
    Publish(EncodeVehicleMessage(*request, {newest_us_}, channels_));
  }
}

bool LcmLink::Send(const VehicleMessage& message) {
  if (const auto* abort = std::get_if<AbortRequest>(&message)) {
    const std::lock_guard lock(mutex_);
    own_aborts_[aborts_sent_++ % own_aborts_.size()] = {abort->command_id, MonotonicSeconds()};
  }
  // Holds and aborts carry no time of their own: they are stamped with the newest seen.
  if (const auto* estimate = std::get_if<PositionEstimate>(&message)) {
    newest_us_ = estimate->time.us;
    if (estimate->seal.session_id == 0) {
      return true;  // no vehicle takes it, and whoever commands would hear a stranger
    }
  } else if (const auto* approval = std::get_if<Approval>(&message)) {
    newest_us_ = approval->approved_at.us;
  }
  return Publish(EncodeVehicleMessage(message, {newest_us_}, channels_));
}

void LcmLink::Announce(const EngineSnapshot& snapshot) {
  newest_us_ = snapshot.time.us;
  for (const WireMessage& message : outputs_.Encode(snapshot)) {
    Publish(message);
  }
  KeepSession();
}

bool LcmLink::Publish(const WireMessage& message) {
  const bool published = bus_->Publish(message).ok();
  ++(published ? sent_ : unsent_);
  return published;
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
    refusal_ = decoded.error().message;
    AnswerUnread(message);
    return;
  }
  ++received_;
  vehicle_.Send(*decoded);
}

void VehicleServer::AnswerUnread(const WireMessage& message) {
  const double now_s = MonotonicSeconds();
  if (message.channel != channels_.command || now_s - answered_s_ < kAnswerPeriod_s) {
    return;
  }
  answered_s_ = now_s;
  (void)bus_->Publish(EncodeAck({{newest_us_}, 0, AckResult::kRefused, refusal_}, channels_));
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
  return Publish(EncodeBundle(bundle, channels_), bundle.time);
}

Status VehicleServer::Publish(const std::vector<WireMessage>& messages, Timestamp time) {
  newest_us_ = time.us;
  for (const WireMessage& message : messages) {
    const Status published = bus_->Publish(message);
    if (!published) {
      return published;
    }
  }
  return Ok();
}

}  // namespace palace
