// What the vehicle demands of an approval before it moves: the last check before flight.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>

#include "engine/model/vehicle_message.h"

namespace palace {

class ApprovalGate {
 public:
  using Check = std::function<std::string(const Approval&, Timestamp now, std::uint64_t boot_id)>;

  /// `signature_check` may be empty: then nothing is signed.
  ApprovalGate(std::uint64_t boot_id, Check signature_check);

  /// Empty: accepted, and its counter is spent. Otherwise the reason of the refusal. Demands finite
  /// numbers, a glide slope of 15 to 90 degrees, a descent rate of 0.1 to 1.5 m/s, a site within
  /// 100 m, this boot, vehicle time before the expiry, a counter above every accepted one of its
  /// session, and the signature.
  std::string Admit(const Approval& approval, Timestamp now, const Eigen::Vector3d& p_WB);

 private:
  std::uint64_t boot_id_;
  Check signature_check_;
  std::map<std::uint64_t, std::uint64_t> last_counter_;  ///< per session
};

}  // namespace palace
