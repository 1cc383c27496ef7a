#include "engine/runtime/recorder.h"

#include <exception>
#include <utility>

namespace palace {

Recorder::Recorder(std::unique_ptr<RecordSink> sink, bool threaded)
    : sink_(std::move(sink)), path_(sink_->Path()), threaded_(threaded) {
  if (threaded) {
    thread_ = std::jthread([this](std::stop_token stop) {
      while (auto entry = queue_.Pop(stop)) {
        Write(entry->item);
        queue_.Done(entry->ticket);
      }
    });
  }
}

Recorder::~Recorder() { (void)Close(); }

void Recorder::Record(RecordItem item, bool may_wait) {
  if (threaded_ && !closed_) {
    queue_.Push(std::move(item), may_wait);
  } else if (!closed_) {
    Write(item);
  }
}

bool Recorder::RecordFirst(RecordItem item, bool may_wait, double limit_s) {
  if (threaded_ && !closed_) {
    return queue_.AwaitDone(queue_.Push(std::move(item), may_wait), limit_s);
  }
  Record(std::move(item), may_wait);
  return true;
}

void Recorder::Write(const RecordItem& item) {
  try {
    const Status done = sink_->Record(item);
    RecordState state = sink_->State();
    if (!done) {
      Fail(done.error().message, state.problem);
      return;
    }
    ok_ = true;
    const std::lock_guard lock(state_mutex_);
    state_ = std::move(state);
    error_.clear();
  } catch (const std::exception& error) {
    Fail(std::string("recording: ") + error.what(), error.what());
  }
}

void Recorder::Fail(const std::string& message, const std::string& problem) {
  const std::lock_guard lock(state_mutex_);
  error_ = message;
  state_.problem = problem.empty() ? message : problem;
  ok_ = false;
}

Status Recorder::Close() {
  if (closed_.exchange(true)) {
    return Ok();
  }
  if (thread_.joinable()) {
    thread_.request_stop();
    thread_.join();
  }
  const Status done = sink_->Close();
  if (!ok_) {
    const std::lock_guard lock(state_mutex_);
    return UnavailableError(error_);
  }
  return done;
}

RecordState Recorder::state() const {
  const std::lock_guard lock(state_mutex_);
  return state_;
}

}  // namespace palace
