#include "engine/trust/message_bytes.h"

#include <bit>
#include <string_view>

namespace palace {
namespace {

constexpr std::int8_t kApprove = 0;
constexpr std::int8_t kHold = 1;
constexpr std::int8_t kGo = 3;

/// Fields as LCM sends them.
class Fields {
 public:
  explicit Fields(std::string_view role) {
    Raw("PALACE-2 ");
    Raw(role);
    Raw("\n");
  }
  Fields& Word(std::uint64_t value) { return Big(value, 8); }
  Fields& Time(Timestamp t) { return Word(static_cast<std::uint64_t>(t.us)); }
  Fields& Byte(std::int8_t value) { return Big(static_cast<std::uint8_t>(value), 1); }
  Fields& Real(double value) { return Word(std::bit_cast<std::uint64_t>(value)); }
  Fields& Vector(const Eigen::Vector3d& v) { return Real(v.x()).Real(v.y()).Real(v.z()); }
  Fields& Text(std::string_view text) {
    Big(text.size() + 1, 4);
    Raw(text);
    return Byte(0);
  }
  std::vector<std::uint8_t> Take() { return std::move(out_); }

 private:
  Fields& Big(std::uint64_t value, int bytes) {
    for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8) {
      out_.push_back(static_cast<std::uint8_t>(value >> shift));
    }
    return *this;
  }
  void Raw(std::string_view text) { out_.insert(out_.end(), text.begin(), text.end()); }
  std::vector<std::uint8_t> out_;
};

/// A command_t with all its fields: those that do not concern its kind are 0.
std::vector<std::uint8_t> CommandBytes(std::int8_t kind, const Approval& a, const Seal& seal,
                                       std::string_view reason) {
  return Fields("COMMAND")
      .Time(seal.sent_at)
      .Byte(kind)
      .Word(a.id)
      .Word(seal.session_id)
      .Word(seal.counter)
      .Word(a.site_id)
      .Word(a.map_hash)
      .Word(a.settings_hash)
      .Word(a.calibration_hash)
      .Word(a.vehicle_boot_id)
      .Time(a.approved_at)
      .Time(a.expires_at)
      .Byte(a.provisional ? 1 : 0)
      .Vector(a.p_WS)
      .Real(a.approach_heading_rad)
      .Real(a.glide_slope_rad)
      .Real(a.descent_rate_mps)
      .Real(a.clear_radius_m)
      .Real(a.stop_height_m)
      .Text(reason)
      .Take();
}

}  // namespace

std::vector<std::uint8_t> SealedBytes(const Approval& approval) {
  return CommandBytes(kApprove, approval, approval.seal, "");
}

std::vector<std::uint8_t> SealedBytes(const HoldRequest& hold) {
  Approval blank;
  blank.id = hold.command_id;
  return CommandBytes(kHold, blank, hold.seal, hold.reason);
}

std::vector<std::uint8_t> SealedBytes(const GoRequest& go) {
  Approval blank;
  blank.id = go.command_id;
  blank.vehicle_boot_id = go.vehicle_boot_id;
  blank.expires_at = go.expires_at;
  blank.p_WS = go.p_WB;
  blank.approach_heading_rad = go.heading_rad;
  return CommandBytes(kGo, blank, go.seal, "");
}

std::vector<std::uint8_t> SealedBytes(const PositionEstimate& e) {
  return Fields("POSITION_ESTIMATE")
      .Time(e.time)
      .Byte(static_cast<std::int8_t>(e.source))
      .Byte(e.healthy ? 1 : 0)
      .Word(e.approval_id)
      .Vector(e.p_WB)
      .Vector(e.v_WB)
      .Vector(e.sigma_p_m)
      .Vector(e.sigma_v_mps)
      .Word(e.seal.session_id)
      .Word(e.seal.counter)
      .Take();
}

std::vector<std::uint8_t> SealedBytes(const SessionRequest& r) {
  return Fields("SESSION_REQUEST")
      .Time(r.seal.sent_at)
      .Byte(static_cast<std::int8_t>(r.kind))
      .Word(r.station_id)
      .Text(r.station_name)
      .Word(r.key_id)
      .Word(r.vehicle_boot_id)
      .Word(r.challenge)
      .Word(r.nonce)
      .Word(r.seal.session_id)
      .Word(r.seal.counter)
      .Take();
}

std::vector<std::uint8_t> SealedBytes(const AuthorityReport& r) {
  return Fields("AUTHORITY")
      .Time(r.time)
      .Word(r.boot_id)
      .Byte(r.checks ? 1 : 0)
      .Word(r.challenge)
      .Word(r.session_id)
      .Word(r.station_id)
      .Text(r.station_name)
      .Word(r.key_id)
      .Word(r.station_nonce)
      .Time(r.since)
      .Time(r.heard_at)
      .Word(r.refused_station_id)
      .Text(r.refusal)
      .Take();
}

SecretKey SessionKey(const SecretKey& pair, const SessionFacts& facts) {
  return pair.Derive(Fields("SESSION")
                         .Word(facts.boot_id)
                         .Word(facts.session_id)
                         .Word(facts.station_id)
                         .Word(facts.station_nonce)
                         .Word(facts.challenge)
                         .Take());
}

}  // namespace palace
