// EngineWatch: whether the engine lives, for who looks from outside: a heartbeat, what ended it,
// and how often it may be started again. Reading needs nothing of the engine, so that a screen can
// say it while the engine hangs.
#pragma once

#include <mutex>
#include <optional>
#include <string>

namespace palace {

class EngineWatch {
 public:
  static constexpr double kSilence_s = 1;  ///< a pass that takes longer is said to hang
  static constexpr int kMostRestarts = 3;
  static constexpr double kBetweenRestarts_s = 5;

  /// A pass begins, and ends.
  void Begin(double now_s);
  void End();
  /// Something threw. When it may be started again, in monotonic seconds; empty: not any more.
  std::optional<double> Stopped(const std::string& what, const std::string& reason, double now_s);
  void Started(double now_s);
  /// What a person must know now: "Engine has not answered for 1.4 s (limit 1 s). ..."; empty while
  /// all is well.
  std::string Complaint(double now_s) const;
  /// What stopped it last, and how often: "Engine stopped: ... Started again, 1 of 3."; empty when
  /// nothing did.
  std::string LastStop() const;

 private:
  mutable std::mutex mutex_;
  std::optional<double> busy_since_s_;
  bool stopped_ = false;
  std::string why_;
  int restarts_ = 0;
  std::optional<double> last_start_s_;
  std::optional<double> next_start_s_;
};

}  // namespace palace
