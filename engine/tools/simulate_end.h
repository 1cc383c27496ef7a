// The end of `palacectl simulate` by a signal, also while a world or one picture of it takes
// minutes.
#pragma once

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <stop_token>

#include "engine/core/termination.h"
#include "engine/journal/log_writer.h"
#include "engine/tools/simulate_export.h"

namespace palace {

/// A signal asks the flight to end between two bundles. When it has not after a moment, the bundle
/// in hand is given up: what was written before it is closed and the program ends, with exit code
/// 0, or with 128 and the signal where nothing was flown; then nothing is left behind either. Make
/// it before any other thread starts.
class SimulateEnd {
 public:
  SimulateEnd() = default;
  ~SimulateEnd() { Over(); }

  std::stop_token stop() const { return flight_.get_token(); }
  /// Held by whoever writes what is flown, not while a bundle is made.
  std::mutex& hand() { return hand_; }
  // Under hand():
  void Writes(LogWriter* log) { log_ = log; }  ///< null: no more
  void Writes(ExportingSource* folder) { folder_ = folder; }
  void HaveFlown() { flown_ = true; }

  /// Ends the program where a signal came before anything was flown: nothing is left behind.
  void EndUnflown();
  /// The flight has ended by itself, or as it was asked to; what is still to write takes its time.
  void Over();

 private:
  void Asked();
  [[noreturn]] void GiveUp();

  std::stop_source flight_;
  std::mutex hand_;
  std::condition_variable over_now_;
  bool over_ = false;
  bool flown_ = false;
  LogWriter* log_ = nullptr;
  ExportingSource* folder_ = nullptr;
  const Termination termination_{[this] { Asked(); }};  // last: its thread uses the others
};

}  // namespace palace
