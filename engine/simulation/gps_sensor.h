// GpsSensor: fixes of B with white noise, wandering bias, latency and gaps.
//
//   p = p_WB + b + s n,  b' = -b / T + white (first-order Gauss-Markov, stationary deviation
//   drift_m),  v = v_WB + s_v n;  delivered latency + U(0, jitter) later, in order, stamped with
//   the time they are valid for.
// A fix tells its white noise alone as its sigma: no receiver knows its drift.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "engine/core/random.h"
#include "engine/model/vehicle_state.h"

namespace palace {

/// Standard deviations; all 0: an exact receiver.
struct GpsNoise {
  double horizontal_m = 0;
  double vertical_m = 0;
  double velocity_mps = 0;
  double latency_s = 0;
  double latency_jitter_s = 0;    ///< at most so much more, evenly spread
  double drift_horizontal_m = 0;  ///< Gauss-Markov, north and east each; not seen in the velocity
  double drift_vertical_m = 0;
  double drift_time_s = 100;
  double dropout = 0;  ///< share of fixes that never come
};

/// Measures B (the antenna's lever arm is taken to be compensated). Each error has a stream of its
/// own.
class GpsSensor {
 public:
  GpsSensor(const GpsNoise& noise, std::uint64_t seed);
  void Measure(Timestamp now, const Eigen::Vector3d& p_WB, const Eigen::Vector3d& v_WB);
  /// A fix whose latency has passed.
  std::optional<GpsFix> Deliver(Timestamp now);

 private:
  struct InFlight {
    GpsFix fix;
    double latency_s = 0;
  };
  void Drift(Timestamp now);

  GpsNoise noise_;
  RandomStream random_;
  RandomStream drift_random_;
  RandomStream jitter_random_;
  RandomStream dropout_random_;
  Eigen::Vector3d drift_W_;
  std::optional<Timestamp> measured_;
  std::deque<InFlight> in_flight_;
};

}  // namespace palace
