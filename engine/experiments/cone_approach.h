// ConeApproach: the flight behind Fig. 3.7 of the thesis, flown in the simulator.
//
// The vehicle hovers 50 ft above flat ground, a road cone stands where the left camera's axis meets
// the ground, and it flies down the slope of that axis to the cone, slope end at a skid height of
// 2 m. It is guided by the truth, so that any number of estimators may look on and none of them
// changes what the others see. Sensors, pictures and motion are those of the vehicle's file.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "engine/core/result.h"
#include "engine/model/frame_bundle.h"
#include "engine/simulation/simulator.h"

namespace palace {

struct ConeApproachPlan {
  VehicleDescription vehicle = DefaultVehicle();
  std::uint64_t seed = 1;  ///< of ground, noise, wind and where it hovers
  double wind_mps = 0;     ///< mean at 20 ft, from the north
  double cone_height_m = 0.5;
  double hover_s = 5;  ///< until the descent is approved
  bool render = true;  ///< false: bundles carry no pictures
};

struct ApproachPicture {
  std::shared_ptr<const FrameBundle> bundle;
  RigidTransform X_WB;  ///< the truth at the exposure
  bool approved = false;
};

class ConeApproach {
 public:
  /// Error: cameras that look too flat (slope_foot.h).
  static Result<ConeApproach> Make(const ConeApproachPlan& plan, SceneCameraFactory camera);

  /// The next picture; nothing when the slope has ended. Errors: a camera that cannot draw, and a
  /// vehicle that does not fly the approach.
  Result<std::optional<ApproachPicture>> Next();
  /// The true body pose at a time of the last three seconds.
  RigidTransform TruePoseAt(Timestamp time) const { return simulator_->TruePoseAt(time); }
  /// The middle of the cone's foot, on the ground.
  const Eigen::Vector3d& p_W_cone() const { return p_W_cone_; }

 private:
  ConeApproach(const ConeApproachPlan& plan, const Eigen::Vector3d& p_W_cone,
               std::shared_ptr<Simulator> simulator)
      : plan_(plan), p_W_cone_(p_W_cone), simulator_(std::move(simulator)) {}
  void Approve(const FrameBundle& bundle);
  void GuideByTruth(const FrameBundle& bundle);

  ConeApproachPlan plan_;
  Eigen::Vector3d p_W_cone_;
  std::shared_ptr<Simulator> simulator_;
  std::optional<Approval> approval_;
  bool descends_ = false;
};

}  // namespace palace
