// Session: one source, its way to the vehicle and its log, made from the command line.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "engine/core/result.h"
#include "engine/faults/faulted_source.h"
#include "engine/model/flight_record.h"
#include "engine/runtime/engine.h"
#include "engine/simulation/simulator.h"
#include "engine/world/world.h"
#include "gui/app/options.h"
#include "gui/render/vehicle_body.h"

namespace palace {

struct Session {
  std::unique_ptr<Engine> engine;
  std::filesystem::path
      output_dir;  ///< log, screenshots and report of this session; may not exist yet
  std::shared_ptr<Simulator> simulator;         ///< simulation only
  std::shared_ptr<FaultedSource> faulted;       ///< simulation only: round the simulator
  std::optional<World> scene;                   ///< simulation only
  VehicleBody body = VehicleBody::kHelicopter;  ///< of the vehicle that the command line names
  std::shared_ptr<const FlightRecord> record;   ///< replay only
  std::shared_ptr<Source> source;
  bool recorded = false;  ///< by this session, into output_dir
};

/// Opens source, link and log. Errors name the thing and the remedy; nothing half-written remains.
/// `threaded` false: the caller steps the engine.
Result<Session> OpenSession(const AppOptions& options, bool threaded);

/// "2026-11-20_14-32-07", of now: names the folder of a flight.
std::string TimeStampName();

}  // namespace palace
