// ApprovalVerifier: the vehicle's side of an approval, for every vehicle alike. A station cannot
// enforce I1, I4, I8 and I9 alone.
//
//   accepted  signed by the station's key, finite, for this start of the vehicle, of the session
//             whose approval was accepted first, with a counter above all accepted ones of its
//             session, and before its expiry: approved_at < expires_at and now < expires_at
//   repeated  the very approval accepted last, once more: its answer was lost on the way. It is
//             answered as accepted and nothing else happens (I8), whatever the time
//   refused   everything else, with the reason; nothing is remembered but the count
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/time.h"
#include "engine/trust/approval.h"

namespace palace {

class ApprovalVerifier {
 public:
  /// `boot_id`: of this start of the vehicle. Without a key no signature is asked for, and as
  /// nothing then tells who speaks, any session may follow any other: for a bench only.
  ApprovalVerifier(std::uint64_t boot_id, std::optional<PublicKey> station_key);

  /// Empty: accepted, and its counter is spent. Otherwise the reason, in words for the operator.
  std::string Verify(const Approval& approval, Timestamp vehicle_now);
  /// What Verify would answer; nothing is remembered.
  std::string WhyRefused(const Approval& approval, Timestamp vehicle_now) const;
  /// Another copy of the approval accepted last. Ask before Verify, which refuses it.
  bool IsRepeat(const Approval& approval) const;
  std::uint64_t boot_id() const { return boot_id_; }
  std::uint64_t refused() const { return refused_; }

 private:
  std::uint64_t boot_id_;
  std::optional<PublicKey> station_key_;
  std::map<std::uint64_t, std::uint64_t> last_counter_;  ///< accepted, per session
  std::vector<std::uint8_t> last_accepted_;              ///< its signed bytes and its signature
  std::uint64_t refused_ = 0;
};

}  // namespace palace
