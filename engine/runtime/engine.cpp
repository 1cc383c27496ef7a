#include "engine/runtime/engine.h"

#include <utility>

#include "engine/core/log.h"

namespace palace {

Engine::Engine(EngineParts parts, bool threaded)
    : source_(std::move(parts.source)),
      link_(std::move(parts.link)),
      pipeline_(parts.settings, std::move(parts.mission)),
      record_wanted_(parts.sink != nullptr),
      threaded_(threaded) {
  PALACE_CHECK(source_ != nullptr);
  pipeline_.FollowRecord(std::move(parts.record));
  if (parts.redecide_with) {
    pipeline_.RedecideWith(*parts.redecide_with, parts.held_settings);
  }
  if (parts.sink) {
    recorder_ = std::make_unique<Recorder>(std::move(parts.sink), threaded);
  }
  if (link_ && threaded) {
    stop_ = std::make_unique<StopSender>(link_);
  }
}

Engine::~Engine() { (void)Stop(); }

void Engine::Start() {
  PALACE_CHECK(threaded_);
  engine_thread_ = std::jthread([this](std::stop_token stop) { RunEngine(stop); });
  source_thread_ = std::jthread([this](std::stop_token stop) { RunSource(stop); });
}

Status Engine::Stop() {
  if (source_thread_.joinable()) {
    source_thread_.request_stop();
    engine_thread_.request_stop();
    source_thread_.join();
    engine_thread_.join();
  }
  return recorder_ ? recorder_->Close() : Ok();
}

void Engine::Post(EngineCommand command) {
  if (stop_) {
    SendStop(command);
  }
  inbox_.Post(std::move(command));
}

void Engine::SendStop(const EngineCommand& command) {
  if (std::holds_alternative<WaveOff>(command.action)) {
    stop_->WaveOff();
  } else if (std::holds_alternative<HoldHere>(command.action)) {
    // Only what the mission will hold too; it refuses a hold where nothing descends.
    const std::shared_ptr<const EngineSnapshot> newest = latest_.Load();
    if (newest && IsFlying(newest->flight->mission.state)) {
      stop_->Hold();
    }
  }
}

void Engine::Control(const PlaybackControl& control) {
  source_->Control(control);
  using Kind = PlaybackControl::Kind;
  if (control.kind == Kind::kSeek || control.kind == Kind::kStepBack ||
      control.kind == Kind::kStepForward) {
    jump_asked_ = true;
    ended_ = false;
  }
}

bool Engine::Step() {
  PALACE_CHECK(!threaded_);
  const bool waits = source_->Status().paused && !jump_asked_;
  if (waits || ended_) {
    std::vector<EngineCommand> commands = inbox_.TakeCommands();
    if (!commands.empty()) {
      Handle({nullptr, std::move(commands)});
    }
    return !ended_;
  }
  jump_asked_ = false;
  Result<std::shared_ptr<const FrameBundle>> next = source_->Next({});
  if (!next) {
    Fail(next.error());
    return false;
  }
  Handle({*next, inbox_.TakeCommands()});
  return true;
}

void Engine::RunSource(std::stop_token stop) {
  while (!stop.stop_requested()) {
    Result<std::shared_ptr<const FrameBundle>> next = source_->Next(stop);
    if (!next) {
      if (!stop.stop_requested()) {
        Fail(next.error());
      }
      return;
    }
    if (source_->IsLockstep()) {
      inbox_.PutAndWait(std::move(*next), stop);
    } else {
      inbox_.PutNewest(std::move(*next));
    }
  }
}

void Engine::RunEngine(std::stop_token stop) {
  Inbox::Batch batch;
  while (inbox_.Take(batch, stop)) {
    Handle(std::exchange(batch, {}));
    inbox_.Finished();
  }
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
  const SessionStatus session = Session();
  RecordItem item;
  item.bundle = batch.bundle;
  PipelineOutput output = batch.bundle
                              ? pipeline_.Process(batch.bundle, std::move(batch.commands), session)
                              : pipeline_.Refresh(std::move(batch.commands), session);
  if (link_) {
    for (const VehicleMessage& message : output.messages) {
      link_->Send(message);
    }
    link_->Announce(*output.snapshot);
  }
  latest_.Store(output.snapshot);
  if (recorder_) {
    item.commands = std::move(output.commands);
    item.snapshot = output.snapshot;
    item.sent = std::move(output.messages);
    recorder_->Record(std::move(item), source_->IsLockstep());
  }
}

SessionStatus Engine::Session() const {
  SessionStatus session;
  session.source = source_->Status();
  session.can_transmit = link_ != nullptr;
  session.recording = recorder_ && recorder_->ok();
  session.recorder_ok = !record_wanted_ || session.recording;
  if (recorder_) {
    session.recording_path = recorder_->path();
    session.recording_minutes_left = recorder_->MinutesLeft();
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
