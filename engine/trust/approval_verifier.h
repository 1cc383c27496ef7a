// ApprovalVerifier: what every vehicle demands of an approval before it obeys (I1, I4, I8, I9),
// besides what it can fly itself. A station cannot enforce these alone.
//
//   accepted  sealed in the session that commands, for this start of the vehicle, every number
//             finite and of sense (the table below), and before its expiry
//   repeated  the approval accepted last, once more or sealed anew: its answer was lost on the
//             way. It is answered as accepted and nothing else happens (I8), whatever the time
//   refused   everything else, with the reason; a copy of it is refused for the same
//
// What is sealed is judged once: its counter is spent whatever the answer, so nobody can play a
// refused approval again when what spoke against it is over.
//
//   expires_at           after approved_at, by at most kLongest_s; the vehicle's now is before it
//   approved_at          at most kAhead_s ahead of the vehicle's clock
//   site                 at most kReach_m away horizontally, not above the vehicle, at most
//                        kDeepest_m below it, and within 5 m + 0.6 of the distance of the ground's
//                        height below the vehicle, where that is known
//   approach             heading within one turn, glide slope 0 to 90 degrees, rate up to 5 m/s
//   clear radius         kLeastRadius_m to kMostRadius_m
//   height to stop at    0, or from kLeastStop_m up to below the vehicle
//   id, site and hashes  not 0
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/model/approval_limits.h"
#include "engine/trust/vehicle_authority.h"

namespace palace {

/// Where the vehicle is, by its own solution, when the approval arrives.
struct VehicleSituation {
  Timestamp now;
  Eigen::Vector3d p_WB = Eigen::Vector3d::Zero();
  double ground_down_m = NAN;  ///< of the ground below it, W's down axis; NaN: not known
};

/// What speaks against the numbers of an approval; empty when nothing does.
std::string WhyNoSense(const Approval& approval, const VehicleSituation& vehicle);

class ApprovalVerifier {
 public:
  /// `authority` outlives it. Where it takes unsealed messages, seals are not asked for.
  explicit ApprovalVerifier(VehicleAuthority& authority) : authority_(authority) {}

  /// Empty: accepted. Otherwise the reason, in words for the operator. `own` is what the vehicle
  /// itself has against it, told to nobody but who commands; empty: nothing.
  std::string Verify(const Approval& approval, const VehicleSituation& vehicle,
                     const std::string& own = {});
  /// The approval accepted last, once more. Ask before Verify, which refuses it.
  bool IsRepeat(const Approval& approval) const;

 private:
  std::string Judge(const Approval& approval, const VehicleSituation& vehicle,
                    const std::string& own) const;
  /// Sealed in the session that commands, and with the fields of that one.
  bool IsLike(const std::vector<std::uint8_t>& fields, const Approval& approval) const;

  VehicleAuthority& authority_;
  std::vector<std::uint8_t> last_accepted_;  ///< its fields, without the seal
  std::vector<std::uint8_t> last_refused_;
  std::string refusal_;  ///< of last_refused_
};

}  // namespace palace
