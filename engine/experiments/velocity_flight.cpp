#include "engine/experiments/velocity_flight.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "engine/experiments/axis_rms.h"
#include "engine/experiments/slope_foot.h"
#include "engine/flight/controllers.h"
#include "engine/flight/slope_reference.h"
#include "engine/navigation/position_filter.h"
#include "engine/simulation/instrumented_aircraft.h"

namespace palace {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

const Vector3d kStart(0, 0, -15.24);  // 50 ft
constexpr double kOnGps_s = 20, kBeside_s = 10, kSettles_s = 2, kApproach_s = 40;
constexpr double kLost_m = 10;
constexpr double kTipped_rad = Rad(45);
constexpr double kTrack_s = 0.2;
// Of the navigator's vision filter.
constexpr double kAccelNoise_mps2 = 0.03, kBiasWalk_mps3 = 0.005;

constexpr FixedGainDesign kHigh{.accel_noise_mps2_rthz = 0.5, .fix_sigma_m = 0.02};
constexpr FixedGainDesign kReduced{.accel_noise_mps2_rthz = kAccelNoise_mps2, .fix_sigma_m = 0.08};

struct Flown {
  Vector3d p_WB;
  Vector3d v_WB;
};

/// Position and velocity from vision, whichever way.
class VisionEstimate {
 public:
  explicit VisionEstimate(const VelocityMethod& method) : method_(method) {}

  bool running() const { return fixed_ || by_stamps_; }
  void Start(const PositionMeasurement& fix, const Vector3d& v_WB, const Vector3d& bias_B) {
    if (method_.source == VelocitySource::kFixedGains) {
      fixed_.emplace(method_.design, fix.p_WB, v_WB);
      return;
    }
    by_stamps_.emplace();
    FilterSeed seed;
    seed.time = fix.time;
    seed.p_WB = fix.p_WB;
    seed.p_covariance_m2 = fix.p_covariance_m2;
    seed.v_WB = v_WB;
    seed.bias_B = bias_B;
    by_stamps_->Start(seed, {Vector3d::Constant(kAccelNoise_mps2), kBiasWalk_mps3});
  }
  /// `a_W`: without the bias that the GPS filter knows.
  void Propagate(Timestamp now, double dt_s, const Vector3d& force_B, const Matrix3d& R_WB,
                 const Vector3d& a_W) {
    if (fixed_) {
      fixed_->Propagate(a_W, dt_s);
    } else if (by_stamps_) {
      by_stamps_->AddImu(now, force_B, R_WB);
    }
  }
  void AddFix(const PositionMeasurement& fix) {
    if (fixed_) {
      fixed_->AddFix(fix.p_WB);
    } else {
      by_stamps_->AddFix(fix);
    }
  }
  Flown At(Timestamp now) const {
    if (fixed_) {
      return {fixed_->p_WB(), fixed_->v_WB()};
    }
    const FilterEstimate estimate = by_stamps_->EstimateAt(now);
    return {estimate.p_WB, estimate.v_WB};
  }

 private:
  const VelocityMethod& method_;
  std::optional<FixedGainFilter> fixed_;
  std::optional<PositionFilter> by_stamps_;
};

CascadeGains GainsWith(const LoopIntegral& integral, CascadeGains gains) {
  gains.velocity_integral_per_s2 = integral.gain_per_s2;
  if (!integral.freezes) {
    gains.max_acceleration_mps2 = std::numeric_limits<double>::infinity();
  }
  return gains;
}

FlightPath SlopeTo(const Vector3d& p_WS, const VehicleDescription& vehicle) {
  ApproachPlan plan;
  plan.heading_rad = 0;
  plan.glide_slope_rad = -vehicle.rig.tilt_rad;
  plan.descent_rate_mps = 1;
  return PathOf(plan, p_WS, {vehicle.rig.position_body_m, vehicle.lander.skid_centre_B(), 0});
}

/// The aircraft of SimulatedVehicle under the same cascade, but on estimates of its own: that
/// one's autopilot flies on a filter of fixed gains behind the station's (VisionNavigator), which
/// would smooth the very velocities that are judged here.
class Loop {
 public:
  /// `p_WS`: where the slope from the hover ends.
  Loop(const VelocityMethod& method, const LoopIntegral& integral, const VelocityFlightPlan& plan,
       const Vector3d& p_WS)
      : plan_(plan),
        method_(method),
        control_s_(1 / plan.vehicle.actuators.control_rate_hz),
        path_(SlopeTo(p_WS, plan.vehicle)),
        aircraft_(plan.vehicle, GustyWind(plan.wind_mps, 0), plan.seed, {now_, kStart, 0}),
        fixes_({plan.vehicle.rig, plan.vehicle.sensors.laser,
                plan.vehicle.sensors.attitude.white_rad, p_WS, method.pace, method.attitude,
                plan.seed}),
        vision_(method),
        controller_(GainsWith(integral, plan.vehicle.gains)) {
    reference_.p_W = place_W_ = path_.Start(kStart);
  }

  VelocityFlight Fly() {
    const double end_s = plan_.hover_s + kApproach_s;
    while (time_s() < end_s && flight_.crash == "none" && !IsOver()) {
      if (aircraft_.IsDue(plan_.vehicle.actuators.control_rate_hz)) {
        Control();
        Judge();
      }
      aircraft_.StepPhysics(HeightFromDown(body_.p_WB.z()));
      now_ = AddSeconds(now_, Aircraft::kStep_s);
      body_ = aircraft_.body();
      if (const auto inertial = aircraft_.StepInertial(now_)) {
        Propagate(*inertial);
      }
      aircraft_.StepGps(now_);
      if (method_.source != VelocitySource::kGps && time_s() >= -kBeside_s) {
        See();
      }
    }
    return Told();
  }

 private:
  double time_s() const { return SecondsBetween(kSwitch, now_); }
  bool OnApproach() const { return time_s() >= plan_.hover_s; }
  bool IsOver() const { return slope_ && slope_->height_m <= path_.speeds.slope_end_m; }

  Flown OnGps() const {
    const FlightState believed = aircraft_.Believed();
    return {believed.p_WB, believed.v_WB};
  }
  Flown InForce() const { return on_vision_ ? vision_.At(now_) : OnGps(); }

  void Control() {
    if (!on_vision_ && time_s() >= 0 && vision_.running()) {
      const Vector3d before_W = InForce().p_WB;
      on_vision_ = true;
      reference_.p_W += InForce().p_WB - before_W;
    }
    if (OnApproach()) {
      slope_ = slope_.value_or(SlopeReference::From(path_, reference_.p_W));
      slope_->Step(path_, /*moves=*/true, control_s_, reference_);
      place_W_ = path_.BodyAt(slope_->height_m);
    }
    const Flown flown = InForce();
    FlightState state = aircraft_.Believed();
    state.p_WB = flown.p_WB;
    state.v_WB = flown.v_WB;
    const FlightSetpoint setpoint{reference_.p_W, reference_.v_W, 0, reference_.a_W};
    aircraft_.Command(controller_.Update(setpoint, state, control_s_));
  }

  void Propagate(const InstrumentedAircraft::Inertial& inertial) {
    vision_.Propagate(now_, 1 / plan_.vehicle.sensors.imu_rate_hz, inertial.sample.specific_force_B,
                      aircraft_.Believed().R_WB, inertial.a_W - aircraft_.navigator().bias_W());
  }

  void See() {
    const Matrix3d R_WB = aircraft_.Believed().R_WB;
    const std::optional<VisionFixes::Told> told =
        fixes_.Advance(now_, {body_.R_WB, body_.p_WB}, R_WB);
    if (!told) {
      return;
    }
    if (vision_.running()) {
      vision_.AddFix(told->fix);
    } else {
      vision_.Start(told->fix, OnGps().v_WB, R_WB.transpose() * aircraft_.navigator().bias_W());
    }
    if (time_s() >= 0 && !OnApproach()) {
      fix_sum_ += told->error_m;
      fix_squares_.Add(told->error_m);
    }
  }

  void Judge() {
    if (time_s() < 0) {
      return;
    }
    const Flown flown = InForce();
    const Vector3d v_WB = body_.v_WB();
    if (time_s() >= next_track_s_) {
      flight_.track.push_back({time_s(), flown.v_WB, v_WB});
      next_track_s_ += kTrack_s;
    }
    const double off_m = (body_.p_WB - place_W_).norm();
    if (OnApproach()) {
      approach_.Add(flown.v_WB - v_WB);
      flight_.approach_off_m = std::fmax(flight_.approach_off_m, off_m);
    } else {
      flight_.hover_off_m = std::max(flight_.hover_off_m, off_m);
      if (time_s() >= kSettles_s) {
        hover_.Add(flown.v_WB - v_WB);
      }
    }
    const double tilt_rad = std::acos(std::clamp(body_.R_WB(2, 2), -1.0, 1.0));
    const auto points = GearPoints(plan_.vehicle.lander);
    const bool grounded = std::any_of(points.begin(), points.end(), [&](const Vector3d& p_B) {
      return (body_.p_WB + body_.R_WB * p_B).z() >= 0;
    });
    const char* crash = grounded                 ? "ground"
                        : off_m > kLost_m        ? "10 m off"
                        : tilt_rad > kTipped_rad ? "tilt"
                                                 : "none";
    flight_.crash = crash;
    flight_.crash_s = flight_.crash == "none" ? NAN : time_s();
  }

  VelocityFlight Told() {
    flight_.hover_rms_mps = hover_.Rms();
    flight_.approach_rms_mps = approach_.Rms();
    if (fix_squares_.count() > 1) {
      const Vector3d mean = fix_sum_ / fix_squares_.count();
      flight_.fix_bias_m = mean;
      flight_.fix_noise_m =
          (fix_squares_.MeanSquare() - mean.cwiseAbs2()).cwiseMax(0.0).cwiseSqrt();
    }
    return std::move(flight_);
  }

  static constexpr Timestamp kSwitch{1'000'000'000'000};

  const VelocityFlightPlan& plan_;
  const VelocityMethod& method_;
  double control_s_;
  FlightPath path_;
  Timestamp now_ = AddSeconds(kSwitch, -kOnGps_s);
  InstrumentedAircraft aircraft_;
  VisionFixes fixes_;
  VisionEstimate vision_;
  FlightController controller_;
  MovingReference reference_;
  std::optional<SlopeReference> slope_;
  Vector3d place_W_;  ///< where it should be: the reference without what the switch moved it by
  BodyState body_ = aircraft_.body();
  bool on_vision_ = false;
  double next_track_s_ = 0;
  AxisRms hover_, approach_, fix_squares_;
  Vector3d fix_sum_ = Vector3d::Zero();
  VelocityFlight flight_;
};

}  // namespace

std::span<const VelocityMethod> VelocityMethods() {
  using enum VelocitySource;
  using enum FixPace;
  using enum FixAttitude;
  static constexpr std::array<VelocityMethod, 8> kMethods = {{
      {"GPS", kGps},
      {"high; free; late attitude", kFixedGains, kHigh, kAsFastAsItCan, kOnArrival},
      {"high; free", kFixedGains, kHigh, kAsFastAsItCan, kOfExposure},
      {"high; 10 Hz; late attitude", kFixedGains, kHigh, kTenHz, kOnArrival},
      {"high; 10 Hz", kFixedGains, kHigh, kTenHz, kOfExposure},
      {"low; 10 Hz; late attitude", kFixedGains, kReduced, kTenHz, kOnArrival},
      {"low; 10 Hz", kFixedGains, kReduced, kTenHz, kOfExposure},
      {"ours", kByStamps, {}, kAsFastAsItCan, kOfExposure},
  }};
  return kMethods;
}

Result<VelocityFlight> FlyOn(const VelocityMethod& method, const LoopIntegral& integral,
                             const VelocityFlightPlan& plan) {
  const Result<Vector3d> p_WS = SlopeFoot(plan.vehicle, kStart);
  if (!p_WS) {
    return p_WS.error();
  }
  return Loop(method, integral, plan, *p_WS).Fly();
}

}  // namespace palace
