// EnergyWatch: for how long the vehicle can go on flying, by the share of fuel or battery it tells.
//
// The share falls by a straight line over the last kWindow_s, fitted by least squares:
//   share(t) = a - b t,   lasts = (a - b now) / b
// A gauge has steps and noise, so a rate is told only while the line falls by kLeastFall in it;
// what falls less is not told. A share that leaves the line by kJump (refuelled, another battery,
// another gauge), a restart of the vehicle or of its clock begin anew. An unknown share (NaN) is no
// sample. Times are data time of the station.
#pragma once

#include <cmath>
#include <deque>

#include "engine/core/time.h"
#include "engine/model/mission/energy_left.h"

namespace palace {

class EnergyWatch {
 public:
  static constexpr double kWindow_s = 300;
  static constexpr double kLeastFall = 0.02;  ///< two steps of a gauge that tells whole percents
  static constexpr double kJump = 0.05;
  static constexpr double kEvery_s = 1;  ///< of the samples that are kept

  void Update(double share, Timestamp now);
  void Forget();
  EnergyLeft Left() const;

 private:
  struct Sample {
    Timestamp time;
    double share = NAN;
  };
  void Fit(Timestamp now);
  std::deque<Sample> samples_;  ///< oldest first, of the window
  double line_ = NAN;           ///< share by the line, now
  EnergyLeft left_;
};

}  // namespace palace
