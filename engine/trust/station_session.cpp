#include "engine/trust/station_session.h"

#include <algorithm>
#include <utility>

#include "engine/core/plain_text.h"
#include "engine/trust/vehicle_authority.h"

namespace palace {
namespace {

constexpr double kPeriod_s = 0.5;
/// A network may deliver a datagram twice; a copy that comes later was played by somebody.
constexpr double kCopies_s = 1;
/// A vehicle that reports nobody for this long grants no sessions.
constexpr double kNoGrant_s = 3;
/// An answer comes within a second or two; a request goes out twice a second at most.
constexpr std::size_t kMostAsked = 4;

}  // namespace

StationSession::StationSession(StationTrust trust) : trust_(std::move(trust)) {}

bool StationSession::Holds() const {
  return granted_ && report_ && report_proven_ && report_->boot_id == granted_->boot_id &&
         report_->session_id == granted_->session_id && report_->station_id == trust_.station_id;
}

void StationSession::HearVehicle(double now_s) {
  if (!vehicle_since_s_) {
    vehicle_since_s_ = now_s;
  }
}

void StationSession::Hear(const AuthorityReport& report, double now_s) {
  const bool proven = trust_.key && report.session_id != 0 && report.key_id == trust_.key->id();
  if (proven && !trust_.key->Verify(SealedBytes(report), report.mac)) {
    return;
  }
  if (IsDoubtful(report, proven, now_s) || !IsNews(report, proven)) {
    return;
  }
  const bool restarted = report_ && report_->boot_id != report.boot_id;
  wants_ = wants_ || (restarted && Holds());
  report_ = report;
  report_proven_ = proven;
  report_s_ = now_s;
  const bool is_ours = report.session_id != 0 && report.station_id == trust_.station_id;
  const auto granted = std::find_if(asked_.begin(), asked_.end(), [&](const SessionRequest& asked) {
    return asked.nonce == report.station_nonce;
  });
  if (is_ours && proven && granted != asked_.end()) {
    TakeGrant(report, *granted, now_s);
  } else if (report.session_id != 0 && !is_ours) {
    // Who sees another command asks no more unless a person says so; one refusal is enough.
    wants_ = take_over_ && report.refused_station_id != trust_.station_id;
    take_over_ = wants_;
  }
}

bool StationSession::IsDoubtful(const AuthorityReport& report, bool proven, double now_s) const {
  // Who gave command back waits to hear it from a vehicle that then seals nothing.
  const bool sure = Holds() && wants_ && now_s - report_s_ <= kSure_s;
  return sure && !(proven && report.boot_id == granted_->boot_id);
}

bool StationSession::IsNews(const AuthorityReport& report, bool proven) {
  // What anybody could have sent may not make deaf to what only the vehicle can have sent.
  if (proven) {
    const auto [newest, first] = proven_to_.try_emplace(report.boot_id, report.time);
    const bool news = first || report.time > newest->second;
    newest->second = std::max(newest->second, report.time);
    return news;
  }
  if (unproven_to_.boot_id == report.boot_id && report.time <= unproven_to_.time) {
    return false;
  }
  unproven_to_ = {report.boot_id, report.time};
  return true;
}

void StationSession::TakeGrant(const AuthorityReport& report, const SessionRequest& asked,
                               double now_s) {
  const SessionFacts facts{report.boot_id, report.session_id, trust_.station_id, asked.nonce,
                           asked.challenge};
  before_ = std::exchange(granted_, std::nullopt);
  granted_s_ = now_s;
  granted_ = Granted{SessionKey(*trust_.key, facts), report.boot_id, report.session_id, {}};
  heard_.clear();
  heard_to_ = {};
  asked_.clear();
  wants_ = true;
  take_over_ = false;
}

void StationSession::MakeRequest(SessionRequest& request) {
  using Kind = SessionRequest::Kind;
  request.station_id = trust_.station_id;
  request.station_name = trust_.station_name;
  request.key_id = trust_.key ? trust_.key->id() : 0;
  request.vehicle_boot_id = report_ ? report_->boot_id : 0;
  if (request.kind == Kind::kAsk || request.kind == Kind::kTakeOver) {
    request.challenge = report_ ? report_->challenge : 0;
    // Asked again before the answer came: the same request, so that whichever copy is granted
    // counts.
    const auto before =
        std::find_if(asked_.begin(), asked_.end(), [&](const SessionRequest& asked) {
          return asked.challenge == request.challenge &&
                 asked.vehicle_boot_id == request.vehicle_boot_id;
        });
    const bool again = before != asked_.end();
    request.nonce = again ? before->nonce : trust_.random_word();
    if (trust_.key) {
      request.seal.mac = trust_.key->Sign(SealedBytes(request));
    }
    if (!again) {
      asked_.push_back(request);
    }
    if (asked_.size() > kMostAsked) {
      asked_.pop_front();
    }
  }
}

std::optional<SessionRequest> StationSession::Tick(Timestamp vehicle_now, double now_s) {
  using Kind = SessionRequest::Kind;
  if (!trust_.key || !report_ || now_s - sent_s_ < kPeriod_s) {
    return std::nullopt;
  }
  SessionRequest request;
  if (Holds()) {
    request.kind = wants_ ? Kind::kKeep : Kind::kRelease;  // given back, and not yet heard so
  } else if (wants_ &&
             (take_over_ || report_->session_id == 0 || report_->station_id == trust_.station_id)) {
    request.kind = take_over_ ? Kind::kTakeOver : Kind::kAsk;
  } else {
    return std::nullopt;
  }
  VehicleMessage message = request;
  Seal(message, vehicle_now, now_s);
  return std::get<SessionRequest>(message);
}

template <typename Message>
void StationSession::SealOne(SealedChannel channel, Message& message, Timestamp vehicle_now) {
  if (!Holds()) {
    return;
  }
  message.seal.session_id = granted_->session_id;
  message.seal.counter = ++granted_->counters[static_cast<std::size_t>(channel)];
  message.seal.sent_at = vehicle_now;
  message.seal.mac = granted_->key.Sign(SealedBytes(message));
}

void StationSession::Seal(VehicleMessage& message, Timestamp vehicle_now, double now_s) {
  using Kind = SessionRequest::Kind;
  if (auto* approval = std::get_if<Approval>(&message)) {
    SealOne(SealedChannel::kCommand, *approval, vehicle_now);
  } else if (auto* hold = std::get_if<HoldRequest>(&message)) {
    SealOne(SealedChannel::kCommand, *hold, vehicle_now);
  } else if (auto* go = std::get_if<GoRequest>(&message)) {
    SealOne(SealedChannel::kCommand, *go, vehicle_now);
  } else if (auto* estimate = std::get_if<PositionEstimate>(&message)) {
    SealOne(SealedChannel::kEstimate, *estimate, vehicle_now);
  } else if (auto* request = std::get_if<SessionRequest>(&message)) {
    request->seal = {};
    request->seal.sent_at = vehicle_now;
    MakeRequest(*request);
    if (request->kind == Kind::kKeep || request->kind == Kind::kRelease) {
      SealOne(SealedChannel::kSession, *request, vehicle_now);
    }
    wants_ = request->kind != Kind::kRelease;
    take_over_ = request->kind == Kind::kTakeOver;
    sent_s_ = now_s;
  }
}

bool StationSession::IsOf(const std::optional<Granted>& session, std::uint64_t session_id,
                          const std::vector<std::uint8_t>& bytes, const Mac& mac) const {
  return session && session->session_id == session_id && session->key.Verify(bytes, mac);
}

template <typename Message>
bool StationSession::IsOwnSealed(SealedChannel channel, const Message& message, double now_s) {
  const std::vector<std::uint8_t> bytes = SealedBytes(message);
  const std::uint64_t session_id = message.seal.session_id;
  if (!IsOf(granted_, session_id, bytes, message.seal.mac)) {
    return now_s - granted_s_ <= kCopies_s && IsOf(before_, session_id, bytes, message.seal.mac);
  }
  std::uint64_t& newest = heard_to_[static_cast<std::size_t>(channel)];
  if (message.seal.counter > newest) {
    newest = message.seal.counter;
    heard_.push_back({channel, newest, now_s});
    while (now_s - heard_.front().at_s > kCopies_s) {
      heard_.pop_front();
    }
    return true;
  }
  return std::any_of(heard_.begin(), heard_.end(), [&](const HeardOnce& once) {
    return once.channel == channel && once.counter >= message.seal.counter &&
           now_s - once.at_s <= kCopies_s;
  });
}

bool StationSession::IsOwn(const VehicleMessage& message, double now_s) {
  if (const auto* approval = std::get_if<Approval>(&message)) {
    return IsOwnSealed(SealedChannel::kCommand, *approval, now_s);
  }
  if (const auto* hold = std::get_if<HoldRequest>(&message)) {
    return IsOwnSealed(SealedChannel::kCommand, *hold, now_s);
  }
  if (const auto* go = std::get_if<GoRequest>(&message)) {
    return IsOwnSealed(SealedChannel::kCommand, *go, now_s);
  }
  if (const auto* estimate = std::get_if<PositionEstimate>(&message)) {
    return IsOwnSealed(SealedChannel::kEstimate, *estimate, now_s);
  }
  const auto* request = std::get_if<SessionRequest>(&message);
  return request != nullptr && request->station_id == trust_.station_id;
}

bool StationSession::IsOfHolder(const VehicleMessage& message) const {
  if (!report_ || report_->session_id == 0 || report_->station_id == trust_.station_id) {
    return false;
  }
  const std::uint64_t session = std::visit(
      [](const auto& one) -> std::uint64_t {
        if constexpr (requires { one.seal; }) {
          return one.seal.session_id;
        }
        return 0;
      },
      message);
  return session == report_->session_id;
}

std::string StationSession::WhyNot() const {
  if (Holds()) {
    return {};
  }
  if (!trust_.key) {
    return trust_.no_key_why;
  }
  if (!report_) {
    return vehicle_since_s_ ? "The vehicle grants no session" : "No vehicle was heard";
  }
  if (report_->refused_station_id == trust_.station_id && !report_->refusal.empty() &&
      report_->session_id == 0) {
    return "The vehicle refuses this station: " + QuotedText(report_->refusal, kLongestReason);
  }
  if (report_->session_id != 0 && report_->station_id != trust_.station_id) {
    return "Station " + QuotedText(report_->station_name, kLongestName) + " commands this vehicle";
  }
  return wants_ ? "Command was asked for, the vehicle has not answered"
                : "This station gave command back: ask for it again";
}

AuthorityStatus StationSession::Status(double now_s) const {
  using Standing = AuthorityStanding;
  AuthorityStatus status;
  status.why_not = WhyNot();
  status.key_name = trust_.key_name;
  status.fingerprint = trust_.key ? FingerprintText(trust_.key->id()) : "";
  const bool commanded = report_ && report_->session_id != 0;
  if (commanded) {
    status.holder =
        PlainText(report_->station_name, kLongestName) + " " + FingerprintText(report_->key_id);
    status.holder_silent_s = SecondsBetween(report_->heard_at, report_->time) + (now_s - report_s_);
    status.holder_is_silent =
        SecondsBetween(report_->heard_at, report_->time) > VehicleAuthority::kSilent_s;
  }
  const bool refused = report_ && report_->refused_station_id == trust_.station_id;
  status.refusal = refused ? PlainText(report_->refusal, kLongestReason) : "";
  const bool other = commanded && report_->station_id != trust_.station_id;
  const bool silent = !report_ && vehicle_since_s_ && now_s - *vehicle_since_s_ > kNoGrant_s;
  status.standing = Holds()       ? Standing::kHeld
                    : !trust_.key ? Standing::kNoKey
                    : silent      ? Standing::kNoGrant
                    : other       ? Standing::kOther
                    : !wants_     ? Standing::kReleased
                                  : Standing::kAsking;
  status.can_ask = trust_.key && report_ && !Holds();
  return status;
}

}  // namespace palace
