#include "engine/wire/convert.h"
#include "engine/wire/session_messages.h"
#include "engine/wire/wire_fields.h"
#include "engine/wire/wire_pack.h"

namespace palace {
namespace {

command_t ApprovalToWire(const Approval& a) {
  command_t m{};
  m.utime = a.seal.sent_at.us;
  m.kind = command_t::APPROVE;
  m.command_id = WireId(a.id);
  m.session_id = WireId(a.seal.session_id);
  m.counter = WireId(a.seal.counter);
  m.site_id = WireId(a.site_id);
  m.map_hash = WireId(a.map_hash);
  m.settings_hash = WireId(a.settings_hash);
  m.calibration_hash = WireId(a.calibration_hash);
  m.vehicle_boot_id = WireId(a.vehicle_boot_id);
  m.approved_utime = a.approved_at.us;
  m.expires_utime = a.expires_at.us;
  m.provisional = a.provisional;
  Pack(a.p_WS, m.site_pos);
  m.approach_heading_rad = a.approach_heading_rad;
  m.glide_slope_rad = a.glide_slope_rad;
  m.descent_rate_mps = a.descent_rate_mps;
  m.clear_radius_m = a.clear_radius_m;
  m.stop_height_m = a.stop_height_m;
  PackBytes(a.seal.mac, m.mac);
  return m;
}

Seal SealFromWire(const command_t& m) {
  return {IdFromWire(m.session_id), IdFromWire(m.counter), {m.utime}, UnpackBytes(m.mac)};
}

/// Numbers that are not finite pass: the vehicle refuses them with the reason.
Result<VehicleMessage> ApprovalFromWire(const command_t& m) {
  Approval a;
  a.id = IdFromWire(m.command_id);
  a.site_id = IdFromWire(m.site_id);
  a.map_hash = IdFromWire(m.map_hash);
  a.settings_hash = IdFromWire(m.settings_hash);
  a.calibration_hash = IdFromWire(m.calibration_hash);
  a.vehicle_boot_id = IdFromWire(m.vehicle_boot_id);
  a.approved_at = {m.approved_utime};
  a.expires_at = {m.expires_utime};
  a.provisional = m.provisional != 0;
  a.p_WS = Unpack(m.site_pos);
  a.approach_heading_rad = m.approach_heading_rad;
  a.glide_slope_rad = m.glide_slope_rad;
  a.descent_rate_mps = m.descent_rate_mps;
  a.clear_radius_m = m.clear_radius_m;
  a.stop_height_m = m.stop_height_m;
  a.seal = SealFromWire(m);
  return VehicleMessage(std::move(a));
}

command_t HoldToWire(const HoldRequest& hold) {
  command_t m{};
  m.utime = hold.seal.sent_at.us;
  m.kind = command_t::HOLD;
  m.command_id = WireId(hold.command_id);
  m.session_id = WireId(hold.seal.session_id);
  m.counter = WireId(hold.seal.counter);
  m.reason = hold.reason;
  PackBytes(hold.seal.mac, m.mac);
  return m;
}

command_t GoToWire(const GoRequest& go) {
  command_t m{};
  m.utime = go.seal.sent_at.us;
  m.kind = command_t::GO;
  m.command_id = WireId(go.command_id);
  m.session_id = WireId(go.seal.session_id);
  m.counter = WireId(go.seal.counter);
  m.vehicle_boot_id = WireId(go.vehicle_boot_id);
  m.expires_utime = go.expires_at.us;
  Pack(go.p_WB, m.site_pos);
  m.approach_heading_rad = go.heading_rad;
  PackBytes(go.seal.mac, m.mac);
  return m;
}

/// Numbers that are not finite pass: the vehicle refuses them with the reason.
GoRequest GoFromWire(const command_t& m) {
  return {IdFromWire(m.command_id), IdFromWire(m.vehicle_boot_id), {m.expires_utime},
          Unpack(m.site_pos),       m.approach_heading_rad,        SealFromWire(m)};
}

Result<VehicleMessage> CommandFromWire(const command_t& m) {
  switch (m.kind) {
    case command_t::APPROVE:
      return ApprovalFromWire(m);
    case command_t::HOLD:
      return VehicleMessage(HoldRequest{IdFromWire(m.command_id), m.reason, SealFromWire(m)});
    case command_t::ABORT:
      return VehicleMessage(AbortRequest{IdFromWire(m.command_id), m.reason});
    case command_t::GO:
      return VehicleMessage(GoFromWire(m));
    default:
      return InvalidError("command kind " + std::to_string(m.kind) + " is not one of 0..3");
  }
}

position_estimate_t EstimateToWire(const PositionEstimate& e) {
  position_estimate_t m{};
  m.utime = e.time.us;
  m.source = static_cast<std::int8_t>(e.source);
  m.healthy = e.healthy;
  m.approval_id = WireId(e.approval_id);
  Pack(e.p_WB, m.pos);
  Pack(e.v_WB, m.vel);
  Pack(e.sigma_p_m, m.sigma_pos);
  Pack(e.sigma_v_mps, m.sigma_vel);
  m.session_id = WireId(e.seal.session_id);
  m.counter = WireId(e.seal.counter);
  PackBytes(e.seal.mac, m.mac);
  return m;
}

Result<VehicleMessage> EstimateFromWire(const position_estimate_t& m) {
  if (m.source < 0 || m.source > 2) {
    return InvalidError("estimate source " + std::to_string(m.source) + " is not one of 0..2");
  }
  PositionEstimate e;
  e.time = {m.utime};
  e.source = static_cast<EstimateSource>(m.source);
  e.healthy = m.healthy != 0;
  e.approval_id = IdFromWire(m.approval_id);
  e.p_WB = Unpack(m.pos);
  e.v_WB = Unpack(m.vel);
  e.sigma_p_m = Unpack(m.sigma_pos);
  e.sigma_v_mps = Unpack(m.sigma_vel);
  e.seal = {IdFromWire(m.session_id), IdFromWire(m.counter), {}, UnpackBytes(m.mac)};
  // An estimate that claims to be fit for flying must be a number; one that does not may say NaN.
  if (e.healthy && !(e.p_WB.allFinite() && e.v_WB.allFinite() && e.sigma_p_m.allFinite() &&
                     e.sigma_v_mps.allFinite())) {
    return InvalidError("a healthy estimate holds a number that is not finite");
  }
  return VehicleMessage(e);
}

}  // namespace

WireMessage EncodeVehicleMessage(const VehicleMessage& message, Timestamp now,
                                 const ChannelNames& channels) {
  if (const auto* approval = std::get_if<Approval>(&message)) {
    return MakeMessage(channels.command, now, ApprovalToWire(*approval));
  }
  if (const auto* estimate = std::get_if<PositionEstimate>(&message)) {
    return MakeMessage(channels.position_estimate, now, EstimateToWire(*estimate));
  }
  if (const auto* hold = std::get_if<HoldRequest>(&message)) {
    return MakeMessage(channels.command, now, HoldToWire(*hold));
  }
  if (const auto* go = std::get_if<GoRequest>(&message)) {
    return MakeMessage(channels.command, now, GoToWire(*go));
  }
  if (const auto* wish = std::get_if<SessionRequest>(&message)) {
    return MakeMessage(channels.session_request, now, SessionRequestToWire(*wish));
  }
  const auto& request = std::get<AbortRequest>(message);
  abort_t m{};
  m.utime = now.us;
  m.command_id = WireId(request.command_id);
  m.reason = request.reason;
  return MakeMessage(channels.abort, now, m);
}

namespace {

Result<VehicleMessage> Read(const WireMessage& message, const ChannelNames& channels) {
  if (message.channel == channels.command) {
    return DecodeAnd<command_t>(message, CommandFromWire);
  }
  if (message.channel == channels.position_estimate) {
    return DecodeAnd<position_estimate_t>(message, EstimateFromWire);
  }
  if (message.channel == channels.session_request) {
    return DecodeAnd<session_request_t>(message, SessionRequestFromWire);
  }
  if (message.channel == channels.abort) {
    return DecodeAnd<abort_t>(message, [](const abort_t& m) -> Result<VehicleMessage> {
      return VehicleMessage(AbortRequest{IdFromWire(m.command_id), m.reason});
    });
  }
  return InvalidError(message.channel + " carries no message to a vehicle; they are on " +
                      channels.command + ", " + channels.position_estimate + ", " +
                      channels.session_request + " and " + channels.abort);
}

}  // namespace

Result<VehicleMessage> DecodeVehicleMessage(const WireMessage& message,
                                            const ChannelNames& channels) {
  Result<VehicleMessage> read = Read(message, channels);
  // Seals speak of what was read. Bytes that mean the same (a field that does not concern the kind,
  // a 2 for true) would be another message under the same seal.
  const bool sealed = read && !std::holds_alternative<AbortRequest>(*read);
  if (sealed && EncodeVehicleMessage(*read, message.time, channels).payload != message.payload) {
    return InvalidError(message.channel + ": a field that must be zero is not");
  }
  return read;
}

}  // namespace palace
