#include "engine/navigation/position_filter.h"

#include <algorithm>
#include <cmath>

#include "engine/core/check.h"

namespace palace {
namespace {

constexpr double kScatterGain = 0.05;
constexpr double kMostOfOne = 25;
constexpr double kMostFactor = 100;

}  // namespace

void PositionFilter::Reset() { *this = PositionFilter(measures_scatter_); }

void PositionFilter::Stop() {
  const double scatter = scatter_;
  Reset();
  scatter_ = scatter;
}

void PositionFilter::Start(const FilterSeed& seed, const ProcessNoise& noise) {
  Stop();
  InertialState state;
  state.time = seed.time;
  state.x << seed.p_WB, seed.v_WB, seed.bias_B;
  state.P.setZero();
  state.P.topLeftCorner<3, 3>() = seed.p_covariance_m2;
  state.P.block<3, 3>(3, 3) = seed.sigma_v_mps * seed.sigma_v_mps * Eigen::Matrix3d::Identity();
  state.P.block<3, 3>(6, 6) =
      seed.sigma_bias_mps2 * seed.sigma_bias_mps2 * Eigen::Matrix3d::Identity();
  history_.Start(state, noise);
  last_accepted_ = seed.time;
  running_ = true;
}

void PositionFilter::SetProcessNoise(const ProcessNoise& noise) { history_.SetNoise(noise); }

void PositionFilter::AddImu(Timestamp time, const Eigen::Vector3d& specific_force_B,
                            const Eigen::Matrix3d& R_WB) {
  PALACE_CHECK(running_);
  if (specific_force_B.allFinite() && R_WB.allFinite()) {
    history_.AddInput(time, {specific_force_B, R_WB, false});
  }
}

void PositionFilter::CountScatter(const Innovation& innovation) {
  if (measures_scatter_) {
    const double counted =
        innovation.within_gate ? innovation.squared : (rejected_in_row_ + 1) * innovation.gate;
    const double square = std::min(counted / innovation.dof, kMostOfOne);
    scatter_ += kScatterGain * (square * variance_factor() - scatter_);
    scatter_ = std::min(scatter_, kMostFactor);
  }
}

FixOutcome PositionFilter::AddFix(const PositionMeasurement& told) {
  PALACE_CHECK(running_);
  PositionMeasurement fix = told;
  fix.p_covariance_m2 *= variance_factor();
  const bool finite = fix.p_WB.allFinite() && fix.p_covariance_m2.allFinite() &&
                      (!fix.v_WB || fix.v_WB->allFinite());
  const std::optional<Innovation> innovation =
      finite ? history_.Insert(fix) : std::optional<Innovation>(Innovation{});
  if (!innovation) {
    return FixOutcome::kTooOld;
  }
  if (finite) {
    CountScatter(*innovation);
  }
  residual_sigma_ = std::sqrt(innovation->squared / innovation->dof);
  max_residual_sigma_ = std::sqrt(innovation->gate / innovation->dof);
  if (!innovation->within_gate) {
    ++rejected_in_row_;
    return FixOutcome::kRejected;
  }
  rejected_in_row_ = 0;
  last_accepted_ = std::max(last_accepted_, fix.time);
  return FixOutcome::kAccepted;
}

FilterEstimate PositionFilter::EstimateAt(Timestamp time) const {
  PALACE_CHECK(running_);
  const InertialState state = history_.StateAt(time);
  FilterEstimate estimate;
  estimate.time = time;
  estimate.p_WB = state.x.head<3>();
  estimate.v_WB = state.x.segment<3>(3);
  estimate.bias_B = state.x.tail<3>();
  estimate.sigma_p_m = state.P.diagonal().head<3>().cwiseSqrt();
  estimate.sigma_v_mps = state.P.diagonal().segment<3>(3).cwiseSqrt();
  estimate.sigma_bias_mps2 = state.P.diagonal().tail<3>().cwiseSqrt();
  estimate.p_covariance_m2 = state.P.topLeftCorner<3, 3>();
  return estimate;
}

}  // namespace palace
