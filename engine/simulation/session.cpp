#include "engine/simulation/session.h"

#include <utility>

namespace palace {
namespace {

constexpr double kGustPerMean = 1.5;  // W20 of the turbulence beside the mean wind

}  // namespace

Result<SimulatedSession> OpenSimulatedSession(const SessionSpec& spec, SceneCameraFactory cameras) {
  Result<World> scene = MakeScene(spec.scenario, spec.seed);
  if (!scene) {
    return scene.error();
  }
  SimulatedSession session{spec.seed, ApprovalSigner::FromSeed(spec.seed), std::move(*scene), {}};
  SimulatorOptions options;
  options.scene = session.scene;
  options.seed = spec.seed;
  options.wind.mean_mps = spec.wind_mps;
  options.wind.gust_w20_mps = kGustPerMean * spec.wind_mps;
  options.speed = spec.speed;
  options.duration_limit_s = spec.duration_limit_s;
  options.render = spec.render;
  options.station_key =
      spec.other_station ? spec.other_station->key : std::optional(session.signer.public_key());
  session.simulator = std::make_shared<Simulator>(std::move(options), std::move(cameras));
  return session;
}

}  // namespace palace
