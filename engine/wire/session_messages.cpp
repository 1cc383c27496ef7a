#include "engine/wire/session_messages.h"

#include "engine/wire/wire_fields.h"
#include "engine/wire/wire_pack.h"

namespace palace {

session_request_t SessionRequestToWire(const SessionRequest& request) {
  session_request_t m{};
  m.utime = request.seal.sent_at.us;
  m.kind = static_cast<std::int8_t>(request.kind);
  m.station_id = WireId(request.station_id);
  m.station_name = request.station_name;
  m.key_id = WireId(request.key_id);
  m.vehicle_boot_id = WireId(request.vehicle_boot_id);
  m.challenge = WireId(request.challenge);
  m.nonce = WireId(request.nonce);
  m.session_id = WireId(request.seal.session_id);
  m.counter = WireId(request.seal.counter);
  PackBytes(request.seal.mac, m.mac);
  return m;
}

Result<VehicleMessage> SessionRequestFromWire(const session_request_t& m) {
  if (m.kind < session_request_t::ASK || m.kind > session_request_t::RELEASE) {
    return InvalidError("session request kind " + std::to_string(m.kind) + " is not one of 0..3");
  }
  SessionRequest request;
  request.kind = static_cast<SessionRequest::Kind>(m.kind);
  request.station_id = IdFromWire(m.station_id);
  request.station_name = m.station_name;
  request.key_id = IdFromWire(m.key_id);
  request.vehicle_boot_id = IdFromWire(m.vehicle_boot_id);
  request.challenge = IdFromWire(m.challenge);
  request.nonce = IdFromWire(m.nonce);
  request.seal = {IdFromWire(m.session_id), IdFromWire(m.counter), {m.utime}, UnpackBytes(m.mac)};
  return VehicleMessage(std::move(request));
}

authority_t AuthorityToWire(const AuthorityReport& report) {
  authority_t m{};
  m.utime = report.time.us;
  m.boot_id = WireId(report.boot_id);
  m.checks = report.checks;
  m.challenge = WireId(report.challenge);
  m.session_id = WireId(report.session_id);
  m.station_id = WireId(report.station_id);
  m.station_name = report.station_name;
  m.key_id = WireId(report.key_id);
  m.station_nonce = WireId(report.station_nonce);
  m.since_utime = report.since.us;
  m.heard_utime = report.heard_at.us;
  m.refused_station_id = WireId(report.refused_station_id);
  m.refusal = report.refusal;
  PackBytes(report.mac, m.mac);
  return m;
}

Result<AuthorityReport> AuthorityFromWire(const WireMessage& message) {
  return DecodeAnd<authority_t>(message, [](const authority_t& m) -> Result<AuthorityReport> {
    if (!IsBoolean(m.checks)) {
      return InvalidError("a vehicle checks seals or not");
    }
    AuthorityReport report;
    report.time = {m.utime};
    report.boot_id = IdFromWire(m.boot_id);
    report.checks = m.checks != 0;
    report.challenge = IdFromWire(m.challenge);
    report.session_id = IdFromWire(m.session_id);
    report.station_id = IdFromWire(m.station_id);
    report.station_name = m.station_name;
    report.key_id = IdFromWire(m.key_id);
    report.station_nonce = IdFromWire(m.station_nonce);
    report.since = {m.since_utime};
    report.heard_at = {m.heard_utime};
    report.refused_station_id = IdFromWire(m.refused_station_id);
    report.refusal = m.refusal;
    report.mac = UnpackBytes(m.mac);
    return report;
  });
}

}  // namespace palace
