// Words about what the vehicle's sensors and clock have against them (wording.h).
#include <cmath>

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

std::string GravityOff(const GravityAgreement& gravity) {
  if (!gravity.off) {
    return {};
  }
  const std::string by =
      std::isfinite(gravity.tilt_deg) ? WithNumbers("%.1f° ", gravity.tilt_deg) : "";
  return "Attitude is " + by + "off gravity, limit " +
         LimitWords({GravityAgreement::kLimit_deg, "°"}) + " (or the accelerometer errs)";
}

std::string GpsOff(const GpsAgreement& gps) {
  if (!gps.off) {
    return {};
  }
  return gps.drifts ? "GPS drifts against its own velocity by more than " +
                          LimitWords({GpsAgreement::kDrift_m, "m in 5 s"})
                    : WithNumbers("GPS is %.1f m off the inertial prediction, limit ", gps.off_m) +
                          LimitWords({GpsAgreement::kJump_m, "m"});
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
    case State::kWrong:
      return WithNumbers("Laser reads %.2f of the height that stereo and motion show, limit ",
                         laser.ratio) +
             WithNumbers("%.2f to %.2f", 1 - LaserHealth::kWrong, 1 + LaserHealth::kWrong);
    case State::kNever:
      return "Laser not heard";
    case State::kFine:
      return {};
  }
  return {};
}

}  // namespace palace::words
