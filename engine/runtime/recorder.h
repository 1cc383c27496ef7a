// Recorder: writes the flight on its own thread, so that a slow disk never holds the engine.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "engine/runtime/record_queue.h"
#include "engine/runtime/record_sink.h"

namespace palace {

/// A failure, an exception too, ends nothing: the state says why nothing is written, and the next
/// pass is tried again.
class Recorder {
 public:
  /// `threaded` false writes in the caller's thread (headless runs, tests).
  Recorder(std::unique_ptr<RecordSink> sink, bool threaded);
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Any thread. A lockstep flight waits for room in the queue; a live one never waits.
  void Record(RecordItem item, bool may_wait);
  /// The same, and returns when it is written, or when the disk has taken `limit_s` over it: false
  /// then, and it is written later.
  bool RecordFirst(RecordItem item, bool may_wait, double limit_s);
  /// Writes what waits and closes the log. What stood against recording at the end, if anything.
  Status Close();
  bool ok() const { return ok_.load(); }
  RecordState state() const;
  const std::string& path() const { return path_; }
  /// Pairs of pictures that were not written because the disk was too slow.
  std::uint64_t dropped() const { return queue_.pairs_left_out(); }

 private:
  void Write(const RecordItem& item);
  void Fail(const std::string& message, const std::string& problem);

  std::unique_ptr<RecordSink> sink_;
  const std::string path_;
  RecordQueue queue_;
  std::atomic<bool> ok_{true};
  mutable std::mutex state_mutex_;
  RecordState state_;
  std::string error_;
  const bool threaded_;
  std::atomic<bool> closed_{false};
  std::jthread thread_;  // last: joined before the rest goes
};

}  // namespace palace
