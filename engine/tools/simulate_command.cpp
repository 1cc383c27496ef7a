#include "engine/tools/simulate_command.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "engine/core/command_line.h"
#include "engine/core/text.h"
#include "engine/core/units.h"
#include "engine/faults/fault_injector.h"
#include "engine/faults/fault_plan.h"
#include "engine/journal/log_index.h"
#include "engine/journal/log_writer.h"
#include "engine/model/mission/fault_events.h"
#include "engine/simulation/session.h"
#include "engine/simulation/vehicle_file.h"
#include "engine/tools/simulate_end.h"
#include "engine/tools/simulate_export.h"
#include "engine/trust/key_file.h"
#include "engine/wire/bus.h"
#include "engine/wire/channels.h"
#include "engine/wire/convert.h"
#include "engine/wire/lcm_link.h"
#include "engine/world/scene_library.h"

namespace palace {
namespace {

constexpr int kPoll_ms = 20;

struct SimulateOptions {
  std::string scenario = "runway";
  std::string vehicle = kDefaultVehicle;
  std::optional<std::string> url;
  std::string log;
  std::string export_folder;
  bool land = false;
  std::string channels_file;
  std::vector<std::string> keys;
  bool insecure = false;
  double duration_s = 600;
  double wind_mps = 0;
  std::uint64_t seed = 1;
  bool fast = false;
  bool realtime = false;
  bool no_pictures = false;
  std::vector<std::string> faults;
  std::string faults_file;
};

int Fail(const Error& error) {
  std::cerr << "palacectl simulate: " << error.message << "\n";
  return error.code == ErrorCode::kUsage ? 2 : 1;
}

constexpr double kExported_s = 10;  // of a hover, unless the duration is given

/// With a log or an export and no URL the flight is only recorded, and is the seed's to the bit.
bool IsOnABus(const SimulateOptions& options) {
  return options.url || (options.log.empty() && options.export_folder.empty());
}

/// A flight that is exported is watched by nobody, unless a station takes part.
bool IsPaced(const SimulateOptions& options) {
  return !options.fast && (IsOnABus(options) || options.export_folder.empty());
}

Status CheckOptions(const SimulateOptions& options) {
  if (options.url && options.url->find_first_not_of(" \t") == std::string::npos) {
    return UsageError(
        "--url is empty, which LCM takes for its default bus; name one, e.g. "
        "udpm://239.255.76.67:7667?ttl=0, or leave --url out");
  }
  if (!options.keys.empty() && !IsOnABus(options)) {
    return UsageError("--key is for stations on a bus; give --url too, or leave it out");
  }
  if (!options.export_folder.empty() && options.no_pictures) {
    return UsageError("--export writes pictures; leave --no-pictures out");
  }
  if (options.land &&
      (options.export_folder.empty() || IsOnABus(options) || !options.log.empty())) {
    return UsageError(
        "--land goes with --export alone: on a bus a station lands the vehicle, and palace "
        "records its missions itself");
  }
  if (!options.export_folder.empty() && (!options.faults.empty() || !options.faults_file.empty())) {
    return UsageError("--export writes what the sensors truly measured; leave the faults out");
  }
  return Ok();
}

/// A station seals what it sends for the vehicle's clock, and this vehicle keeps its own.
Status CheckPlan(const SimulateOptions& options, const FaultPlan& plan) {
  for (const Fault& fault : plan.faults) {
    const bool of_clock = fault.kind == FaultKind::kClockStep ||
                          fault.kind == FaultKind::kClockDrift || fault.kind == FaultKind::kRestart;
    if (of_clock && IsOnABus(options)) {
      return UsageError(std::string("fault ") + RowOf(fault.kind).name +
                        " is not for a bus: seals are checked on the vehicle's own clock; fly it "
                        "with palace, or into a log without --url");
    }
  }
  return Ok();
}

/// The keys of the stations that may command. --insecure: no seals are asked for.
Result<SessionSpec::OtherStations> StationsOf(const SimulateOptions& options) {
  SessionSpec::OtherStations stations;
  if (!options.insecure) {
    stations.keys.emplace();
  }
  for (const std::string& wanted : options.keys) {
    const Result<NamedKey> key = FindKey(wanted, DefaultKeyFolder());
    if (!key) {
      return key.error();
    }
    stations.keys->push_back(key->key);
    std::printf("key %s, fingerprint %s\n", key->name.c_str(),
                FingerprintText(key->key.id()).c_str());
  }
  return stations;
}

Result<SimulatedSession> OpenSession(const SimulateOptions& options, SceneCameraFactory cameras) {
  Result<VehicleDescription> vehicle = LoadVehicle(options.vehicle);
  if (!vehicle) {
    return vehicle.error();
  }
  SessionSpec spec{.scenario = options.scenario,
                   .seed = options.seed,
                   .vehicle = std::move(*vehicle),
                   .wind_mps = options.wind_mps,
                   .speed = IsPaced(options) ? 1.0 : 0.0,
                   .duration_limit_s = options.duration_s,
                   .render = !options.no_pictures};
  if (IsOnABus(options)) {
    const Result<SessionSpec::OtherStations> stations = StationsOf(options);
    if (!stations) {
      return stations.error();
    }
    spec.other_stations = *stations;
  }
  return OpenSimulatedSession(spec, std::move(cameras));
}

/// What the vehicle will do with commands, said before it flies.
void PrintTrust(const SimulateOptions& options) {
  if (options.insecure) {
    std::printf("INSECURE: seals are not checked, whoever is on the bus may fly this vehicle\n");
    std::fprintf(stderr, "palacectl simulate: --insecure: any command on the bus is obeyed\n");
  } else if (options.keys.empty()) {
    std::printf("no key: every command but ABORT is refused; give --key NAME or --insecure\n");
  }
  std::fflush(stdout);
}

/// What begins and ends to act, told on the terminal and in the log, never on the bus: a station
/// must find out by itself.
class FaultTeller {
 public:
  std::vector<WireMessage> Tell(FaultInjector& faults, Timestamp now,
                                const ChannelNames& channels) {
    const std::vector<std::string> before = std::exchange(acting_, faults.TakeActing());
    std::vector<WireMessage> told;
    for (const Event& event : FaultEvents(before, acting_, now)) {
      std::printf("%8.1f s  %s\n", faults.now_s(), event.text.c_str());
      std::fflush(stdout);
      told.push_back(EncodeEvent(event, channels));
    }
    return told;
  }

 private:
  std::vector<std::string> acting_;
};

/// Flies until the end, a signal or an error.
Result<std::uint64_t> Fly(Source& source, FaultInjector& faults, VehicleServer* server,
                          LogWriter* log, const ChannelNames& channels, SimulateEnd& end) {
  FaultTeller teller;
  std::jthread receiver;
  if (server != nullptr) {
    receiver = std::jthread([server](std::stop_token done) {
      while (!done.stop_requested() && server->Poll(kPoll_ms)) {
      }
    });
  }
  std::uint64_t bundles = 0;
  while (true) {
    const auto bundle = source.Next(end.stop());
    if (!bundle) {
      end.EndUnflown();
      end.Over();
      return bundle.error().code == ErrorCode::kEnd ? Result<std::uint64_t>(bundles)
                                                    : Result<std::uint64_t>(bundle.error());
    }
    ++bundles;
    const std::lock_guard hand(end.hand());
    end.HaveFlown();
    std::vector<WireMessage> sent =
        faults.touched() ? faults.Strike(**bundle) : EncodeBundle(**bundle, channels);
    Status done = server != nullptr ? server->Publish(sent, (*bundle)->time) : Ok();
    for (WireMessage& message : teller.Tell(faults, (*bundle)->time, channels)) {
      sent.push_back(std::move(message));
    }
    if (log != nullptr) {
      for (const WireMessage& message : sent) {
        done = done ? log->Write(message) : done;
      }
      done = done ? log->Flush() : done;
    }
    if (!done) {
      return done.error();
    }
  }
}

void PrintTouchdown(const Simulator& simulator) {
  const Touchdown* t = simulator.touchdown();
  if (t == nullptr) {
    std::printf("did not touch down\n");
    return;
  }
  std::printf(
      "touched down %.2f m north, %.2f m east; %.2f m/s down, %.2f m/s across, tilt %.1f deg on %s "
      "of %.1f deg%s\n",
      t->p_W_skid.x(), t->p_W_skid.y(), t->vertical_speed_mps, t->horizontal_speed_mps,
      Deg(t->tilt_rad), t->on_object ? "AN OBJECT, a slope" : "the ground, a slope",
      Deg(t->ground_tilt_rad), t->hard() ? ", HARDER THAN THE GEAR IS MADE FOR" : "");
}

int EndExport(ExportingSource& exporter, const Simulator& simulator, const Status& flown) {
  const Result<std::uint64_t> pairs = exporter.Close();
  if (!flown || !pairs) {
    return Fail(flown ? pairs.error() : flown.error());
  }
  std::printf("%llu pairs exported\n", static_cast<unsigned long long>(*pairs));
  PrintTouchdown(simulator);
  return 0;
}

/// The vehicle's end of the bus; null where none is asked for.
Result<std::unique_ptr<VehicleServer>> OpenServer(const SimulateOptions& options,
                                                  Simulator& simulator,
                                                  const ChannelNames& channels) {
  if (!IsOnABus(options)) {
    return std::unique_ptr<VehicleServer>();
  }
  Result<std::shared_ptr<Bus>> bus = Bus::Open(options.url.value_or(""));
  if (!bus) {
    return bus.error();
  }
  for (const std::string& warning : (*bus)->warnings()) {
    std::cerr << "palacectl simulate: " << warning << "\n";
  }
  auto server = VehicleServer::Create(*bus, simulator, channels);
  if (server) {
    std::printf("%s on %s, seed %llu\n", options.scenario.c_str(), (*bus)->url().c_str(),
                static_cast<unsigned long long>(options.seed));
    PrintTrust(options);
  }
  return server;
}

/// Flies into the log, if one is asked for.
Result<std::uint64_t> FlyIntoLog(const SimulateOptions& options, Source& source,
                                 FaultInjector& faults, VehicleServer* server,
                                 const ChannelNames& channels, SimulateEnd& end) {
  if (options.log.empty()) {
    return Fly(source, faults, server, nullptr, channels, end);
  }
  std::unique_lock hand(end.hand());
  Result<LogWriter> log = LogWriter::Create(options.log);
  if (!log) {
    return log.error();
  }
  end.Writes(&*log);
  hand.unlock();
  Result<std::uint64_t> bundles = Fly(source, faults, server, &*log, channels, end);
  end.Over();
  const Status closed = log->Close();
  if (!bundles && log->events() == 0) {  // no empty log stays behind
    std::error_code ignored;
    std::filesystem::remove(SidecarPath(options.log), ignored);
    std::filesystem::remove(options.log, ignored);
  }
  return bundles && !closed ? Result<std::uint64_t>(closed.error()) : bundles;
}

int Simulate(const SimulateOptions& options, const SceneCameraFactory& cameras) {
  if (const Status good = CheckOptions(options); !good) {
    return Fail(good.error());
  }
  const Result<FaultPlan> plan = ReadFaultPlan(options.faults_file, options.faults);
  if (!plan) {
    return Fail(plan.error());
  }
  if (const Status fits = CheckPlan(options, *plan); !fits) {
    return Fail(fits.error());
  }
  SimulateEnd end;
  const Result<SimulatedSession> session = OpenSession(options, cameras);
  if (!session) {
    return Fail(session.error());
  }
  Simulator& simulator = *session->simulator;
  const Result<ChannelNames> channels = options.channels_file.empty()
                                            ? Result<ChannelNames>(ChannelNames())
                                            : LoadChannels(options.channels_file);
  if (!channels) {
    return Fail(channels.error());
  }
  const Result<std::unique_ptr<VehicleServer>> server = OpenServer(options, simulator, *channels);
  if (!server) {
    return Fail(server.error());
  }
  std::shared_ptr<Source> source = session->simulator;
  std::shared_ptr<ExportingSource> exporter;
  if (!options.export_folder.empty()) {
    auto made = ExportingSource::Create(*session, options.export_folder, end.hand());
    if (!made) {
      return Fail(made.error());
    }
    source = exporter = std::move(made).value();
    const std::lock_guard hand(end.hand());
    end.Writes(exporter.get());
  }
  if (options.land) {
    const Status flown = FlyMission(*session, source, end.stop());
    end.Over();
    return EndExport(*exporter, simulator, flown);
  }
  FaultInjector faults(options.seed, *channels);
  if (const Status planned = faults.Add(*plan); !planned) {
    return Fail(planned.error());
  }
  const Result<std::uint64_t> bundles =
      FlyIntoLog(options, *source, faults, server->get(), *channels, end);
  if (!bundles) {
    return Fail(bundles.error());
  }
  std::printf("%llu bundles", static_cast<unsigned long long>(*bundles));
  if (*server) {
    const VehicleServer& bus = **server;
    std::printf(", %llu messages from stations, %llu could not be read%s%s",
                static_cast<unsigned long long>(bus.received()),
                static_cast<unsigned long long>(bus.refused()),
                bus.refusal().empty() ? "" : ", the last: ", bus.refusal().c_str());
  }
  std::printf("\n");
  if (exporter) {
    return EndExport(*exporter, simulator, Ok());
  }
  PrintTouchdown(simulator);
  return 0;
}

}  // namespace

void AddSimulateCommand(CLI::App& app, int& exit_code, SceneCameraFactory cameras) {
  CLI::App* command =
      app.add_subcommand("simulate",
                         "Fly the simulated vehicle on an LCM bus, into a log or into a folder "
                         "of EuRoC's layout. Ctrl-C, SIGTERM "
                         "and SIGHUP end it in order, exit 0; before the first bundle it "
                         "leaves nothing, exit 128 + signal");
  const auto options = std::make_shared<SimulateOptions>();
  command
      ->add_option("--scenario", options->scenario,
                   SceneList() + "; what each is: palacectl worlds")
      ->capture_default_str();
  command
      ->add_option("--vehicle", options->vehicle,
                   "A vehicle by name (" + Joined(VehicleNames()) + ") or by its file")
      ->capture_default_str();
  command->add_option("--url", options->url, "LCM URL; without --log or --export the default bus");
  command->add_option("--export", options->export_folder,
                      "Write a folder in EuRoC's layout: synchronous stereo, true depth, IMU, "
                      "truth, navigation. Without --url a hover of 10 s (--duration-s), as fast as "
                      "possible");
  command->add_flag("--land", options->land,
                    "With --export: the whole mission, a scripted operator in command");
  command->add_option("--duration-s", options->duration_s, "Longest simulated time")
      ->check(FiniteRange(0.001, 1e6))
      ->capture_default_str();
  command->add_option("--seed", options->seed, "One seed, one flight")
      ->check(Seed())
      ->capture_default_str();
  command->add_option("--wind-mps", options->wind_mps, "Mean wind at 20 ft")
      ->check(FiniteRange(0, 50));
  command->add_option("--fault", options->faults, kFaultHelp);
  command->add_option("--faults", options->faults_file, kFaultsHelp);
  command->add_option("--log", options->log, "Record to this LCM log (and its .idx)");
  command->add_option("--channels", options->channels_file, "Channel names (TOML)");
  CLI::Option* key = command->add_option("--key", options->keys,
                                         "Key of a station that may command: a name (palacectl "
                                         "trust list) or a file; may be repeated");
  command
      ->add_flag("--insecure", options->insecure,
                 "Obey unsealed commands of anybody on the bus: for a bench alone")
      ->excludes(key);
  CLI::Option* realtime =
      command->add_flag("--realtime", options->realtime, "Simulated time is real time (default)");
  command->add_flag("--fast", options->fast, "As fast as possible")->excludes(realtime);
  command->add_flag("--no-pictures", options->no_pictures, "Sensors only, no cameras");
  command->callback([options, command, &exit_code, cameras = std::move(cameras)] {
    if (!IsOnABus(*options) && !options->export_folder.empty() && !options->land &&
        command->count("--duration-s") == 0) {
      options->duration_s = kExported_s;
    }
    exit_code = Simulate(*options, cameras);
  });
}

}  // namespace palace
