#include "engine/trust/vehicle_authority.h"

#include <cstdio>
#include <utility>

#include "engine/core/plain_text.h"

namespace palace {
namespace {

std::string Seconds(double seconds) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f s", seconds);
  return text;
}

bool IsPlain(const std::string& name) {
  return !name.empty() && PlainText(name, kLongestName) == name;
}

}  // namespace

VehicleAuthority::VehicleAuthority(VehicleTrust trust)
    : trust_(std::move(trust)), challenge_(trust_.random_word()) {}

const SecretKey* VehicleAuthority::FindKey(std::uint64_t id) const {
  for (const SecretKey& key : trust_.keys) {
    if (key.id() == id) {
      return &key;
    }
  }
  return nullptr;
}

std::string VehicleAuthority::Grant(const SessionRequest& request, Timestamp now) {
  const SecretKey* pair = FindKey(request.key_id);
  if (pair == nullptr) {
    return "This vehicle has no key " + FingerprintText(request.key_id);
  }
  if (!pair->Verify(SealedBytes(request), request.seal.mac)) {
    return "The request is not sealed by its key";
  }
  if (request.vehicle_boot_id != trust_.boot_id) {
    return "Asked of another start of this vehicle";
  }
  if (request.challenge != challenge_) {
    return "The request is an old one";
  }
  if (request.station_id == 0 || !IsPlain(request.station_name)) {
    return "The station has no name";
  }
  const bool take_over = request.kind == SessionRequest::Kind::kTakeOver;
  if (session_ && !take_over) {
    const double silent_s = SecondsBetween(session_->told.heard_at, now);
    if (silent_s <= kSilent_s) {
      return session_->told.station_name + " commands, heard " + Seconds(silent_s) + " ago";
    }
  }
  AuthorityReport told;
  told.session_id = trust_.random_word();
  told.station_id = request.station_id;
  told.station_name = request.station_name;
  told.key_id = request.key_id;
  told.station_nonce = request.nonce;
  told.since = told.heard_at = now;
  const SessionFacts facts{trust_.boot_id, told.session_id, told.station_id, request.nonce,
                           challenge_};
  session_ = Session{*pair, SessionKey(*pair, facts), std::move(told), {}};
  challenge_ = trust_.random_word();
  return {};
}

VehicleAuthority::Answer VehicleAuthority::Take(const SessionRequest& request, Timestamp now) {
  using Kind = SessionRequest::Kind;
  if (request.kind == Kind::kKeep || request.kind == Kind::kRelease) {
    if (!Check(SealedChannel::kSession, SealedBytes(request), request.seal, now).empty() ||
        !session_) {
      return Answer::kRefused;
    }
    if (request.kind == Kind::kKeep) {
      return Answer::kKept;
    }
    session_.reset();
    challenge_ = trust_.random_word();
    news_ = true;
    return Answer::kReleased;
  }
  if (session_ && session_->told.station_id == request.station_id &&
      session_->told.station_nonce == request.nonce) {
    return Answer::kKept;  // another copy of the request that was granted
  }
  refusal_ = Grant(request, now);
  refused_station_id_ = refusal_.empty() ? 0 : request.station_id;
  news_ = true;
  return refusal_.empty() ? Answer::kGranted : Answer::kRefused;
}

bool VehicleAuthority::IsOfSession(std::span<const std::uint8_t> bytes, const Seal& seal) const {
  return session_ && session_->key.Verify(bytes, seal.mac) &&
         seal.session_id == session_->told.session_id;
}

std::string VehicleAuthority::WhyRefused(SealedChannel channel, std::span<const std::uint8_t> bytes,
                                         const Seal& seal) const {
  if (trust_.takes_unsealed) {
    return {};
  }
  if (!session_) {
    return "No station commands this vehicle; ask for command first";
  }
  if (!session_->key.Verify(bytes, seal.mac)) {
    return seal.session_id == 0 ? "Not sealed" : "Seal does not match";
  }
  if (seal.session_id != session_->told.session_id) {
    return "Of another session";
  }
  if (seal.counter <= session_->counters[static_cast<std::size_t>(channel)]) {
    return "Counter " + std::to_string(seal.counter) + " was already used";
  }
  return {};
}

std::string VehicleAuthority::Check(SealedChannel channel, std::span<const std::uint8_t> bytes,
                                    const Seal& seal, Timestamp now) {
  std::string why = WhyRefused(channel, bytes, seal);
  if (why.empty() && session_ && !trust_.takes_unsealed) {
    session_->counters[static_cast<std::size_t>(channel)] = seal.counter;
    session_->told.heard_at = now;
  }
  return why;
}

AuthorityReport VehicleAuthority::Report(Timestamp now) const {
  AuthorityReport report = session_ ? session_->told : AuthorityReport{};
  report.time = now;
  report.boot_id = trust_.boot_id;
  report.checks = !trust_.takes_unsealed;
  report.challenge = challenge_;
  report.refused_station_id = refused_station_id_;
  report.refusal = refusal_;
  if (session_) {
    report.mac = session_->pair.Sign(SealedBytes(report));
  }
  return report;
}

bool VehicleAuthority::TakeNews() { return std::exchange(news_, false); }

}  // namespace palace
