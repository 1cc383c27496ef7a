#include "engine/experiments/velocity_flight.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "engine/flight/controllers.h"
#include "engine/flight/flight_path.h"
#include "engine/navigation/position_filter.h"
#include "engine/simulation/aircraft.h"
#include "engine/simulation/vehicle_navigator.h"
#include "engine/simulation/wind.h"

namespace palace {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kHover_m = 15.24;  // 50 ft
constexpr double kOnGps_s = 20, kBeside_s = 10, kSettles_s = 2, kApproach_s = 40;
constexpr double kLost_m = 10;
constexpr double kTipped_rad = Rad(45);
constexpr double kShiftFade_s = 3;
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

/// Sums squares of three axes.
struct SquareSum {
  Vector3d sum = Vector3d::Zero();
  int count = 0;

  void Add(const Vector3d& value) {
    sum += value.cwiseAbs2();
    ++count;
  }
  Vector3d Rms() const {
    return count > 0 ? Vector3d((sum / count).cwiseSqrt()) : Vector3d::Constant(NAN);
  }
};

/// Where it should be: the hover, then the slope, moved by what vision says otherwise than GPS.
class Reference {
 public:
  Reference(const FlightPath& path, const Vector3d& start, double period_s)
      : path_(path), start_(start), period_s_(period_s), height_m_(path.SkidHeight(start)) {
    at_.p_WB = start;
  }
  void Shift(const Vector3d& by) { shift_ = by; }
  void Descend() {
    const bool ended = height_m_ <= path_.speeds.slope_end_m;
    rate_mps_ = Slew(rate_mps_, ended ? 0 : path_.speeds.SinkRateAt(height_m_),
                     path_.speeds.acceleration_mps2 * period_s_);
    height_m_ -= rate_mps_ * period_s_;
    const Vector3d v_W = -rate_mps_ * path_.BodyPerMetre();
    at_.a_WB = (v_W - at_.v_WB) / period_s_;
    at_.v_WB = v_W;
    at_.p_WB = start_ + path_.BodyAt(height_m_) - path_.BodyAt(path_.SkidHeight(start_));
    shift_ *= std::exp(-period_s_ / kShiftFade_s);
    is_over_ = ended && rate_mps_ <= 0;
  }
  bool is_over() const { return is_over_; }
  const Vector3d& p_WB() const { return at_.p_WB; }
  FlightSetpoint Flown() const {
    FlightSetpoint shifted = at_;
    shifted.p_WB += shift_;
    return shifted;
  }

 private:
  FlightPath path_;
  Vector3d start_;
  double period_s_;
  double height_m_;
  double rate_mps_ = 0;
  Vector3d shift_ = Vector3d::Zero();
  FlightSetpoint at_;
  bool is_over_ = false;
};

CascadeGains GainsWith(const LoopIntegral& integral, CascadeGains gains) {
  gains.velocity_integral_per_s2 = integral.gain_per_s2;
  if (!integral.freezes) {
    gains.max_acceleration_mps2 = std::numeric_limits<double>::infinity();
  }
  return gains;
}

/// Where the left camera's axis meets level ground.
Vector3d AxisOnGround(const RigidTransform& X_WC) {
  const Vector3d axis_W = X_WC.R.col(2);
  return X_WC.p - X_WC.p.z() / axis_W.z() * axis_W;
}

FlightPath SlopeTo(const Vector3d& p_WS, const VehicleDescription& vehicle) {
  ApproachPlan plan;
  plan.heading_rad = 0;
  plan.glide_slope_rad = -vehicle.rig.tilt_rad;
  plan.descent_rate_mps = 1;
  return PathOf(plan, p_WS, {vehicle.rig.position_body_m, vehicle.lander.skid_centre_B(), 0});
}

/// The vehicle, stepped at 200 Hz as SimulatedVehicle steps it.
class Loop {
 public:
  Loop(const VelocityMethod& method, const LoopIntegral& integral, const VelocityFlightPlan& plan)
      : plan_(plan),
        method_(method),
        control_s_(1 / plan.vehicle.actuators.control_rate_hz),
        p_WS_(AxisOnGround(RigidTransform{Matrix3d::Identity(), start_} * plan.vehicle.rig.X_BC())),
        aircraft_(plan.vehicle, start_, 0),
        actuators_(plan.vehicle.actuators, Aircraft::kStep_s),
        wind_(GustyWind(plan.wind_mps, 0), plan.seed),
        imu_(plan.vehicle.sensors.imu, plan.vehicle.sensors.imu_rate_hz, plan.seed),
        ahrs_(plan.vehicle.sensors.attitude, plan.vehicle.sensors.imu_rate_hz, plan.seed),
        gps_(plan.vehicle.sensors.gps, plan.seed),
        gps_navigator_({now_, start_, Vector3d::Zero()}, plan.vehicle.sensors.gps.velocity_mps),
        fixes_({plan.vehicle.rig, plan.vehicle.sensors.laser,
                plan.vehicle.sensors.attitude.white_rad, p_WS_, method.pace, method.attitude,
                plan.seed}),
        vision_(method),
        controller_(GainsWith(integral, plan.vehicle.gains)),
        reference_(SlopeTo(p_WS_, plan.vehicle), start_, control_s_) {}

  VelocityFlight Fly() {
    const auto every = [](double rate_hz) {
      return std::llround(1 / (Aircraft::kStep_s * rate_hz));
    };
    const long long control = every(plan_.vehicle.actuators.control_rate_hz),
                    inertial = every(plan_.vehicle.sensors.imu_rate_hz),
                    gps = every(plan_.vehicle.sensors.gps_rate_hz);
    const double end_s = plan_.hover_s + kApproach_s;
    for (long long step = 0; time_s() < end_s && flight_.crash == "none" && !reference_.is_over();
         ++step) {
      if (step % control == 0) {
        Control();
        Judge();
      }
      StepAircraft();
      if ((step + 1) % inertial == 0) {
        StepInertial();
      }
      if ((step + 1) % gps == 0) {
        gps_.Measure(now_, body_.p_WB, body_.v_WB());
      }
      if (const std::optional<GpsFix> fix = gps_.Deliver(now_)) {
        gps_navigator_.Update(*fix);
      }
      if (method_.source != VelocitySource::kGps && time_s() >= -kBeside_s) {
        See();
      }
    }
    return Told();
  }

 private:
  double time_s() const { return SecondsBetween(kSwitch, now_); }
  bool OnApproach() const { return time_s() >= plan_.hover_s; }

  Flown InForce() const {
    return on_vision_ ? vision_.At(now_)
                      : Flown{gps_navigator_.now().p_WB, gps_navigator_.now().v_WB};
  }

  void Control() {
    if (!on_vision_ && time_s() >= 0 && vision_.running()) {
      const Flown before = InForce();
      on_vision_ = true;
      reference_.Shift(InForce().p_WB - before.p_WB);
      flight_.step_mps = (InForce().v_WB - before.v_WB).norm();
    }
    if (OnApproach()) {
      reference_.Descend();
    }
    const Flown flown = InForce();
    actuators_.Command(controller_.Update(
        reference_.Flown(), {flown.p_WB, flown.v_WB, attitude_, angular_rate_B_}, control_s_));
  }

  void StepAircraft() {
    const double height_m = HeightFromDown(body_.p_WB.z());
    wind_W_ = wind_.Advance(Aircraft::kStep_s, height_m, (body_.v_WB() - wind_W_).norm());
    aircraft_.Step(actuators_.Act(), wind_W_, height_m);
    now_ = AddSeconds(now_, Aircraft::kStep_s);
    body_ = aircraft_.body();
  }

  void StepInertial() {
    const double dt_s = 1 / plan_.vehicle.sensors.imu_rate_hz;
    const ImuSample sample = imu_.Measure(now_, aircraft_.SpecificForce(), body_.angular_rate_B);
    attitude_ = ahrs_.Measure(body_.R_WB);
    angular_rate_B_ = sample.angular_rate_B;
    const Vector3d a_W = AccelerationInWorld(sample, attitude_);
    gps_navigator_.Propagate(now_, a_W);
    vision_.Propagate(now_, dt_s, sample.specific_force_B, attitude_,
                      a_W - gps_navigator_.bias_W());
  }

  void See() {
    const std::optional<VisionFixes::Told> told =
        fixes_.Advance(now_, {body_.R_WB, body_.p_WB}, attitude_);
    if (!told) {
      return;
    }
    if (vision_.running()) {
      vision_.AddFix(told->fix);
    } else {
      vision_.Start(told->fix, gps_navigator_.now().v_WB,
                    attitude_.transpose() * gps_navigator_.bias_W());
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
    const double off_m = (body_.p_WB - reference_.p_WB()).norm();
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
    if (fix_squares_.count > 1) {
      const Vector3d mean = fix_sum_ / fix_squares_.count;
      flight_.fix_bias_m = mean;
      flight_.fix_noise_m =
          (fix_squares_.sum / fix_squares_.count - mean.cwiseAbs2()).cwiseMax(0.0).cwiseSqrt();
    }
    return std::move(flight_);
  }

  static constexpr Timestamp kSwitch{1'000'000'000'000};

  const VelocityFlightPlan& plan_;
  const VelocityMethod& method_;
  double control_s_;
  Vector3d start_{0, 0, -kHover_m};
  Vector3d p_WS_;
  Timestamp now_ = AddSeconds(kSwitch, -kOnGps_s);
  Aircraft aircraft_;
  Actuators actuators_;
  WindModel wind_;
  Vector3d wind_W_ = Vector3d::Zero();
  ImuSensor imu_;
  AhrsSensor ahrs_;
  GpsSensor gps_;
  GpsNavigator gps_navigator_;
  VisionFixes fixes_;
  VisionEstimate vision_;
  FlightController controller_;
  Reference reference_;
  BodyState body_ = aircraft_.body();
  Matrix3d attitude_ = body_.R_WB;
  Vector3d angular_rate_B_ = Vector3d::Zero();
  bool on_vision_ = false;
  double next_track_s_ = 0;
  SquareSum hover_, approach_, fix_squares_;
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

VelocityFlight FlyOn(const VelocityMethod& method, const LoopIntegral& integral,
                     const VelocityFlightPlan& plan) {
  return Loop(method, integral, plan).Fly();
}

}  // namespace palace
