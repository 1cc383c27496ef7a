#include "engine/tools/simulate_export.h"

#include <utility>

#include "engine/runtime/engine.h"
#include "engine/runtime/scripted_operator.h"
#include "engine/world/ray_pictures.h"

namespace palace {

Result<std::unique_ptr<ExportingSource>> ExportingSource::Create(
    const SimulatedSession& session, const std::filesystem::path& folder, std::mutex& hand) {
  const ImuNoise& noise = session.vehicle.sensors.imu;
  const ImuBiases biases = session.simulator->imu_biases();
  EurocImu imu;
  imu.rate_hz = session.vehicle.sensors.imu_rate_hz;
  imu.gyro_walk_rad_s2_sqrt_hz = noise.gyro_walk_rad_s2_sqrt_hz;
  imu.accel_walk_mps3_sqrt_hz = noise.accel_walk_mps3_sqrt_hz;
  imu.gyro_noise_rad_s_sqrt_hz = noise.gyro_rad_s_sqrt_hz;
  imu.accel_noise_mps2_sqrt_hz = noise.accel_mps2_sqrt_hz;
  imu.gyro_bias_rad_s = biases.gyro_rad_s;
  imu.accel_bias_mps2 = biases.accel_mps2;
  auto writer = EurocWriter::Create(
      folder, session.simulator->rig(), imu,
      "simulated " + session.scene.name + ", seed " + std::to_string(session.id));
  if (!writer) {
    return writer.error();
  }
  return std::unique_ptr<ExportingSource>(
      new ExportingSource(session, std::move(writer).value(), hand));
}

Result<std::shared_ptr<const FrameBundle>> ExportingSource::Next(std::stop_token stop) {
  auto bundle = simulator_->Next(stop);
  if (!bundle) {
    return bundle.error();
  }
  const FrameBundle& b = **bundle;
  ImageF depth_m;
  if (b.stereo) {
    const Timestamp time = b.stereo->time;
    const World scene = WorldAt(scene_, SecondsBetween(Simulator::kEpoch, time));
    depth_m = RenderDepth(scene, b.rig->left, simulator_->TruePoseAt(time) * b.rig->X_BC());
  }
  const ImuBiases biases = simulator_->imu_biases();
  const std::lock_guard hand(hand_);
  writer_->SetBiases(biases.gyro_rad_s, biases.accel_mps2);
  if (const palace::Status written = writer_->Add(b, b.stereo ? &depth_m : nullptr); !written) {
    return written.error();
  }
  return bundle;
}

Result<std::uint64_t> ExportingSource::Close() {
  const palace::Status closed = writer_->Close();
  return closed ? Result<std::uint64_t>(writer_->pairs()) : Result<std::uint64_t>(closed.error());
}

Status FlyMission(const SimulatedSession& session, std::shared_ptr<Source> source,
                  std::stop_token stop) {
  EngineParts parts;
  parts.settings = SettingsFor(session.vehicle);
  parts.mission.session_id = session.id;
  parts.source = std::move(source);
  parts.link = session.simulator;
  Engine engine(std::move(parts), /*threaded=*/false);
  ScriptedOperator pilot;
  while (!stop.stop_requested() && !pilot.finished() && engine.Step()) {
    for (const EngineCommand& command : pilot.Decide(*engine.Latest())) {
      engine.Post(command);
    }
  }
  return engine.error().empty() ? Ok() : UnavailableError(engine.error());
}

}  // namespace palace
