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

/// Passes without a bundle are handed to the sink with the next one: a replay applies their
/// commands there. When the disk is too slow, the oldest pass that waits is joined to the one after
/// it, so that commands, messages and samples are written and only its pictures are lost.
class Recorder {
 public:
  /// `threaded` false writes in the caller's thread (headless runs, tests).
  Recorder(std::unique_ptr<RecordSink> sink, bool threaded);
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// One thread. A lockstep flight waits for room in the queue; a live one never waits.
  void Record(RecordItem item, bool may_wait);
  /// Writes what waits and closes the log. The first error, if any, is returned.
  Status Close();
  bool ok() const { return ok_.load(); }
  std::string error() const;
  const std::string& path() const { return path_; }
  /// Frames that were not written, though what came and went with them was.
  std::uint64_t dropped() const { return dropped_.load(); }
  /// Minutes of recording left on the disk at the present rate; negative when unknown.
  double MinutesLeft() const { return minutes_left_.load(); }

 private:
  void Write(const RecordItem& item);
  void EstimateSpace(const RecordItem& item);

  std::unique_ptr<RecordSink> sink_;
  const std::string path_;
  BoundedQueue<RecordItem> queue_{64};
  RecordItem held_;  ///< of passes without a bundle, until the next with one
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
