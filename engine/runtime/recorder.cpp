#include "engine/runtime/recorder.h"

#include <chrono>
#include <exception>
#include <utility>

#include "engine/core/text.h"

namespace palace {

Recorder::Recorder(std::unique_ptr<RecordSink> sink, bool threaded)
    : sink_(std::move(sink)), path_(sink_->Path()), threaded_(threaded) {
  if (threaded) {
    thread_ = std::jthread([this](std::stop_token stop) { Run(stop); });
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

Written Recorder::RecordFirst(RecordItem item, bool may_wait, double limit_s) {
  if (closed_) {
    return Written::kNo;
  }
  if (threaded_) {
    return queue_.AwaitDone(queue_.Push(std::move(item), may_wait), limit_s);
  }
  return Write(item) ? Written::kYes : Written::kNo;
}

void Recorder::Run(std::stop_token stop) {
  while (auto entry = queue_.Pop(stop)) {
    queue_.Done(entry->ticket, Write(entry->item));
    const std::lock_guard lock(state_mutex_);
    ++moves_;
    moved_.notify_all();
  }
  Status closing = CloseSink();
  const std::lock_guard lock(state_mutex_);
  closing_ = std::move(closing);
  ended_ = true;
  moved_.notify_all();
}

bool Recorder::Write(const RecordItem& item) {
  try {
    const Status done = sink_->Record(item);
    RecordState state = sink_->State();
    if (!done) {
      Fail(done.error().message, state.problem);
      return false;
    }
    ok_ = true;
    const std::lock_guard lock(state_mutex_);
    state_ = std::move(state);
    error_.clear();
    return true;
  } catch (const std::exception& error) {
    Fail(std::string("recording: ") + error.what(), error.what());
  } catch (...) {
    Fail("recording: unknown exception", "unknown exception");
  }
  return false;
}

void Recorder::Fail(const std::string& message, const std::string& problem) {
  const std::lock_guard lock(state_mutex_);
  error_ = message;
  state_.problem = problem.empty() ? message : problem;
  ok_ = false;
}

Status Recorder::CloseSink() {
  try {
    return sink_->Close();
  } catch (const std::exception& error) {
    return UnavailableError(path_ + ": cannot be closed: " + error.what());
  } catch (...) {
    return UnavailableError(path_ + ": cannot be closed: unknown exception");
  }
}

/// False when nothing moves for so long.
bool Recorder::AwaitEnd(double patience_s) {
  std::unique_lock lock(state_mutex_);
  while (!ended_) {
    const std::uint64_t before = moves_;
    if (!moved_.wait_for(lock, std::chrono::duration<double>(patience_s),
                         [&] { return ended_ || moves_ != before; })) {
      return false;
    }
  }
  return true;
}

Status Recorder::Close(double patience_s) {
  if (closed_.exchange(true) && !hung_) {
    return Ok();
  }
  if (threaded_) {
    thread_.request_stop();
    hung_ = !AwaitEnd(patience_s);
    if (hung_) {
      return UnavailableError(path_ + WithNumbers(": the disk has stood still for %.0f s; the log "
                                                  "is not closed and lacks what was said last",
                                                  patience_s));
    }
    thread_.join();
  } else {
    closing_ = CloseSink();
  }
  const std::lock_guard lock(state_mutex_);
  return ok_ ? closing_ : UnavailableError(error_);
}

RecordState Recorder::state() const {
  const std::lock_guard lock(state_mutex_);
  return state_;
}

}  // namespace palace
