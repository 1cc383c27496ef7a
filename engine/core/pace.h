// Pace: when the turns of a source are due in real time, and how fast they really come.
//
// A turn that took long is caught up on by those after it, half a second at most, so that the mean
// speed is the one asked for as long as the mean turn takes less than its step. Reads no clock.
#pragma once

#include <algorithm>
#include <optional>

namespace palace {

class Pace {
 public:
  static constexpr double kMostCaughtUp_s = 0.5;

  /// Monotonic time at which the turn `step_s` of source time after the last one is due, at `speed`
  /// times real time (0: at once). May lie before `now_s`.
  double DueAt(double now_s, double step_s, double speed) const {
    return last_ && speed > 0 ? std::max(last_->due_s + step_s / speed, now_s - kMostCaughtUp_s)
                              : now_s;
  }

  /// A turn begins that was due at `due_s`: before then where a wait was cut short.
  void Begin(double now_s, double due_s, double step_s) {
    if (last_ && now_s > last_->begun_s) {
      // The mean of what turns take, not of their speeds: a quick one makes up for no slow one.
      const double taken = (now_s - last_->begun_s) / step_s;
      taken_ = taken_ ? *taken_ + kSmoothing * (taken - *taken_) : taken;
    }
    last_ = Turn{now_s, std::min(due_s, now_s)};
  }

  /// What is waited now is no slowness.
  void Pause() { last_.reset(); }
  /// Another speed: what was reached so far says nothing of it, and nothing is owed.
  void Restart() {
    taken_.reset();
    if (last_) {
      last_->due_s = last_->begun_s;
    }
  }
  /// Times real time; none before two turns of one speed.
  std::optional<double> reached() const {
    return taken_ ? std::optional(1 / *taken_) : std::nullopt;
  }

 private:
  static constexpr double kSmoothing = 0.1;
  struct Turn {
    double begun_s = 0;
    double due_s = 0;
  };
  std::optional<Turn> last_;
  std::optional<double> taken_;  ///< seconds a second of source time
};

}  // namespace palace
