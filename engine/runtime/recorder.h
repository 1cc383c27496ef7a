// Recorder: writes the flight on its own thread, so that a slow disk never holds the engine.
#pragma once

#include <atomic>
#include <condition_variable>
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
  /// The same, and returns when the disk has taken or refused it, or when it has taken `limit_s`
  /// over it: kLate then, and it is written later.
  Written RecordFirst(RecordItem item, bool may_wait, double limit_s);
  /// Nobody waits for room any more: for the end of a flight whose disk stands still.
  void HurryUp() { queue_.HurryUp(); }
  /// Writes what waits and closes the log. What stood against recording at the end, if anything.
  /// When the disk does not move for `patience_s` it is left alone: an error too, and the Recorder
  /// must not be destroyed while hung().
  Status Close(double patience_s = kPatience_s);
  bool hung() const { return hung_; }
  bool ok() const { return ok_.load(); }
  RecordState state() const;
  const std::string& path() const { return path_; }
  /// Pairs of pictures that were not written because the disk was too slow.
  std::uint64_t dropped() const { return queue_.pairs_left_out(); }

 private:
  static constexpr double kPatience_s = 5;
  void Run(std::stop_token stop);
  bool Write(const RecordItem& item);
  Status CloseSink();
  bool AwaitEnd(double patience_s);
  void Fail(const std::string& message, const std::string& problem);

  std::unique_ptr<RecordSink> sink_;
  const std::string path_;
  RecordQueue queue_;
  std::atomic<bool> ok_{true};
  mutable std::mutex state_mutex_;
  RecordState state_;
  std::string error_;
  std::condition_variable moved_;
  std::uint64_t moves_ = 0;  ///< of the disk
  bool ended_ = false;       ///< the thread, with sink_ closed
  Status closing_ = Ok();
  bool hung_ = false;
  const bool threaded_;
  std::atomic<bool> closed_{false};
  std::jthread thread_;  // last: joined before the rest goes
};

}  // namespace palace
