// A simulated session: scene, wind, vehicle and whom it obeys, from one seed. The one way to
// assemble it, for window, experiments, `palacectl simulate` and tests.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "engine/core/result.h"
#include "engine/simulation/simulator.h"
#include "engine/trust/secret_key.h"

namespace palace {

struct SessionSpec {
  std::string scenario = "runway";  ///< of SceneNames()
  std::uint64_t seed = 1;           ///< of scene, noise, wind and session; one seed, one flight
  VehicleDescription vehicle = DefaultVehicle();
  double wind_mps = 0;  ///< mean at 20 ft; its gusts have a W20 of 1.5 times as much
  double speed = 0;     ///< times real time; 0 as fast as possible
  double duration_limit_s = 600;
  bool render = true;  ///< false: bundles carry no pictures
  /// Where stations are other programs: whom the vehicle obeys. Its boot id, session ids and
  /// challenges are random then.
  struct OtherStations {
    std::optional<std::vector<SecretKey>> keys{};  ///< none: whoever speaks is obeyed
  };
  std::optional<OtherStations> other_stations{};  ///< none: the station in this program commands
};

struct SimulatedSession {
  std::uint64_t id = 1;
  World scene;
  VehicleDescription vehicle;  ///< what a station reckons with: SettingsFor
  std::shared_ptr<Simulator> simulator;
};

/// An unknown scenario is a usage error that lists the names. `cameras` may be null without
/// pictures.
Result<SimulatedSession> OpenSimulatedSession(const SessionSpec& spec, SceneCameraFactory cameras);

}  // namespace palace
