// Engine: the threads around the pipeline. One source thread, one engine thread, one recorder
// thread, one thread for stops; or none at all, stepped by the caller, with the same results.
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "engine/core/latest_value.h"
#include "engine/runtime/inbox.h"
#include "engine/runtime/pipeline.h"
#include "engine/runtime/recorder.h"
#include "engine/runtime/source.h"
#include "engine/runtime/stop_sender.h"
#include "engine/runtime/vehicle_link.h"

namespace palace {

struct EngineParts {
  std::shared_ptr<Source> source;
  std::shared_ptr<VehicleLink> link;  ///< null: nothing can transmit (replay, images)
  std::unique_ptr<RecordSink> sink;   ///< null: not recorded
  Settings settings;
  std::optional<Settings> redecide_with;     ///< replay: judge under these instead of the recorded
  std::vector<std::string> held_settings{};  ///< replay: ReplaySettings::held
  std::shared_ptr<const FlightRecord> record;  ///< replay: what the flight decided
  MissionOptions mission;
};

class Engine {
 public:
  explicit Engine(EngineParts parts, bool threaded);
  ~Engine();
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  /// Starts the threads. Only for a threaded engine.
  void Start();
  /// Ends the threads and closes the log. The recorder's first error, if any.
  Status Stop();

  /// The newest snapshot; null before the first.
  std::shared_ptr<const EngineSnapshot> Latest() const { return latest_.Load(); }
  /// From any thread. A wave-off, and a hold of a descent, also leave at once by a path of their
  /// own.
  void Post(EngineCommand command);
  void Control(const PlaybackControl& control);

  /// Without threads: takes the next bundle and processes it in the caller's thread; while the
  /// source is paused or ended only commands are handled. False when the source has ended; error()
  /// then says whether that was a failure.
  bool Step();

  /// Set when the source failed (not when it merely ended).
  std::string error() const;
  bool ended() const { return ended_.load(); }

 private:
  void RunSource(std::stop_token stop);
  void RunEngine(std::stop_token stop);
  void Handle(Inbox::Batch batch);
  void SendStop(const EngineCommand& command);
  SessionStatus Session() const;
  void Fail(const Error& error);

  std::shared_ptr<Source> source_;
  std::shared_ptr<VehicleLink> link_;
  Pipeline pipeline_;
  std::unique_ptr<Recorder> recorder_;
  const bool record_wanted_;
  const bool threaded_;
  std::unique_ptr<StopSender> stop_;
  Inbox inbox_;
  std::vector<EngineCommand> early_;  ///< given before the first bundle, applied with it
  LatestValue<EngineSnapshot> latest_;
  std::atomic<bool> ended_{false};
  std::atomic<bool> jump_asked_{false};  ///< a paused source still has one bundle to give
  mutable std::mutex error_mutex_;
  std::string error_;
  std::jthread source_thread_;
  std::jthread engine_thread_;
};

}  // namespace palace
