// Words about what the vehicle's sensors and clock have against them (wording.h).
#include <cmath>

#include "engine/core/rounding.h"
#include "engine/core/text.h"
#include "engine/mission/limits.h"
#include "engine/mission/wording.h"

namespace palace::words {

std::string ClockStepped(double step_s) {
  return WithNumbers(
      step_s < 0 ? "Vehicle clock stepped back %.1f s" : "Vehicle clock stepped ahead %.1f s",
      std::abs(step_s));
}

std::string ImageTimeOff(const NavigationStatus& navigation) {
  const ImageTime* wrong = navigation.WrongImageTime();
  if (wrong == nullptr) {
    return {};
  }
  const bool both = navigation.image_time_left.off() && navigation.image_time_right.off();
  const char* camera = both                                   ? "both cameras"
                       : wrong == &navigation.image_time_left ? "the left camera"
                                                              : "the right camera";
  return WithNumbers("Image time off by %.0f ms against attitude: pictures of ",
                     1000 * std::abs(wrong->offset_s)) +
         camera + (wrong->offset_s > 0 ? " are late" : " are early");
}

namespace {

/// What was off, and has to agree `times` in a row before it is believed: its figure may be within
/// the limit by now, or not be known.
std::string MustAgree(const std::string& what, int times, const std::string& of,
                      const std::string& now) {
  return what + WithNumbers(" for %.0f ", times) + of + " again: " + now;
}

}  // namespace

std::string GravityOff(const GravityAgreement& gravity) {
  if (!gravity.off) {
    return {};
  }
  const std::string limit = ", limit " + LimitWords({GravityAgreement::kLimit_deg, "°"});
  const std::string other = " (or the accelerometer errs)";
  return gravity.tilt_deg > GravityAgreement::kLimit_deg
             ? WithNumbers("Attitude is %.1f° off gravity",
                           ShownBeyond(gravity.tilt_deg, GravityAgreement::kLimit_deg, 1)) +
                   limit + other
             : MustAgree(
                   "Attitude must agree with gravity", GravityAgreement::kFineFixes, "fixes",
                   (std::isfinite(gravity.tilt_deg) ? WithNumbers("%.1f° off now", gravity.tilt_deg)
                                                    : "not known now") +
                       limit + other);
}

std::string GpsOff(const GpsAgreement& gps) {
  if (!gps.off) {
    return {};
  }
  if (gps.drifts) {
    return "GPS drifts against its own velocity by more than " +
           LimitWords({GpsAgreement::kDrift_m, "m in 5 s"});
  }
  const std::string limit = ", limit " + LimitWords({GpsAgreement::kJump_m, "m"});
  return gps.off_m > GpsAgreement::kJump_m
             ? WithNumbers("GPS is %.1f m off the inertial prediction",
                           ShownBeyond(gps.off_m, GpsAgreement::kJump_m, 1)) +
                   limit
             : MustAgree("GPS must agree with the inertial prediction", GpsAgreement::kFineFixes,
                         "fixes",
                         (std::isfinite(gps.off_m) ? WithNumbers("%.1f m off now", gps.off_m)
                                                   : "not compared now") +
                             limit);
}

std::string LaserFault(const LaserHealth& laser) {
  using State = LaserHealth::State;
  switch (laser.state) {
    case State::kLost:
      return WithNumbers("Laser lost for %.1f s, limit ", laser.since_s) +
             LimitWords({LaserHealth::kLost_s, "s"});
    case State::kStuck:
      return WithNumbers("Laser repeats its range for %.1f s, limit ", laser.since_s) +
             LimitWords({LaserHealth::kStuck_s, "s"});
    case State::kWrong: {
      const bool within = std::abs(laser.ratio - 1) <= LaserHealth::kWrong;
      const std::string reads =
          WithNumbers("%.2f of the height that stereo and motion show, limit ", laser.ratio) +
          WithNumbers("%.2f to %.2f", 1 - LaserHealth::kWrong, 1 + LaserHealth::kWrong);
      return within ? MustAgree("Laser must agree" +
                                    WithNumbers(" within %.0f %%", 100 * LaserHealth::kAgrees),
                                LaserHealth::kFinePairs, "pairs", "reads " + reads)
                    : "Laser reads " + reads;
    }
    case State::kNever:
      return "Laser not heard";
    case State::kFine:
      return {};
  }
  return {};
}

}  // namespace palace::words
