// SimulatedStation: plays the station for the simulator's tests, with the truth as its vision.
#pragma once

#include <cmath>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "engine/core/random.h"
#include "engine/core/units.h"
#include "engine/simulation/simulator.h"

namespace palace {

using Eigen::Vector3d;
using Bundle = std::shared_ptr<const FrameBundle>;

/// The vehicle obeys the station of this test and no other.
inline void Key(SimulatorOptions& options) {
  options.keys = {SecretKey::FromSeed(options.seed)};
  options.own_station = StationTrust{
      .station_id = 1, .station_name = "test", .key = options.keys->front(), .key_name = "test"};
}

inline SimulatorOptions Options(std::uint64_t seed) {
  SimulatorOptions options;
  options.scene = MakeScene("empty", seed).value();
  options.seed = seed;
  options.render = false;
  return options;
}

/// Plays the station: estimates are truth plus noise, one bundle (0.1 s) late.
class Flight {
 public:
  explicit Flight(const SimulatorOptions& options)
      : simulator(options, nullptr), random_(options.seed, "station") {
    Step();
  }

  /// Sealed, where the vehicle asks for it.
  void Send(VehicleMessage message) {
    simulator.Seal(message);
    simulator.Send(message);
  }
  Bundle Step() {
    if (delayed_) {
      Send(*delayed_);
      delayed_.reset();
    }
    last = simulator.Next({}).value();
    modes.insert(last->status->mode);
    for (const CommandAck& ack : last->acks) {
      acks.push_back(ack);
    }
    if (estimates_on) {
      const Truth& truth = last->truth.back();
      PositionEstimate estimate;
      estimate.time = truth.time;
      estimate.source = EstimateSource::kVision;
      estimate.healthy = true;
      estimate.approval_id = approval_id;
      estimate.p_WB = truth.X_WB.p + vision_offset_W + 0.02 * Noise();
      estimate.v_WB = truth.v_WB + vision_offset_v_W + 0.03 * Noise();
      delayed_ = pending_;
      pending_ = estimate;
    }
    return last;
  }
  Bundle StepSeconds(double seconds) {
    for (int i = 0; i < std::lround(10 * seconds); ++i) {
      Step();
    }
    return last;
  }
  /// Steps until the vehicle is in `mode`; false after the time limit.
  bool StepUntil(VehicleMode mode, double limit_s) {
    for (int i = 0; i < 10 * limit_s; ++i) {
      if (Step()->status->mode == mode) {
        return true;
      }
    }
    return false;
  }

  Approval MakeApproval(const Vector3d& p_WS, double heading_rad = 0) {
    Approval approval;
    approval.id = approval_id = 70 + ++counter_;
    approval.site_id = approval.map_hash = approval.settings_hash = approval.calibration_hash = 1;
    approval.vehicle_boot_id = last->status->boot_id;
    approval.approved_at = last->time;
    approval.expires_at = AddSeconds(last->time, 30);
    approval.p_WS = p_WS;
    approval.approach_heading_rad = heading_rad;
    approval.glide_slope_rad = Rad(45);
    approval.descent_rate_mps = 1.0;
    approval.clear_radius_m = 2.3;
    return approval;
  }

  Simulator simulator;
  Bundle last;
  std::set<VehicleMode> modes;
  std::vector<CommandAck> acks;
  bool estimates_on = false;
  std::uint64_t approval_id = 0;
  Vector3d vision_offset_W = Vector3d::Zero();
  Vector3d vision_offset_v_W = Vector3d::Zero();

 private:
  Vector3d Noise() {
    const double x = random_.Normal(), y = random_.Normal(), z = random_.Normal();
    return {x, y, z};
  }
  RandomStream random_;
  std::uint64_t counter_ = 0;
  std::optional<PositionEstimate> pending_;
  std::optional<PositionEstimate> delayed_;
};

}  // namespace palace
