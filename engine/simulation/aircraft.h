// Aircraft: the flight model of whichever vehicle flies, behind what the simulator asks of it, with
// the ground effect around it. A model more is an alternative of the variant.
#pragma once

#include <variant>

#include "engine/simulation/vehicle_description.h"

namespace palace {

class Aircraft {
 public:
  static constexpr double kStep_s = Rotorcraft::kStep_s;
  static_assert(kStep_s == Multirotor::kStep_s);

  /// Hovering at rest in still air.
  Aircraft(const VehicleDescription& vehicle, const Eigen::Vector3d& p_WB, double yaw_rad);

  /// One step of kStep_s. `height_m`: of B above the bare ground.
  void Step(const StickCommand& stick, const Eigen::Vector3d& wind_W, double height_m);
  void Freeze();

  BodyState body() const;
  bool frozen() const;
  Eigen::Vector3d SpecificForce() const;

 private:
  GroundEffect ground_effect_;
  std::variant<Rotorcraft, Multirotor> model_;
};

}  // namespace palace
