// What stands round an engine in the tests of its supervision: a source, a record and a link that
// do as they are told. Threads wait for each other, never for a clock.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "engine/runtime/engine.h"

namespace palace {

inline std::shared_ptr<FrameBundle> MakeBundle(std::uint64_t number) {
  auto bundle = std::make_shared<FrameBundle>();
  bundle->sequence = number;
  bundle->time = {1'000'000'000 + static_cast<std::int64_t>(number) * 100'000};
  return bundle;
}

/// What was recorded.
struct Tape {
  std::mutex mutex;
  std::vector<RecordItem> items;
  std::vector<std::string> Notes() {
    const std::lock_guard lock(mutex);
    std::vector<std::string> notes;
    for (const RecordItem& item : items) {
      for (const Event& note : item.notes) {
        notes.push_back(note.text);
      }
    }
    return notes;
  }
  int Aborts() {
    const std::lock_guard lock(mutex);
    int aborts = 0;
    for (const RecordItem& item : items) {
      for (const VehicleMessage& message : item.sent) {
        aborts += std::holds_alternative<AbortRequest>(message) ? 1 : 0;
      }
    }
    return aborts;
  }
};

/// `before` runs before each item is taken.
class TapeSink final : public RecordSink {
 public:
  explicit TapeSink(std::shared_ptr<Tape> tape, std::function<void()> before = nullptr)
      : tape_(std::move(tape)), before_(std::move(before)) {}
  Status Record(const RecordItem& item) override {
    if (before_) {
      before_();
    }
    const std::lock_guard lock(tape_->mutex);
    tape_->items.push_back(item);
    return Ok();
  }
  Status Close() override { return Ok(); }
  std::string Path() const override { return "tape"; }

 private:
  std::shared_ptr<Tape> tape_;
  std::function<void()> before_;
};

/// Bundles without end; `before(i)` runs before number i is handed over.
class EndlessSource final : public Source {
 public:
  explicit EndlessSource(std::function<void(std::uint64_t)> before, bool lockstep = true)
      : before_(std::move(before)), lockstep_(lockstep) {}
  Result<std::shared_ptr<const FrameBundle>> Next(std::stop_token stop) override {
    if (before_) {
      before_(next_);
    }
    if (stop.stop_requested()) {
      return Error{ErrorCode::kEnd, "stopped"};
    }
    return std::shared_ptr<const FrameBundle>(MakeBundle(next_++));
  }
  bool IsLockstep() const override { return lockstep_; }
  SourceStatus Status() const override {
    SourceStatus status;
    status.kind = SourceKind::kSimulation;
    return status;
  }
  void Control(const PlaybackControl&) override {}

 private:
  std::function<void(std::uint64_t)> before_;
  const bool lockstep_;
  std::uint64_t next_ = 0;
};

/// A link whose Announce, called by the engine's own thread in each pass, does as it is told: it
/// stands for whatever may go wrong in the engine.
class Link final : public VehicleLink {
 public:
  explicit Link(std::function<void(const EngineSnapshot&)> announced = nullptr)
      : announced_(std::move(announced)) {}
  bool Send(const VehicleMessage& message) override {
    if (on_send) {
      return on_send();
    }
    const std::lock_guard lock(mutex_);
    aborts_ += std::holds_alternative<AbortRequest>(message) ? 1 : 0;
    last_send_s_ = MonotonicSeconds();
    return true;
  }
  std::function<bool()> on_send;  ///< set before the engine starts
  void Announce(const EngineSnapshot& snapshot) override {
    if (announced_) {
      announced_(snapshot);
    }
  }
  int aborts() const {
    const std::lock_guard lock(mutex_);
    return aborts_;
  }
  double last_send_s() const {
    const std::lock_guard lock(mutex_);
    return last_send_s_;
  }

 private:
  std::function<void(const EngineSnapshot&)> announced_;
  mutable std::mutex mutex_;
  int aborts_ = 0;
  double last_send_s_ = 0;
};

template <typename Condition>
void WaitFor(Condition&& condition) {
  while (!condition()) {
    std::this_thread::yield();
  }
}

inline bool Shows(const EngineSnapshot& snapshot, AlarmId id) {
  for (const Alarm& alarm : snapshot.flight->mission.alarms) {
    if (alarm.kind == id) {
      return true;
    }
  }
  return false;
}

}  // namespace palace
