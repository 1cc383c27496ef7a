// What the engine does when something throws: tell it, record it, hold, and begin anew.
#include <condition_variable>
#include <exception>
#include <utility>

#include "engine/core/log.h"
#include "engine/runtime/engine.h"

namespace palace {
namespace {
constexpr int kTellPasses = 20;  // until somebody acknowledges, the alarm stays anyway
}  // namespace

std::unique_ptr<Pipeline> Engine::MakePipeline(const Settings& settings,
                                               MissionOptions mission) const {
  auto pipeline = std::make_unique<Pipeline>(settings, std::move(mission));
  pipeline->FollowRecord(record_);
  if (redecide_with_) {
    pipeline->RedecideWith(*redecide_with_, held_settings_);
  }
  return pipeline;
}

bool Engine::HandleSafely(const Inbox::Batch& batch, std::stop_token stop) {
  recorded_ = false;
  fault_passes_ -= fault_passes_ > 0 ? 1 : 0;
  source_fault_passes_ -= source_fault_passes_ > 0 ? 1 : 0;
  if (const int faults = source_faults_; faults != std::exchange(source_faults_told_, faults)) {
    source_fault_passes_ = kTellPasses;
  }
  try {
    Handle(batch);
    return true;
  } catch (const std::exception& error) {
    return StartAgain(batch, error.what(), stop);
  } catch (...) {
    return StartAgain(batch, "unknown exception", stop);
  }
}

bool Engine::StartAgain(const Inbox::Batch& failed, const std::string& reason,
                        std::stop_token stop) {
  HoldDescent();
  const auto last = latest_.Load();
  const std::string text = "Engine stopped: " + reason;
  LogError(text);
  if (recorder_) {
    RecordItem item;
    if (!recorded_) {
      item.commands = failed.commands;
      item.bundle = failed.bundle;
    }
    item.notes = {
        {.time = {}, .kind = EventKind::kAlarm, .text = text, .level = AlarmLevel::kWarning}};
    recorder_->Record(std::move(item), /*may_wait=*/false);
  }
  const std::optional<double> at_s = watch_.Stopped("Engine", reason, MonotonicSeconds());
  if (!at_s || (threaded_ && !AwaitRestart(*at_s, stop))) {
    Fail(UnavailableError(text));
    return false;
  }
  try {
    MissionOptions mission = pipeline_->MissionToGoOn();
    const std::uint64_t sequence = pipeline_->sequence();
    pipeline_.reset();  // its memory may be what is missing
    pipeline_ = MakePipeline(last ? last->session->settings : Settings(), std::move(mission));
    pipeline_->GoOnAfter(sequence, last.get());
  } catch (const std::exception& error) {
    Fail(UnavailableError(text + "; it cannot be started again: " + error.what()));
    return false;
  } catch (...) {
    Fail(UnavailableError(text + "; it cannot be started again"));
    return false;
  }
  made_anew_ = true;
  fault_passes_ = kTellPasses;
  watch_.Started(MonotonicSeconds());
  return true;
}

/// False when it is stopped before.
bool Engine::AwaitRestart(double at_s, std::stop_token stop) const {
  std::mutex mutex;
  std::condition_variable_any never;
  std::unique_lock lock(mutex);
  const std::chrono::duration<double> wait(at_s - MonotonicSeconds());
  never.wait_for(lock, stop, wait, [] { return false; });
  return !stop.stop_requested();
}

void Engine::RunSource(std::stop_token stop) {
  while (!stop.stop_requested()) {
    try {
      if (!Feed(stop)) {
        break;
      }
    } catch (const std::exception& error) {
      if (!SourceStopped(error.what(), stop)) {
        break;
      }
    } catch (...) {
      if (!SourceStopped("unknown exception", stop)) {
        break;
      }
    }
  }
  threads_ended_.release();
}

/// Tells and records it. False when it is not started again.
bool Engine::SourceStopped(const std::string& reason, std::stop_token stop) {
  const std::string text = "Source stopped: " + reason;
  LogError(text);
  if (recorder_) {
    RecordItem item;
    item.notes = {
        {.time = {}, .kind = EventKind::kAlarm, .text = text, .level = AlarmLevel::kWarning}};
    recorder_->Record(std::move(item), /*may_wait=*/false);
  }
  const auto at_s = source_watch_.Stopped("Source", reason, MonotonicSeconds());
  if (!at_s || !AwaitRestart(*at_s, stop)) {
    Fail(UnavailableError(text));
    return false;
  }
  source_watch_.Started(MonotonicSeconds());
  ++source_faults_;
  return true;
}

/// Takes one bundle to the inbox. False when there will be no other.
bool Engine::Feed(std::stop_token stop) {
  Result<std::shared_ptr<const FrameBundle>> next = source_->Next(stop);
  if (!next) {
    if (!stop.stop_requested()) {
      Fail(next.error());
    }
    return false;
  }
  if (source_->IsLockstep()) {
    inbox_.PutAndWait(std::move(*next), stop);
  } else {
    inbox_.PutNewest(std::move(*next));
  }
  return true;
}

std::string Engine::Complaint() const {
  const double now_s = MonotonicSeconds();
  const std::string engine = watch_.Complaint(now_s);
  return engine.empty() ? source_watch_.Complaint(now_s) : engine;
}

}  // namespace palace
