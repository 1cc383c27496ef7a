// Recorder: writes the flight on its own thread, so that a slow disk never holds the engine.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "engine/core/bounded_queue.h"
#include "engine/runtime/record_sink.h"

namespace palace {

class Recorder {
 public:
  /// `threaded` false writes in the caller's thread (headless runs, tests).
  Recorder(std::unique_ptr<RecordSink> sink, bool threaded);
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// A lockstep flight waits for room in the queue; a live one drops the oldest and counts it.
  void Record(RecordItem item, bool may_wait);
  /// Writes what waits and closes the log. The first error, if any, is returned.
  Status Close();
  bool ok() const { return ok_.load(); }
  std::string error() const;
  const std::string& path() const { return path_; }
  std::uint64_t dropped() const { return dropped_.load(); }
  /// Minutes of recording left on the disk at the present rate; negative when unknown.
  double MinutesLeft() const { return minutes_left_.load(); }

 private:
  void Write(const RecordItem& item);
  void EstimateSpace(const RecordItem& item);

  std::unique_ptr<RecordSink> sink_;
  const std::string path_;
  BoundedQueue<RecordItem> queue_{64};
  std::atomic<bool> ok_{true};
  std::atomic<double> minutes_left_{-1};
  std::atomic<std::uint64_t> dropped_{0};
  mutable std::mutex error_mutex_;
  std::string error_;
  Timestamp first_;
  std::uint64_t items_ = 0;
  bool closed_ = false;
  std::jthread thread_;  // last: joined before the rest goes
};

}  // namespace palace
