// Root mean square of each axis of W, summed as the values come.
#pragma once

#include <Eigen/Dense>

namespace palace {

class AxisRms {
 public:
  void Add(const Eigen::Vector3d& value) {
    squares_ += value.cwiseAbs2();
    ++count_;
  }
  int count() const { return count_; }
  /// NaN without values, as is Rms.
  Eigen::Vector3d MeanSquare() const { return squares_ / count_; }
  Eigen::Vector3d Rms() const { return MeanSquare().cwiseSqrt(); }

 private:
  Eigen::Vector3d squares_ = Eigen::Vector3d::Zero();
  int count_ = 0;
};

}  // namespace palace
