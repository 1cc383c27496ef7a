#include "engine/simulation/aircraft.h"

namespace palace {
namespace {

using Model = std::variant<Rotorcraft, Multirotor>;

Model ModelOf(const VehicleDescription& vehicle, const Eigen::Vector3d& p_WB, double yaw_rad) {
  if (const auto* multirotor = std::get_if<MultirotorParameters>(&vehicle.model)) {
    return Multirotor(*multirotor, p_WB, yaw_rad);
  }
  return Rotorcraft(std::get<RotorcraftParameters>(vehicle.model), p_WB, yaw_rad);
}

}  // namespace

Aircraft::Aircraft(const VehicleDescription& vehicle, const Eigen::Vector3d& p_WB, double yaw_rad)
    : ground_effect_(vehicle.ground_effect), model_(ModelOf(vehicle, p_WB, yaw_rad)) {}

void Aircraft::Step(const StickCommand& stick, const Eigen::Vector3d& wind_W, double height_m) {
  const Surroundings around{wind_W, ThrustRatio(ground_effect_, height_m)};
  std::visit([&](auto& model) { model.Step(stick, around); }, model_);
}

void Aircraft::Freeze() {
  std::visit([](auto& model) { model.Freeze(); }, model_);
}

BodyState Aircraft::body() const {
  return std::visit([](const auto& model) { return model.body(); }, model_);
}

bool Aircraft::frozen() const {
  return std::visit([](const auto& model) { return model.frozen(); }, model_);
}

Eigen::Vector3d Aircraft::SpecificForce() const {
  return std::visit([](const auto& model) { return model.SpecificForce(); }, model_);
}

}  // namespace palace
