#include "engine/tools/simulate_command.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "engine/core/command_line.h"
#include "engine/core/termination.h"
#include "engine/journal/log_index.h"
#include "engine/journal/log_writer.h"
#include "engine/simulation/session.h"
#include "engine/trust/key_file.h"
#include "engine/wire/bus.h"
#include "engine/wire/channels.h"
#include "engine/wire/convert.h"
#include "engine/wire/lcm_link.h"

namespace palace {
namespace {

constexpr int kPoll_ms = 20;

struct SimulateOptions {
  std::string scenario = "runway";
  std::optional<std::string> url;
  std::string log;
  std::string channels_file;
  std::vector<std::string> keys;
  bool insecure = false;
  double duration_s = 600;
  double wind_mps = 0;
  std::uint64_t seed = 1;
  bool fast = false;
  bool realtime = false;
  bool no_pictures = false;
};

int Fail(const Error& error) {
  std::cerr << "palacectl simulate: " << error.message << "\n";
  return error.code == ErrorCode::kUsage ? 2 : 1;
}

/// With a log and no URL the flight is only recorded, and is the seed's to the bit.
bool IsOnABus(const SimulateOptions& options) { return options.url || options.log.empty(); }

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
  SessionSpec spec{.scenario = options.scenario,
                   .seed = options.seed,
                   .wind_mps = options.wind_mps,
                   .speed = options.fast ? 0.0 : 1.0,
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

/// Flies until the end, a signal or an error.
Result<std::uint64_t> Fly(Simulator& simulator, VehicleServer* server, LogWriter* log,
                          const ChannelNames& channels, std::stop_token stop) {
  std::jthread receiver;
  if (server != nullptr) {
    receiver = std::jthread([server](std::stop_token done) {
      while (!done.stop_requested() && server->Poll(kPoll_ms)) {
      }
    });
  }
  std::uint64_t bundles = 0;
  while (true) {
    const auto bundle = simulator.Next(stop);
    if (!bundle) {
      return bundle.error().code == ErrorCode::kEnd ? Result<std::uint64_t>(bundles)
                                                    : Result<std::uint64_t>(bundle.error());
    }
    ++bundles;
    Status done = server != nullptr ? server->Publish(**bundle) : Ok();
    if (log != nullptr) {
      for (const WireMessage& message : EncodeBundle(**bundle, channels)) {
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
      "touched down %.2f m north, %.2f m east; %.2f m/s down, %.2f m/s across, tilt %.1f deg%s\n",
      t->p_W_skid.x(), t->p_W_skid.y(), t->vertical_speed_mps, t->horizontal_speed_mps,
      t->tilt_rad * 57.29577951308232, t->on_object ? ", ON AN OBJECT" : "");
}

int Simulate(const SimulateOptions& options, const SceneCameraFactory& cameras) {
  if (!options.keys.empty() && !IsOnABus(options)) {
    return Fail(UsageError("--key is for stations on a bus; give --url too, or leave it out"));
  }
  std::stop_source flight;
  const Termination termination([flight]() mutable { flight.request_stop(); });
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
  std::unique_ptr<VehicleServer> server;
  if (IsOnABus(options)) {
    Result<std::shared_ptr<Bus>> bus = Bus::Open(options.url.value_or(""));
    if (!bus) {
      return Fail(bus.error());
    }
    for (const std::string& warning : (*bus)->warnings()) {
      std::cerr << "palacectl simulate: " << warning << "\n";
    }
    Result<std::unique_ptr<VehicleServer>> made = VehicleServer::Create(*bus, simulator, *channels);
    if (!made) {
      return Fail(made.error());
    }
    server = std::move(*made);
    std::printf("%s on %s, seed %llu\n", options.scenario.c_str(), (*bus)->url().c_str(),
                static_cast<unsigned long long>(options.seed));
    PrintTrust(options);
  }
  std::optional<LogWriter> log;
  if (!options.log.empty()) {
    Result<LogWriter> made = LogWriter::Create(options.log);
    if (!made) {
      return Fail(made.error());
    }
    log.emplace(std::move(*made));
  }
  const Result<std::uint64_t> bundles =
      Fly(simulator, server.get(), log ? &*log : nullptr, *channels, flight.get_token());
  const Status closed = log ? log->Close() : Ok();
  if (!bundles) {
    if (log && log->events() == 0) {  // no empty log stays behind
      std::error_code ignored;
      std::filesystem::remove(SidecarPath(options.log), ignored);
      std::filesystem::remove(options.log, ignored);
    }
    return Fail(bundles.error());
  }
  if (!closed) {
    return Fail(closed.error());
  }
  std::printf("%llu bundles", static_cast<unsigned long long>(*bundles));
  if (server) {
    std::printf(", %llu messages from stations, %llu could not be read%s%s",
                static_cast<unsigned long long>(server->received()),
                static_cast<unsigned long long>(server->refused()),
                server->refusal().empty() ? "" : ", the last: ", server->refusal().c_str());
  }
  std::printf("\n");
  PrintTouchdown(simulator);
  return 0;
}

}  // namespace

void AddSimulateCommand(CLI::App& app, int& exit_code, SceneCameraFactory cameras) {
  CLI::App* command =
      app.add_subcommand("simulate",
                         "Fly the simulated vehicle on an LCM bus or into a log. Ctrl-C, SIGTERM "
                         "and SIGHUP end it in order, exit 0");
  const auto options = std::make_shared<SimulateOptions>();
  command->add_option("--scenario", options->scenario, "runway, cones, slope or empty")
      ->capture_default_str();
  command->add_option("--url", options->url, "LCM URL; without --log the default bus");
  command->add_option("--duration-s", options->duration_s, "Longest simulated time")
      ->check(FiniteRange(0.001, 1e6))
      ->capture_default_str();
  command->add_option("--seed", options->seed, "One seed, one flight")
      ->check(Seed())
      ->capture_default_str();
  command->add_option("--wind-mps", options->wind_mps, "Mean wind at 20 ft")
      ->check(FiniteRange(0, 50));
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
  command->callback([options, &exit_code, cameras = std::move(cameras)] {
    exit_code = Simulate(*options, cameras);
  });
}

}  // namespace palace
