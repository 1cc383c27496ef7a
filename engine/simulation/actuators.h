// What lies between a stick computed and a stick that acts: delay, travel, and how fast it moves.
#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <utility>

#include "engine/flight/controllers.h"

namespace palace {

struct ActuatorFigures {
  double control_rate_hz = 50;  ///< sticks are computed so often; poses are sent as often
  double delay_s = 0;
  double travel = 1;  ///< largest stick that the actuators reach
  /// Largest change of a stick in a second.
  double rate_per_s = std::numeric_limits<double>::infinity();
};

class Actuators {
 public:
  /// `step_s`: between two calls of Act.
  Actuators(const ActuatorFigures& figures, double step_s);

  /// Computed now, acts delay_s later.
  void Command(const StickCommand& stick);
  /// The sticks that act during the next step.
  const StickCommand& Act();

 private:
  double travel_;
  double change_;  ///< largest in a step
  std::int64_t delay_steps_;
  std::int64_t step_ = 0;
  std::deque<std::pair<std::int64_t, StickCommand>> under_way_;
  StickCommand wanted_;
  StickCommand acting_;
};

}  // namespace palace
