// DelayedMeasurements: lets a fix act at the time it was taken, not at the time it arrived.
//
// Keeps 1.5 s of inertial inputs with the state after each. A late fix goes to its place in time:
// roll back to the state before it, step to its stamp, update, and replay everything since, fixes
// included. So the order of arrival does not matter inside the window.
#pragma once

#include <deque>
#include <optional>

#include "engine/core/time.h"
#include "engine/navigation/inertial_kalman.h"

namespace palace {

class DelayedMeasurements {
 public:
  static constexpr double kWindow_s = 1.5;

  void Start(const InertialState& state, const ProcessNoise& noise);
  void SetNoise(const ProcessNoise& noise) { noise_ = noise; }
  /// One inertial step; ignored when not newer than the newest.
  void AddInput(Timestamp time, const InertialInput& input);
  /// Nothing when the fix is older than the window or the start.
  std::optional<Innovation> Insert(const PositionMeasurement& fix);
  /// Moves all positions, of states and of fixes.
  void Shift(const Eigen::Vector3d& by_W);
  /// State at any time of the window or after it.
  InertialState StateAt(Timestamp time) const;
  Timestamp newest() const { return entries_.back().after.time; }

 private:
  struct Entry {
    InertialInput input;                     ///< from the entry before to this one
    std::optional<PositionMeasurement> fix;  ///< acts at this entry's time, after the step
    InertialState after;
  };
  InertialInput InputAfter(const Entry& entry, Timestamp time) const;
  void Coast(Timestamp time);
  std::size_t LastAtOrBefore(Timestamp time) const;
  void Forget();

  std::deque<Entry> entries_;
  ProcessNoise noise_;
};

}  // namespace palace
