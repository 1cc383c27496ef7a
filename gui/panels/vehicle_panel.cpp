#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/units.h"
#include "engine/model/told_height.h"
#include "engine/model/wind.h"
#include "gui/panels/arrival.h"
#include "gui/panels/fly_panels.h"
#include "gui/widgets/number_text.h"
#include "gui/widgets/readout.h"

namespace palace {

namespace {

const char* ModeWords(const EngineSnapshot& snap) {
  if (!snap.sensors->vehicle) {
    return "No status yet";
  }
  switch (snap.sensors->vehicle->mode) {
    case VehicleMode::kHover:
      return "Hover hold";
    case VehicleMode::kAlign:
      return "Aligning";
    case VehicleMode::kDescend:
      return !snap.sensors->vehicle->flies_on_vision ? "Descending on GPS"
             : snap.flight->mission.IsLook()         ? "Descending on vision"
                                                     : "Landing on vision";
    case VehicleMode::kSettle:
      return "Settling";
    case VehicleMode::kSink:
      return "Sinking";
    case VehicleMode::kLanded:
      return "On the ground";
    case VehicleMode::kHold:
      return "Holding";
    case VehicleMode::kAbort:
      return snap.flight->mission.wave_off.phase == WaveOffReport::Phase::kClimbs ? "Climbing away"
                                                                                  : "Waving off";
    case VehicleMode::kGo:
      return "To another hover";
    case VehicleMode::kUnknown:
      break;
  }
  return "Mode unknown";
}

double PositionError3s(const EngineSnapshot& snap) {
  const FilterStatus& filter = snap.flight->navigation.InForce();
  return filter.running ? 3 * filter.estimate.sigma_p_m.norm() : NAN;
}

/// With the age of the return that it rests on: messages that came since had none. The label of a
/// narrow panel has the room that the unit lacks.
Readout ByLaser(const EngineSnapshot& snap, const ToldHeight& told, std::string label, bool narrow,
                double silent_s) {
  Readout readout{std::move(label), Fixed(told.height_m, 1), narrow ? "m" : "m, laser",
                  Readout::State::kNever};
  if (std::isfinite(told.height_m)) {
    const Arrival of_return = ArrivalOf(snap, ChannelId::kLaserRange, silent_s, told.age_s);
    readout.state = of_return.state;
    readout.age_s = of_return.age_s;
  }
  return readout;
}

/// A laser that was heard before tells no height now: that is why it is another one.
void SayWhyNoLaser(ToldHeight::NoLaser why, Readout& by_pose) {
  const std::string instead = ": by the vehicle's pose, above where the mission's frame begins";
  if (why == ToldHeight::NoLaser::kNoReturn) {
    by_pose.note = "no return";
    by_pose.why = "The laser has no return" + instead;
  } else if (why == ToldHeight::NoLaser::kSilent) {
    by_pose.note = "laser silent";
    by_pose.why = "No message of the laser comes" + instead;
  }
}

bool IsLowOnEnergy(const MissionStatus& m) {
  return std::any_of(m.alarms.begin(), m.alarms.end(), [](const Alarm& alarm) {
    return alarm.kind == AlarmId::kEnergyLow && alarm.active;
  });
}

/// What the vehicle told, as readouts of the age that each message has.
struct Told {
  const EngineSnapshot& snap;
  bool narrow = false;
  double silent_s = 0;

  Readout By(ChannelId channel, std::string label, double value, int decimals,
             std::string unit) const {
    const Arrival fresh = ArrivalOf(snap, channel, silent_s);
    return {std::move(label), Fixed(value, decimals), std::move(unit), fresh.state, fresh.age_s};
  }
  Readout ByPose(std::string label, double value, int decimals, std::string unit) const {
    return By(ChannelId::kVehiclePose, std::move(label), value, decimals, std::move(unit));
  }
  Readout ByStatus(std::string label, double value, int decimals, std::string unit) const {
    return By(ChannelId::kVehicleStatus, std::move(label), value, decimals, std::move(unit));
  }
  /// Without the vehicle's word the estimate coasts: no figure of any time.
  bool Coasts() const {
    return ArrivalOf(snap, ChannelId::kVehiclePose, silent_s).state == ChannelHealth::State::kStale;
  }
  Readout Estimated(std::string label, double value, int decimals, std::string unit) const {
    return ByPose(std::move(label), Coasts() ? NAN : value, decimals, std::move(unit));
  }

  Readout Wind() const {
    const double wind = snap.sensors->vehicle ? snap.sensors->vehicle->wind_speed_mps : NAN;
    const double from = snap.sensors->vehicle ? snap.sensors->vehicle->wind_from_rad : NAN;
    if (!WindHasDirection(wind) || !std::isfinite(from)) {
      return ByStatus("Wind", wind, 1, "m/s");
    }
    Readout readout = ByStatus("Wind, from", wind, 1, "m/s, " + HeadingText(from));
    readout.carries_unit = true;
    return readout;
  }
  /// Fuel or a battery: the vehicle does not say which.
  Readout Energy() const {
    const double energy =
        snap.sensors->vehicle ? snap.sensors->vehicle->battery_or_fuel * 100 : NAN;
    const double lasts_s = snap.flight->mission.energy.lasts_s;
    return ByStatus(
        "Energy", energy, 0,
        std::isfinite(lasts_s) && !narrow ? "%, " + Fixed(lasts_s / 60, 0) + " min" : "%");
  }
};

/// What was measured at touchdown; the estimate goes on drifting and means nothing more.
std::vector<Readout> LandedReadouts(const Told& told) {
  const MissionStatus& m = told.snap.flight->mission;
  return {told.ByStatus(told.narrow ? "Off centre" : "Off centre, estimate",
                        m.touchdown_miss_m.value_or(NAN), 2, "m"),
          told.ByStatus(told.narrow ? "In truth" : "Off centre, in truth",
                        m.touchdown_miss_true_m.value_or(NAN), 2, "m"),
          told.Wind(), told.Energy(),
          told.ByStatus(told.narrow ? "Sink rate" : "Sink rate, estimate",
                        m.touchdown_sink_mps.value_or(NAN), 2, "m/s")};
}

Readout DescentHeight(const Told& told) {
  const ToldHeight height = HeightTold(told.snap);
  const bool by_gps = height.by == ToldHeight::By::kGps;
  if (height.by == ToldHeight::By::kLaser) {
    return ByLaser(told.snap, height, told.narrow ? "Height, laser" : "Height above ground",
                   told.narrow, told.silent_s);
  }
  return told.Estimated(!told.narrow ? "Height above site"
                        : by_gps     ? "Height, GPS"
                                     : "Height",
                        height.height_m, 1, by_gps && !told.narrow ? "m, GPS" : "m");
}

/// The same figures, by the estimate in force, as the limits and the plots below.
std::vector<Readout> DescentReadouts(const Told& told) {
  const EngineSnapshot& snap = told.snap;
  const MissionStatus& m = snap.flight->mission;
  const bool narrow = told.narrow;
  const bool settles = snap.sensors->vehicle && snap.sensors->vehicle->mode == VehicleMode::kSettle;
  Readout to_go = told.Estimated(narrow ? "To go" : "Time to go", m.time_to_touchdown_s, 0,
                                 settles && !narrow ? "s, settling" : "s");
  to_go.value = told.Coasts() ? to_go.value : TimeToGo(snap);
  const LimitRow* rate = FindLimit(m.limits, LimitId::kDescentRate);
  const double rate_mps = rate != nullptr ? rate->value : NAN;
  const bool climbs = rate_mps < -0.02;  // not by the noise of a hover
  const char* word =
      climbs ? (narrow ? "Climb" : "Climb rate") : (narrow ? "Descent" : "Descent rate");
  return {DescentHeight(told),
          to_go,
          told.Estimated(word, climbs ? -rate_mps : rate_mps, 2, "m/s"),
          told.Estimated(narrow ? "From centre" : "From site centre", m.distance_to_site_m, 2, "m"),
          told.Wind(),
          told.Energy()};
}

Readout HoverHeight(const Told& told) {
  const ToldHeight height = HoverHeightTold(told.snap);
  const bool narrow = told.narrow;
  if (height.by == ToldHeight::By::kLaser) {
    return ByLaser(told.snap, height, narrow ? "Above ground" : "Height above ground", narrow,
                   told.silent_s);
  }
  Readout by_pose = told.ByPose(narrow ? "Above origin" : "Height above origin", height.height_m, 1,
                                narrow ? "m" : "m, pose");
  SayWhyNoLaser(height.no_laser, by_pose);
  return by_pose;
}

std::vector<Readout> HoverReadouts(const Told& told) {
  const EngineSnapshot& snap = told.snap;
  const bool narrow = told.narrow;
  const double speed = snap.sensors->pose ? snap.sensors->pose->v_WB.head<2>().norm() : NAN;
  const Readout over_ground = told.ByPose(narrow ? "Speed" : "Ground speed", speed, 1, "m/s");
  Readout heading = told.ByPose("Heading", NAN, 0, "");
  if (snap.sensors->pose) {
    heading.value = HeadingText(EulerFromRotation(snap.sensors->pose->X_WB.R).yaw_rad);
  }
  // How fast it climbs or sinks goes before the heading, in a narrow panel before the speed, never
  // before the wind: gusts bob a hover, and then the wind is asked for.
  const double down_mps = VerticalSpeedTold(snap);
  const bool level = std::isnan(down_mps);
  const Readout upwards =
      down_mps < 0 ? told.ByPose(narrow ? "Climb" : "Climb rate", -down_mps, 1, "m/s")
                   : told.ByPose(narrow ? "Descent" : "Descent rate", down_mps, 1, "m/s");
  if (!narrow) {
    return {HoverHeight(told),
            over_ground,
            level ? heading : upwards,
            told.Wind(),
            told.Estimated("Position error", PositionError3s(snap), 2, "m, 3σ"),
            told.Energy()};
  }
  std::vector<Readout> some = {
      HoverHeight(told), level ? over_ground : upwards,
      told.Wind(),       told.Estimated("Error, 3σ", PositionError3s(snap), 2, "m"),
      heading,           told.Energy()};
  if (IsLowOnEnergy(snap.flight->mission)) {
    std::swap(some[1], some[5]);  // of a hover the speed is worth less
  }
  return some;
}

/// The most important first: a narrow panel shows as many as have room.
std::vector<Readout> Readouts(const Told& told) {
  return told.snap.flight->mission.state == MissionState::kLanded ? LandedReadouts(told)
         : IsDescentView(told.snap)                               ? DescentReadouts(told)
                                                                  : HoverReadouts(told);
}

}  // namespace

void DrawVehiclePanel(const EngineSnapshot& snap, const Rect& rect, bool narrow, UiFrame& ui) {
  const Style& s = ui.style;
  // Two columns where three would not hold the longest label.
  const bool folded = narrow || rect.w < s.Px(380);
  const auto& pose = snap.sensors->pose;
  const bool heads = folded && pose && !Told{snap, folded, ui.silent_s}.Coasts();
  DrawPanelFrame(
      ui, rect, "Vehicle",
      {{ModeWords(snap)},
       {heads ? "Hdg " + HeadingText(EulerFromRotation(pose->X_WB.R).yaw_rad) : std::string()}});
  const std::vector<Readout> readouts = Readouts({snap, folded, ui.silent_s});
  const int columns = folded ? 2 : 3;
  const float pad = s.Px(12);
  const float width = (rect.w - pad) / static_cast<float>(columns);
  const float pitch = s.Px(folded ? 52 : 64);
  for (std::size_t i = 0; i < readouts.size(); ++i) {
    const auto column = static_cast<float>(i % static_cast<std::size_t>(columns));
    const auto row = static_cast<float>(i / static_cast<std::size_t>(columns));
    // The first of three columns holds the long labels.
    const float shift = folded || column < 1.5f ? column * width : 0.617f * rect.w;
    const Rect cell{rect.x + s.Px(folded ? 12 : 16) + shift, rect.y + s.Px(33) + row * pitch,
                    std::min(width, rect.w - shift - s.Px(16)) - s.Px(8), pitch};
    if (folded && cell.bottom() > rect.bottom()) {
      break;
    }
    DrawReadout(ui, cell, readouts[i]);
    ui.items.Add("readout/" + readouts[i].label, cell, true,
                 readouts[i].value + " " + readouts[i].unit);
  }
}

}  // namespace palace
