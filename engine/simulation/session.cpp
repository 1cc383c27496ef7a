#include "engine/simulation/session.h"

#include <utility>

#include "engine/core/random.h"
#include "engine/world/world_file.h"

namespace palace {
Result<SimulatedSession> OpenSimulatedSession(const SessionSpec& spec, SceneCameraFactory cameras) {
  Result<World> scene = OpenWorld(spec.scenario, spec.seed);
  if (!scene) {
    return scene.error();
  }
  SimulatedSession session{spec.seed, std::move(*scene), spec.vehicle, {}};
  SimulatorOptions options;
  options.scene = session.scene;
  options.seed = spec.seed;
  options.vehicle = spec.vehicle;
  options.wind = GustyWind(spec.wind_mps, 0);
  options.speed = spec.speed;
  options.duration_limit_s = spec.duration_limit_s;
  options.render = spec.render;
  if (spec.other_stations) {
    options.boot_id = RandomWord();
    options.keys = spec.other_stations->keys;
  } else {
    // Of the seed, so that a flight repeats to the bit: never a key of a real vehicle.
    const SecretKey key = SecretKey::FromSeed(spec.seed);
    auto words = std::make_shared<RandomStream>(spec.seed, "station");
    options.keys = {key};
    options.own_station = StationTrust{.station_id = words->NextBits() | 1,
                                       .station_name = "this station",
                                       .key = key,
                                       .key_name = "built in",
                                       .random_word = [words] { return words->NextBits() | 1; }};
  }
  session.simulator = std::make_shared<Simulator>(std::move(options), std::move(cameras));
  return session;
}

}  // namespace palace
