#include "engine/mission/guards.h"

#include <cstdio>

#include "engine/mission/descent_limits.h"

namespace palace {
namespace {

std::string Seconds(double s) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f s", s);
  return text;
}

/// Empty when the age is known and within the limit.
std::string WhyOld(const char* what, double age_s, double limit_s) {
  if (!std::isfinite(age_s)) {
    return std::string(what) + " never received";
  }
  if (age_s > limit_s) {
    return std::string(what) + " stale, " + Seconds(age_s);
  }
  return {};
}

std::string WhyCamerasBad(const GuardInputs& in) {
  std::string why = WhyOld("Left camera", in.left_camera_age_s, GuardLimits::camera_s);
  why = why.empty() ? WhyOld("Right camera", in.right_camera_age_s, GuardLimits::camera_s) : why;
  return why.empty() ? in.camera_problem : why;
}

/// Checks that compare with the moment of selection have nothing to compare without one.
constexpr const char* kNothingArmed = "Select a site first";
bool NothingArmed(const GuardInputs& in) { return in.site_letter == '?'; }

std::string WhyNotPositioned(const GuardInputs& in) {
  if (!in.position_healthy) {
    return "Position estimate not healthy";
  }
  if (NothingArmed(in)) {
    return kNothingArmed;
  }
  if (!in.tracker_locked) {
    return "Tracker not locked on the site";
  }
  if (!(in.coherence >= in.min_coherence)) {
    char text[64];
    std::snprintf(text, sizeof text, "Coherence %.2f, min %.2f", in.coherence, in.min_coherence);
    return text;
  }
  return {};
}

std::string WhyNotShown(const GuardInputs& in) {
  if (!std::isfinite(in.shown_for_s)) {
    return kNothingArmed;
  }
  return in.shown_for_s >= GuardLimits::shown_s
             ? ""
             : "Evidence on screen for " + Seconds(in.shown_for_s) + ", min 1.0 s";
}

std::string WhySiteLost(const GuardInputs& in) {
  if (in.site_holds) {
    return {};
  }
  if (NothingArmed(in)) {
    return kNothingArmed;
  }
  return in.site_reason.empty()
             ? "Site " + std::string(1, in.site_letter) + " is not on the newest map"
             : in.site_reason;
}

std::string WhyVehicleChanged(const GuardInputs& in) {
  if (NothingArmed(in)) {
    return kNothingArmed;
  }
  if (!in.boot_unchanged) {
    return "Vehicle restarted or is unknown";
  }
  return in.clock_continuous ? "" : "Vehicle clock stepped or is not yet known";
}

std::string WhyNotCommanding(const GuardInputs& in) {
  if (!in.can_transmit) {
    return "No link to a vehicle";
  }
  return in.foreign_approval ? "Vehicle executes an approval that is not ours" : "";
}

std::string WhyWindy(const GuardInputs& in) {
  const LimitRow wind = WindLimit(in.wind_mps, EnforcedBy::kGuard);
  return wind.over ? "Wind " + ValueWords(wind) + ", max " + LimitWords(wind) : "";
}

std::string WhyNotInTime(const GuardInputs& in) {
  if (!std::isfinite(in.armed_for_s)) {
    return kNothingArmed;
  }
  if (in.armed_for_s < GuardLimits::arm_to_approve_s) {
    return "Site selected " + Seconds(in.armed_for_s) + " ago, min 0.5 s";
  }
  return in.armed_for_s <= in.arm_window_s ? "" : "Arm window is over, select the site again";
}

}  // namespace

std::string WhyNoVehicle(SourceKind kind) {
  return kind == SourceKind::kImages    ? "No vehicle in a picture folder"
         : kind == SourceKind::kCameras ? "No vehicle, cameras only"
         : kind == SourceKind::kVideo   ? "No vehicle in a video"
                                        : "";
}

std::vector<GuardResult> EvaluateGuards(const GuardInputs& in) {
  std::vector<GuardResult> guards;
  const auto add = [&](const char* id, const char* name, std::string why) {
    guards.push_back({id, name, why.empty(), std::move(why)});
  };
  add("G1", "Vehicle link fresh", WhyOld("Vehicle status", in.link_age_s, GuardLimits::link_s));
  add("G2", "Attitude fresh", WhyOld("Vehicle pose", in.pose_age_s, GuardLimits::pose_s));
  add("G3", "Both cameras fresh and right", WhyCamerasBad(in));
  add("G4", "Newest map fresh", WhyOld("Map", in.map_age_s, GuardLimits::map_s));
  add("G5", "Position and tracker healthy", WhyNotPositioned(in));
  add("G6", "Evidence was on screen", WhyNotShown(in));
  add("G7", "Limits and calibration unchanged",
      NothingArmed(in)      ? kNothingArmed
      : in.hashes_unchanged ? ""
                            : "Limits or calibration changed since the site was selected");
  add("G8", "Site holds on the newest map", WhySiteLost(in));
  add("G9", "Vehicle did not restart", WhyVehicleChanged(in));
  add("G10", "This station commands", WhyNotCommanding(in));
  add("G11", "No warning unacknowledged",
      in.unacknowledged_warning.empty() ? "" : "Acknowledge first: " + in.unacknowledged_warning);
  add("G12", "Recording as asked",
      in.recorder_ok || in.recorder_loss_acknowledged ? "" : "Recording is not running");
  add("G13", "Source may be approved on", in.source_reason);
  add("G14", "Selected and approved apart", WhyNotInTime(in));
  add("G15", "Wind inside limit", WhyWindy(in));
  return guards;
}

const GuardResult* FirstFailure(const std::vector<GuardResult>& guards, bool as_recorded) {
  for (const GuardResult& guard : guards) {
    const bool of_its_time = guard.id == "G1" || guard.id == "G10" || guard.id == "G12" ||
                             guard.id == "G13" || guard.id == "G15";
    if (!guard.pass && !(as_recorded && of_its_time)) {
      return &guard;
    }
  }
  return nullptr;
}

}  // namespace palace
