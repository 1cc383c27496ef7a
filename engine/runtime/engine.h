// Engine: the threads around the pipeline. One source thread, one engine thread, one recorder
// thread, one thread for stops; or none at all, stepped by the caller, with the same results.
//
// What was decided is recorded before it is sent: a pass with a command, a change of state or a
// message other than an estimate waits until it is written, at most 0.1 s, because a hold that
// waits for a disk would be the greater harm. A wave-off waits for nothing.
//
// An exception in any thread ends no program. The pipeline is made anew, three times, at least 5 s
// apart: with the limits in force, without mission, site or approval; a vehicle that descends is
// told to hold first.
#pragma once

#include <atomic>
#include <memory>
#include <semaphore>
#include <string>
#include <thread>
#include <vector>

#include "engine/core/latest_value.h"
#include "engine/runtime/engine_watch.h"
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
  /// Ends the threads and closes the log. The recorder's error, if any. Threads that do not end
  /// within 3 s, and a disk that stands still for 5 s, are left alone: an error too, and the Engine
  /// must not be destroyed while hung().
  Status Stop();
  bool hung() const { return hung_; }

  /// The newest snapshot; null before the first.
  std::shared_ptr<const EngineSnapshot> Latest() const { return latest_.Load(); }
  /// From any thread. A wave-off, and a hold of a descent, also leave at once by a path of their
  /// own.
  void Post(EngineCommand command);
  /// Publishes a snapshot that tells of it, also where the source gives nothing more.
  void Control(const PlaybackControl& control);
  /// Changes what is simulated. Refused: what CheckChange says, another source than the built-in
  /// simulation, and another rig while a site is armed or flown to (WhyRigStays).
  Status Change(const SimulationChange& change);

  /// Without threads: takes the next bundle and processes it in the caller's thread; while the
  /// source is paused or ended only commands are handled. False when the source has ended; error()
  /// then says whether that was a failure.
  bool Step();

  /// Set when the source or the engine failed for good (not when a source merely ended).
  std::string error() const;
  bool ended() const { return ended_.load(); }
  /// What a person must know of an engine that does not answer; empty while it does. Any thread,
  /// whatever the engine does.
  std::string Complaint() const;

 private:
  void RunSource(std::stop_token stop);
  void TellOfSource();
  bool Feed(std::stop_token stop);
  void RunEngine(std::stop_token stop);
  bool HandleSafely(const Inbox::Batch& batch, std::stop_token stop);
  void Handle(Inbox::Batch batch);
  void RecordAndSend(RecordItem item);
  void Record(RecordItem item);
  bool DecidesSomething(const RecordItem& item) const;
  bool StartAgain(const Inbox::Batch& failed, const std::string& reason, std::stop_token stop);
  bool SourceStopped(const std::string& reason, std::stop_token stop);
  bool AwaitThreads();
  bool AwaitRestart(double at_s, std::stop_token stop) const;
  std::unique_ptr<Pipeline> MakePipeline(const Settings& settings, MissionOptions mission) const;
  void HoldDescent();
  void SendStop(const EngineCommand& command);
  SessionStatus Session() const;
  /// Another station commands now, or nobody does: a command of this program's own says so.
  void NoteCommandLost(const AuthorityStatus& authority, std::vector<EngineCommand>& commands);
  void Fail(const Error& error);

  std::shared_ptr<Source> source_;
  std::shared_ptr<VehicleLink> link_;
  const std::optional<Settings> redecide_with_;
  const std::vector<std::string> held_settings_;
  const std::shared_ptr<const FlightRecord> record_;
  std::unique_ptr<Pipeline> pipeline_;
  std::unique_ptr<Recorder> recorder_;
  const bool record_wanted_;
  const bool threaded_;
  std::unique_ptr<StopSender> stop_;
  Inbox inbox_;
  bool commanded_ = false;             ///< at the last pass this station commanded
  std::vector<EngineCommand> early_;   ///< given before the first bundle, applied with it
  std::vector<Event> notes_;           ///< of the engine itself, for the record
  std::atomic<int> source_faults_{0};  ///< stops of the source, so far
  int source_faults_told_ = 0;
  bool recorded_ = false;        ///< the batch in hand
  bool made_anew_ = false;       ///< and has seen no bundle since
  int fault_passes_ = 0;         ///< how many more tell what stopped the engine
  int source_fault_passes_ = 0;  ///< or the source
  LatestValue<EngineSnapshot> latest_;
  EngineWatch watch_;
  EngineWatch source_watch_;
  std::atomic<bool> ended_{false};
  std::atomic<bool> jump_asked_{false};  ///< a paused source still has one bundle to give
  bool hung_ = false;
  mutable std::mutex error_mutex_;
  std::string error_;
  std::counting_semaphore<2> threads_ended_{0};
  int threads_running_ = 0;
  std::jthread source_thread_;
  std::jthread engine_thread_;
};

}  // namespace palace
