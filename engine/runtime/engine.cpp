#include "engine/runtime/engine.h"

#include <chrono>
#include <utility>

#include "engine/core/log.h"
#include "engine/model/mission/wave_off_offer.h"

namespace palace {
namespace {
constexpr double kWriteFirst_s = 0.1;
constexpr auto kEndWithin = std::chrono::seconds(3);
constexpr auto kEndHurriedWithin = std::chrono::seconds(1);

/// For the record: what was to go to the vehicle and did not leave.
Event NotSent(const VehicleMessage& message, Timestamp time) {
  const char* what = std::holds_alternative<AbortRequest>(message)  ? "A wave-off"
                     : std::holds_alternative<HoldRequest>(message) ? "A hold"
                     : std::holds_alternative<Approval>(message)    ? "An approval"
                     : std::holds_alternative<GoRequest>(message)   ? "A way to another hover"
                                                                    : "A message to the vehicle";
  return {.time = time,
          .kind = EventKind::kAlarm,
          .text = what + std::string(" could not be sent"),
          .level = AlarmLevel::kWarning};
}
}  // namespace

Engine::Engine(EngineParts parts, bool threaded)
    : source_(std::move(parts.source)),
      link_(std::move(parts.link)),
      redecide_with_(std::move(parts.redecide_with)),
      held_settings_(std::move(parts.held_settings)),
      record_(std::move(parts.record)),
      pipeline_(MakePipeline(parts.settings, std::move(parts.mission))),
      record_wanted_(parts.sink != nullptr),
      threaded_(threaded) {
  PALACE_CHECK(source_ != nullptr);
  if (parts.sink) {
    recorder_ = std::make_unique<Recorder>(std::move(parts.sink), threaded);
  }
  if (link_ && threaded) {
    stop_ = std::make_unique<StopSender>(link_, [this](const VehicleMessage& message, bool left) {
      if (recorder_) {
        RecordItem item;
        if (left) {
          item.sent = {message};
        } else {
          item.notes = {NotSent(message, {})};
        }
        recorder_->Record(std::move(item), /*may_wait=*/false);
      }
    });
  }
}

Engine::~Engine() { (void)Stop(); }

void Engine::Start() {
  PALACE_CHECK(threaded_);
  threads_running_ = 2;
  engine_thread_ = std::jthread([this](std::stop_token stop) { RunEngine(stop); });
  source_thread_ = std::jthread([this](std::stop_token stop) { RunSource(stop); });
}

Status Engine::Stop() {
  hung_ = false;
  if (source_thread_.joinable()) {
    source_thread_.request_stop();
    engine_thread_.request_stop();
    hung_ = !AwaitThreads();
    if (!hung_) {
      source_thread_.join();
      engine_thread_.join();
    }
  }
  const Status closed = recorder_ ? recorder_->Close() : Ok();
  if (!hung_ && recorder_ && recorder_->hung()) {
    hung_ = true;
    return closed;
  }
  return hung_ ? UnavailableError(
                     "the engine did not end within 3 s; the log is closed without "
                     "what it was working on")
               : closed;
}

bool Engine::AwaitThreads() {
  for (; threads_running_ > 0 && threads_ended_.try_acquire_for(kEndWithin); --threads_running_) {
  }
  if (threads_running_ > 0 && recorder_) {
    recorder_->HurryUp();  // it may be the disk that the engine waits for
    for (; threads_running_ > 0 && threads_ended_.try_acquire_for(kEndHurriedWithin);
         --threads_running_) {
    }
  }
  return threads_running_ == 0;
}

void Engine::Post(EngineCommand command) {
  if (stop_) {
    SendStop(command);
  }
  inbox_.Post(std::move(command));
}

void Engine::SendStop(const EngineCommand& command) {
  if (std::holds_alternative<WaveOff>(command.action)) {
    // Only what the mission will do too: it waves off nothing that stands on the ground.
    const std::shared_ptr<const EngineSnapshot> newest = latest_.Load();
    if (!newest ||
        WhyNoWaveOff(*newest, AgeNow(*newest, newest->time, MonotonicSeconds())).empty()) {
      stop_->WaveOff();
    }
  } else if (std::holds_alternative<HoldHere>(command.action)) {
    HoldDescent();
  }
}

/// Only what the mission will hold too; it refuses a hold where nothing descends.
void Engine::HoldDescent() {
  const std::shared_ptr<const EngineSnapshot> newest = latest_.Load();
  if (!link_ || !newest || !IsFlying(newest->flight->mission.state)) {
    return;
  }
  if (stop_) {
    stop_->Hold();
  } else {
    StopSender(link_).Hold();
  }
}

void Engine::Control(const PlaybackControl& control) {
  source_->Control(control);
  using Kind = PlaybackControl::Kind;
  if (control.kind == Kind::kSeek || control.kind == Kind::kStepBack ||
      control.kind == Kind::kStepForward || control.kind == Kind::kPlay) {
    jump_asked_ = true;
    ended_ = false;
  }
  TellOfSource();
}

Status Engine::Change(const SimulationChange& change) {
  if (const Status fit = CheckChange(change); !fit) {
    return fit;
  }
  const std::shared_ptr<const EngineSnapshot> newest = latest_.Load();
  if (newest && FindSimulationRow(change.name)->of_rig) {
    if (std::string why = WhyRigStays(newest->flight->mission.state); !why.empty()) {
      return UnavailableError(std::move(why));
    }
  }
  const Status changed = source_->Change(change);
  TellOfSource();
  return changed;
}

/// A paused source gives no bundle that could tell of it.
void Engine::TellOfSource() {
  if (threaded_) {
    inbox_.Wake();
  } else if (latest_.Load()) {
    HandleSafely({nullptr, {}}, {});
  }
}

bool Engine::Step() {
  PALACE_CHECK(!threaded_);
  const bool waits = source_->Status().paused && !jump_asked_;
  if (waits || ended_) {
    std::vector<EngineCommand> commands = inbox_.TakeCommands();
    if (!commands.empty()) {
      HandleSafely({nullptr, std::move(commands)}, {});
    }
    return !ended_;
  }
  jump_asked_ = false;
  Result<std::shared_ptr<const FrameBundle>> next = source_->Next({});
  if (!next) {
    Fail(next.error());
    return false;
  }
  return HandleSafely({*next, inbox_.TakeCommands()}, {});
}

void Engine::RunEngine(std::stop_token stop) {
  Inbox::Batch batch;
  bool alive = true;
  while (alive && inbox_.Take(batch, stop)) {
    watch_.Begin(MonotonicSeconds());
    alive = HandleSafely(std::exchange(batch, {}), stop);
    watch_.End();
    inbox_.Finished();
  }
  threads_ended_.release();
}

void Engine::Handle(Inbox::Batch batch) {
  if (!batch.bundle && !latest_.Load()) {
    // Nothing can be decided yet.
    early_.insert(early_.end(), batch.commands.begin(), batch.commands.end());
    return;
  }
  if (!early_.empty()) {
    batch.commands.insert(batch.commands.begin(), early_.begin(), early_.end());
    early_.clear();
  }
  if (batch.bundle && std::exchange(made_anew_, false)) {
    auto first = std::make_shared<FrameBundle>(*batch.bundle);
    first->discontinuity = true;  // in a replay too nothing is carried over the restart
    batch.bundle = std::move(first);
  }
  if (link_ && batch.bundle) {
    link_->Hear(*batch.bundle);
  }
  const SessionStatus session = Session();
  NoteCommandLost(session.authority, batch.commands);
  RecordItem item;
  item.bundle = batch.bundle;
  PipelineOutput output = batch.bundle
                              ? pipeline_->Process(batch.bundle, std::move(batch.commands), session)
                              : pipeline_->Refresh(std::move(batch.commands), session);
  item.commands = std::move(output.commands);
  item.snapshot = std::move(output.snapshot);
  item.sent = std::move(output.messages);
  if (link_ && MaySign(item.snapshot->session->role)) {
    for (VehicleMessage& message : item.sent) {
      link_->Seal(message);
    }
  }
  RecordAndSend(std::move(item));
}

/// I16: what was decided is in the log before it is acted on.
void Engine::RecordAndSend(RecordItem item) {
  const std::vector<VehicleMessage> messages = item.sent;
  const std::shared_ptr<const EngineSnapshot> snapshot = item.snapshot;
  if (recorder_) {
    Record(std::move(item));
  }
  if (link_) {
    for (const VehicleMessage& message : messages) {
      // An estimate that is lost is soon replaced; losses.messages_unsent counts it.
      if (!link_->Send(message) && !std::holds_alternative<PositionEstimate>(message)) {
        notes_.push_back(NotSent(message, snapshot->time));
      }
    }
    link_->Announce(*snapshot);
  }
  latest_.Store(snapshot);
}

void Engine::Record(RecordItem item) {
  item.notes = std::exchange(notes_, {});
  const Timestamp time = item.snapshot->time;
  recorded_ = true;
  if (!DecidesSomething(item)) {
    recorder_->Record(std::move(item), source_->IsLockstep());
    return;
  }
  const Written written =
      recorder_->RecordFirst(std::move(item), source_->IsLockstep(), kWriteFirst_s);
  if (written == Written::kLate) {
    notes_.push_back(
        {.time = time,
         .kind = EventKind::kAlarm,
         .text = "A decision was sent before it was written: the disk takes longer than 0.1 s",
         .level = AlarmLevel::kCaution});
  } else if (written == Written::kNo) {
    notes_.push_back({.time = time,
                      .kind = EventKind::kAlarm,
                      .text = "A decision was sent that could not be written before: " +
                              recorder_->state().problem,
                      .level = AlarmLevel::kCaution});
  }
}

bool Engine::DecidesSomething(const RecordItem& item) const {
  bool told = !item.commands.empty();
  for (const VehicleMessage& message : item.sent) {
    if (std::holds_alternative<AbortRequest>(message)) {
      return false;  // waits for nothing
    }
    told = told || !std::holds_alternative<PositionEstimate>(message);
  }
  const auto last = latest_.Load();
  return told || !last || last->flight->mission.state != item.snapshot->flight->mission.state;
}

void Engine::NoteCommandLost(const AuthorityStatus& authority,
                             std::vector<EngineCommand>& commands) {
  if (std::exchange(commanded_, authority.commands()) && !authority.commands()) {
    // As a command it is in the record, so a replay drops what the flight dropped.
    commands.insert(commands.begin(), {CommandOrigin::kStation, CommandLost{authority.why_not}});
  }
}

SessionStatus Engine::Session() const {
  SessionStatus session;
  session.source = source_->Status();
  session.can_transmit = link_ != nullptr;
  session.authority = link_ ? link_->Authority() : AuthorityStatus{};
  session.recording = recorder_ && recorder_->ok();
  session.recorder_ok = !record_wanted_ || session.recording;
  if (recorder_) {
    session.recording_path = recorder_->path();
    session.record = recorder_->state();
  }
  if (fault_passes_ > 0) {
    session.engine_stop = watch_.LastStop();
  } else if (source_fault_passes_ > 0) {
    session.engine_stop = source_watch_.LastStop();
  }
  session.losses = source_->Lost();
  const Losses overtaken = inbox_.losses();
  session.losses.pairs_replaced += overtaken.pairs_replaced;
  session.losses.samples_overflowed += overtaken.samples_overflowed;
  session.losses.records_dropped = recorder_ ? recorder_->dropped() : 0;
  session.losses.messages_unsent = link_ ? link_->Unsent() : 0;
  return session;
}

void Engine::Fail(const Error& error) {
  ended_ = true;
  if (error.code == ErrorCode::kEnd) {
    return;
  }
  const std::lock_guard lock(error_mutex_);
  error_ = error.message;
  LogError(error.message);
}

std::string Engine::error() const {
  const std::lock_guard lock(error_mutex_);
  return error_;
}

}  // namespace palace
