// PositionFilter: position and velocity in W from inertial data and gated, possibly late, position
// fixes.
//
// State x = [p_WB, v_WB, b_B]: metres, m/s, accelerometer bias in body axes. Attitude is not
// estimated: it comes from the AHRS. Predicted at every IMU sample,
//   a_W = R_WB (f_B - b_B) + g_W,   p += v dt + a dt^2/2,   v += a dt,
// updated in Joseph form with a floor on P. A fix is refused when its normalised innovation squared
// exceeds the 0.997 quantile of chi-square: 13.93 for three, 19.80 for six degrees of freedom.
//
// A filter that measures its scatter widens what fixes state of themselves by the variance factor
//   f = max(1, mean of innovation' S^-1 innovation / dof over some 20 fixes), 100 at most,
// which least squares calls the a posteriori variance of unit weight (Mikhail 1976). So the gate is
// as narrow as fixes are good, and pictures that are worse than stated are believed less instead of
// refused one after the other. A fix that is refused counts as much as the gate lets through, for
// one may be anywhere and says nothing of the others; the n-th in a row counts n times that, 25 at
// most, for then it is the gate that is too narrow. What was measured stays when a filter begins
// anew: it is of the fixes.
// After reference simulation.md 4.1; Bar-Shalom, Li & Kirubarajan 2001, 5.4 (consistency).
#pragma once

#include <optional>

#include <Eigen/Dense>

#include "engine/core/time.h"
#include "engine/navigation/delayed_measurements.h"
#include "engine/navigation/inertial_kalman.h"

namespace palace {

/// Where a filter starts.
struct FilterSeed {
  Timestamp time;
  Eigen::Vector3d p_WB = Eigen::Vector3d::Zero();
  Eigen::Vector3d v_WB = Eigen::Vector3d::Zero();
  Eigen::Vector3d bias_B = Eigen::Vector3d::Zero();
  Eigen::Matrix3d p_covariance_m2 = Eigen::Matrix3d::Identity();
  double sigma_v_mps = 0.3;
  double sigma_bias_mps2 = 0.1;
};

/// Position and velocity at one time, with covariance.
struct FilterEstimate {
  Timestamp time;
  Eigen::Vector3d p_WB = Eigen::Vector3d::Zero();
  Eigen::Vector3d v_WB = Eigen::Vector3d::Zero();
  Eigen::Vector3d bias_B = Eigen::Vector3d::Zero();
  Eigen::Vector3d sigma_p_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d sigma_v_mps = Eigen::Vector3d::Zero();
  Eigen::Vector3d sigma_bias_mps2 = Eigen::Vector3d::Zero();
  Eigen::Matrix3d p_covariance_m2 = Eigen::Matrix3d::Zero();
};

enum class FixOutcome { kAccepted, kRejected, kTooOld };

class PositionFilter {
 public:
  explicit PositionFilter(bool measures_scatter = false) : measures_scatter_(measures_scatter) {}
  void Reset();
  /// Does not run until the next Start; of the fixes it keeps their scatter.
  void Stop();
  void Start(const FilterSeed& seed, const ProcessNoise& noise);
  bool running() const { return running_; }
  /// Samples in order of time; one at or before the newest known is ignored.
  void AddImu(Timestamp time, const Eigen::Vector3d& specific_force_B, const Eigen::Matrix3d& R_WB);
  /// The fix is put at its own time stamp, up to 1.5 s back. Without IMU the state coasts.
  FixOutcome AddFix(const PositionMeasurement& fix);
  /// The frame of all fixes turned out to lie elsewhere: moves the state and the fixes so far.
  void Shift(const Eigen::Vector3d& by_W) { history_.Shift(by_W); }
  void SetProcessNoise(const ProcessNoise& noise);

  /// Best knowledge at `time`; beyond the newest IMU sample the last acceleration is held 0.1 s,
  /// then the velocity. Requires running().
  FilterEstimate EstimateAt(Timestamp time) const;
  int rejected_in_row() const { return rejected_in_row_; }
  /// sqrt(innovation' S^-1 innovation / dof) of the last fix.
  double residual_sigma() const { return residual_sigma_; }
  /// What residual_sigma may be for the fix to be used; NaN before any.
  double max_residual_sigma() const { return max_residual_sigma_; }
  /// innovation' S^-1 innovation of the last fix, scaled to three degrees of freedom.
  double nis() const { return 3 * residual_sigma_ * residual_sigma_; }
  /// f of the next fix.
  double variance_factor() const { return scatter_ > 1 ? scatter_ : 1; }
  /// Stamp of the newest accepted fix; the start before any.
  Timestamp last_accepted() const { return last_accepted_; }

 private:
  void CountScatter(const Innovation& innovation);

  bool measures_scatter_ = false;
  double scatter_ = 1;  ///< mean square of innovations, in what fixes state
  bool running_ = false;
  DelayedMeasurements history_;
  int rejected_in_row_ = 0;
  double residual_sigma_ = 0;
  double max_residual_sigma_ = std::numeric_limits<double>::quiet_NaN();
  Timestamp last_accepted_;
};

}  // namespace palace
