#include "engine/trust/approval_verifier.h"

#include <numbers>

namespace palace {
namespace {

using Limits = ApprovalLimits;
constexpr double kTurn_rad = 2 * std::numbers::pi;
constexpr double kUpright_rad = std::numbers::pi / 2 + 1e-5;
constexpr double kFastest_mps = 5;
constexpr double kGroundSlack_m = 5;
constexpr double kGroundRise = 0.6;  ///< per metre of distance: 31 degrees

std::string WhyNoNumber(const Approval& a) {
  if (!a.p_WS.allFinite()) {
    return "The site's position is not a number";
  }
  const std::pair<double, const char*> values[] = {
      {a.approach_heading_rad, "The approach heading is not a number"},
      {a.glide_slope_rad, "The glide slope is not a number"},
      {a.descent_rate_mps, "The descent rate is not a number"},
      {a.clear_radius_m, "The clear radius is not a number"},
      {a.stop_height_m, "The height to stop at is not a number"}};
  for (const auto& [value, words] : values) {
    if (!std::isfinite(value)) {
      return words;
    }
  }
  return {};
}

std::string WhyNotInTime(const Approval& a, Timestamp now) {
  // Compared as integers: stamps of an attacker may be any.
  constexpr auto us = [](double seconds) { return static_cast<std::int64_t>(seconds * 1e6); };
  constexpr std::int64_t kFar_us = std::int64_t{1} << 60;
  for (const Timestamp t : {a.approved_at, a.expires_at}) {
    if (t.us < 0 || t.us > kFar_us) {
      return "Its times are out of range";
    }
  }
  if (a.expires_at <= a.approved_at || now >= a.expires_at) {
    return "Expired";
  }
  if (a.expires_at.us - a.approved_at.us > us(Limits::kLongest_s)) {
    return "Valid for longer than 120 s";
  }
  return a.approved_at.us - now.us > us(Limits::kAhead_s)
             ? "Given more than 1 s ahead of the vehicle's clock"
             : "";
}

std::string WhyOutOfReach(const Approval& a, const VehicleSituation& vehicle) {
  const Eigen::Vector3d away = a.p_WS - vehicle.p_WB;
  const double distance_m = away.head<2>().norm();
  if (distance_m > Limits::kReach_m) {
    return "The site is more than 100 m away";
  }
  if (away.z() < 0) {
    return "The site is above the vehicle";
  }
  if (away.z() > Limits::kDeepest_m) {
    return "The site is more than 100 m below the vehicle";
  }
  const double off_ground_m = std::abs(a.p_WS.z() - vehicle.ground_down_m);
  return std::isfinite(vehicle.ground_down_m) &&
                 off_ground_m > kGroundSlack_m + kGroundRise * distance_m
             ? "The site is not at the height of the ground"
             : "";
}

/// `vehicle_m`: its height above the site.
std::string WhyNoLook(const Approval& a, double vehicle_m) {
  if (!a.IsLook()) {
    return {};
  }
  if (a.stop_height_m < Limits::kLeastStop_m) {
    return "The height to stop at is below 3 m";
  }
  return a.stop_height_m < vehicle_m ? "" : "The height to stop at is above the vehicle";
}

std::string WhyNotFlyable(const Approval& a) {
  if (std::abs(a.approach_heading_rad) > kTurn_rad) {
    return "The approach heading is more than one turn";
  }
  if (!(a.glide_slope_rad > 0 && a.glide_slope_rad <= kUpright_rad)) {
    return "The glide slope is outside 0 to 90 degrees";
  }
  if (!(a.descent_rate_mps > 0 && a.descent_rate_mps <= kFastest_mps)) {
    return "The descent rate is outside 0 to 5 m/s";
  }
  return a.clear_radius_m >= Limits::kLeastRadius_m && a.clear_radius_m <= Limits::kMostRadius_m
             ? ""
             : "The clear radius that is asked for is outside 0.5 to 25 m";
}

std::string WhyUnbound(const Approval& a) {
  if (a.id == 0) {
    return "The approval has no id";
  }
  if (a.site_id == 0) {
    return "The approval names no site";
  }
  const bool bound = a.map_hash != 0 && a.settings_hash != 0 && a.calibration_hash != 0;
  return bound ? "" : "The approval names no map, limits or calibration";
}

/// Its fields as they are sealed, with the seal left out.
std::vector<std::uint8_t> FieldsOf(Approval approval) {
  approval.seal = {};
  return SealedBytes(approval);
}

}  // namespace

std::string WhyNoSense(const Approval& a, const VehicleSituation& vehicle) {
  for (const std::string& why :
       {WhyNoNumber(a), WhyUnbound(a), WhyNotInTime(a, vehicle.now), WhyOutOfReach(a, vehicle),
        WhyNotFlyable(a), WhyNoLook(a, (a.p_WS - vehicle.p_WB).z())}) {
    if (!why.empty()) {
      return why;
    }
  }
  return {};
}

std::string ApprovalVerifier::Judge(const Approval& approval, const VehicleSituation& vehicle,
                                    const std::string& own) const {
  if (approval.vehicle_boot_id != authority_.boot_id()) {
    return "Given for another start of this vehicle";
  }
  std::string why = WhyNoSense(approval, vehicle);
  return why.empty() ? own : why;
}

std::string ApprovalVerifier::Verify(const Approval& approval, const VehicleSituation& vehicle,
                                     const std::string& own) {
  std::string why =
      authority_.Check(SealedChannel::kCommand, SealedBytes(approval), approval.seal, vehicle.now);
  if (!why.empty()) {
    return IsLike(last_refused_, approval) ? refusal_ : why;
  }
  why = Judge(approval, vehicle, own);
  (why.empty() ? last_accepted_ : last_refused_) = FieldsOf(approval);
  refusal_ = why.empty() ? refusal_ : why;
  return why;
}

bool ApprovalVerifier::IsLike(const std::vector<std::uint8_t>& fields,
                              const Approval& approval) const {
  return !fields.empty() && FieldsOf(approval) == fields &&
         (authority_.takes_unsealed() ||
          authority_.IsOfSession(SealedBytes(approval), approval.seal));
}

bool ApprovalVerifier::IsRepeat(const Approval& approval) const {
  return IsLike(last_accepted_, approval);
}

}  // namespace palace
