#include "engine/navigation/velocity_fade.h"

#include <algorithm>

namespace palace {
namespace {

constexpr double kFade_s = 1.0;

}  // namespace

void VelocityFade::Start(Timestamp time, const Eigen::Vector3d& old_v_WB,
                         const Eigen::Vector3d& new_v_WB) {
  switch_ = Switch{time, old_v_WB - new_v_WB};
}

Eigen::Vector3d VelocityFade::Faded(const Eigen::Vector3d& v_WB, Timestamp now) const {
  if (!switch_) {
    return v_WB;
  }
  const double share = std::clamp(SecondsBetween(switch_->time, now) / kFade_s, 0.0, 1.0);
  return v_WB + (1 - share) * switch_->dv_WB;
}

}  // namespace palace
