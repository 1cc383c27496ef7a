#include "engine/simulation/actuators.h"

#include <algorithm>
#include <cmath>

namespace palace {

Actuators::Actuators(const ActuatorFigures& figures, double step_s)
    : travel_(figures.travel),
      change_(figures.rate_per_s * step_s),
      delay_steps_(std::llround(figures.delay_s / step_s)) {}

void Actuators::Command(const StickCommand& stick) {
  under_way_.emplace_back(step_ + delay_steps_, stick);
}

const StickCommand& Actuators::Act() {
  while (!under_way_.empty() && under_way_.front().first <= step_) {
    wanted_ = under_way_.front().second;
    under_way_.pop_front();
  }
  ++step_;
  for (double StickCommand::*stick :
       {&StickCommand::lat, &StickCommand::lon, &StickCommand::ped, &StickCommand::col}) {
    const double reached = std::clamp(wanted_.*stick, -travel_, travel_);
    acting_.*stick = std::clamp(reached, acting_.*stick - change_, acting_.*stick + change_);
  }
  return acting_;
}

}  // namespace palace
