#include "gui/app/session.h"

#include <ctime>
#include <random>

#include "engine/capture/cameras.h"
#include "engine/capture/image_folder_source.h"
#include "engine/core/log.h"
#include "engine/core/units.h"
#include "engine/faults/fault_plan.h"
#include "engine/journal/flight_recorder.h"
#include "engine/journal/replay_source.h"
#include "engine/runtime/settings_io.h"
#include "engine/simulation/session.h"
#include "engine/simulation/vehicle_file.h"
#include "engine/trust/key_file.h"
#include "engine/wire/lcm_link.h"
#include "engine/wire/lcm_source.h"
#include "gui/app/channels_file.h"
#include "gui/app/station_key.h"
#include "gui/platform/offscreen_scene_camera.h"

namespace palace {
namespace {

Status OpenSimulation(const AppOptions& options, const VehicleDescription& vehicle, bool paced,
                      Session& session, EngineParts& parts) {
  const Result<FaultPlan> plan = ReadFaultPlan(options.faults_file, options.faults);
  if (!plan) {
    return plan.error();
  }
  Result<SimulatedSession> simulated = OpenSimulatedSession({.scenario = options.scenario,
                                                             .seed = options.seed,
                                                             .vehicle = vehicle,
                                                             .wind_mps = options.wind_mps,
                                                             .speed = paced ? 1.0 : 0.0},
                                                            MakeOffscreenSceneCamera);
  if (!simulated) {
    return simulated.error();
  }
  parts.mission.session_id = simulated->id;
  session.simulator = simulated->simulator;
  session.scene = std::move(simulated->scene);
  session.faulted =
      std::make_shared<FaultedSource>(session.simulator, session.simulator, options.seed);
  session.source = session.faulted;
  parts.source = session.faulted;
  parts.link = session.faulted;
  return session.faulted->faults().Add(*plan);
}

Status OpenReplay(const AppOptions& options, bool paced, Session& session, EngineParts& parts) {
  ReplayOptions replay;
  replay.speed = paced ? 1 : 0;
  replay.wait_at_end = paced;
  replay.part = options.replay_part;
  const Result<ChannelNames> channels = ChannelsFor(options);
  if (!channels) {
    return channels.error();
  }
  replay.channels = *channels;
  Result<std::unique_ptr<ReplaySource>> source = ReplaySource::Open(options.source_path, replay);
  if (!source) {
    return source.error();
  }
  session.record = (*source)->recorded();
  parts.record = session.record;
  const Result<ReplaySettings> settings = SettingsOfReplay(options.settings, *session.record);
  if (!settings) {
    return settings.error();
  }
  parts.settings = settings->settings;
  parts.redecide_with = settings->redecide_with;
  parts.held_settings = settings->held;
  session.source = std::move(*source);
  parts.source = session.source;
  return Ok();
}

Status OpenImages(const AppOptions& options, Session& session, EngineParts& parts) {
  Result<std::unique_ptr<ImageFolderSource>> source =
      ImageFolderSource::Open(options.source_path, /*loop=*/true);
  if (!source) {
    return source.error();
  }
  session.source = std::move(*source);
  parts.source = session.source;
  return Ok();
}

Status OpenCameraSource(const AppOptions& options, bool paced, Session& session,
                        EngineParts& parts) {
  Result<std::unique_ptr<Source>> source = OpenCameras(options.source_path, /*wait_at_end=*/paced);
  if (!source) {
    return source.error();
  }
  session.source = std::move(*source);
  parts.source = session.source;
  return Ok();
}

Status OpenBus(const AppOptions& options, Session& session, EngineParts& parts) {
  Result<std::shared_ptr<Bus>> bus = Bus::Open(options.source_path);
  if (!bus) {
    return bus.error();
  }
  const Result<ChannelNames> channels = ChannelsFor(options);
  if (!channels) {
    return channels.error();
  }
  for (const std::string& warning : (*bus)->warnings()) {
    LogWarning(warning);
  }
  Result<StationTrust> trust = StationTrustFor(options.key, DefaultKeyFolder());
  if (!trust) {
    return trust.error();
  }
  const auto link = std::make_shared<LcmLink>(*bus, *channels, std::move(*trust));
  LcmSourceOptions live;
  live.overheard = [link](const WireMessage& message) { link->Overhear(message); };
  Result<std::unique_ptr<LcmSource>> source = LcmSource::Create(*bus, *channels, std::move(live));
  if (!source) {
    return source.error();
  }
  std::random_device device;
  parts.mission.session_id = (std::uint64_t{device()} << 32) | device();
  session.source = std::move(*source);
  parts.source = session.source;
  parts.link = link;
  return Ok();
}

Status OpenSource(const AppOptions& options, const VehicleDescription& vehicle, bool paced,
                  Session& session, EngineParts& parts) {
  switch (options.source) {
    case SourceChoice::kSimulation:
      return OpenSimulation(options, vehicle, paced, session, parts);
    case SourceChoice::kReplay:
      return OpenReplay(options, paced, session, parts);
    case SourceChoice::kImages:
      return OpenImages(options, session, parts);
    case SourceChoice::kCameras:
      return OpenCameraSource(options, paced, session, parts);
    case SourceChoice::kConnect:
      return OpenBus(options, session, parts);
  }
  PALACE_CHECK(false);
}

}  // namespace

std::string TimeStampName() {
  const std::time_t now = static_cast<std::time_t>(WallTime().us / 1'000'000);
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%d_%H-%M-%S", &utc);
  return text;
}

Result<Session> OpenSession(const AppOptions& options, bool threaded) {
  Session session;
  EngineParts parts;
  const Result<VehicleDescription> vehicle =
      LoadVehicle(options.vehicle.empty() ? kDefaultVehicle : options.vehicle);
  if (!vehicle) {
    return vehicle.error();
  }
  if (std::holds_alternative<MultirotorParameters>(vehicle->model)) {
    session.body = VehicleBody::kMultirotor;
  }
  if (options.source != SourceChoice::kReplay) {
    const Result<Settings> settings =
        SettingsOfCommandLine(SettingsFor(*vehicle), options.settings.file, options.settings.set);
    if (!settings) {
      return settings.error();
    }
    parts.settings = *settings;
  }
  const Status source = OpenSource(options, *vehicle, threaded, session, parts);
  if (!source) {
    return source.error();
  }
  std::string stamp = TimeStampName();
  // A folder that cannot be examined is told by the recorder, with what helps.
  std::error_code ignored;
  for (int n = 2; std::filesystem::exists(options.record_dir / stamp, ignored); ++n) {
    stamp = TimeStampName() + "_" + std::to_string(n);
  }
  session.output_dir = options.record_dir / stamp;
  // Films are on disk already.
  session.recorded = options.record && session.source->Status().kind != SourceKind::kVideo;
  if (session.recorded) {
    Result<std::unique_ptr<FlightRecorder>> recorder =
        FlightRecorder::Open(options.record_dir, stamp);
    if (!recorder) {
      return recorder.error();
    }
    parts.sink = std::move(*recorder);
  }
  session.engine = std::make_unique<Engine>(std::move(parts), threaded);
  return session;
}

}  // namespace palace
