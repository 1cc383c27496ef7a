#include "engine/navigation/image_time.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace palace {
namespace {

constexpr double kWindows_s[] = {2.2, 1.4};
constexpr double kRatesKept_s = 4;
constexpr double kRateGap_s = 0.15;     // poses further apart tell no turning between them
constexpr double kPictureGap_s = 0.35;  // nor do pictures
constexpr int kLeastPairs = 9;
constexpr double kLeastSpan_s = 0.95;  // of the pairs: slow motion fits any lag over less
// An offset as long as a gust is believed where times that agree explain this much less.
constexpr double kLong_s = 0.2, kBetterThanNone = 4;
constexpr double kStep_s = 0.02, kFineStep_s = 0.01;
constexpr double kSharp_s = 0.05;  // sensitivity is that of an offset of 50 ms
constexpr double kMostSigma_s = 0.012;
constexpr double kSigmas = 4;
constexpr double kExplained = 0.25;  // of the motion's mean square may be left over
constexpr double kLeastNoise2_px2 = 0.04;
constexpr double kDepthShare = 0.3;  // by which the depth of all may differ from the middle's
constexpr int kOffRun = 3, kAgreesRun = 5;

/// Motion over one window, a pair of pictures each.
struct Samples {
  std::vector<double> time_s;
  std::vector<Eigen::Vector2d> px;         ///< what is to be explained
  std::vector<Eigen::Vector2d> travel_px;  ///< what travelling is predicted to do

  void Add(double at_s, const Eigen::Vector2d& value, const Eigen::Vector2d& travel) {
    time_s.push_back(at_s);
    px.push_back(value);
    travel_px.push_back(travel);
  }
  int size() const { return static_cast<int>(px.size()); }
};

/// Mean square that is left of the samples less a straight line for each axis and (a + b t') times
/// the travel for both together, with their freedom.
double Unexplained(const Samples& samples) {
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  const double middle_s = 0.5 * (samples.time_s.front() + samples.time_s.back());
  const double half_s = std::max(0.5 * (samples.time_s.back() - samples.time_s.front()), 1e-9);
  Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
  // An axis without motion, or travel that is a line itself, must not make it singular.
  normal.diagonal() << 1e-9, 1e-9, 1e-9, 1e-9, kLeastNoise2_px2 / (kDepthShare * kDepthShare),
      kLeastNoise2_px2 / (kDepthShare * kDepthShare);
  Vector6 right = Vector6::Zero();
  double square = 0;
  for (std::size_t i = 0; i < samples.px.size(); ++i) {
    const double t = (samples.time_s[i] - middle_s) / half_s;
    for (int axis = 0; axis < 2; ++axis) {
      Vector6 basis = Vector6::Zero();
      basis.segment<2>(2 * axis) << 1, t;
      basis.tail<2>() << samples.travel_px[i][axis], t * samples.travel_px[i][axis];
      normal += basis * basis.transpose();
      right += basis * samples.px[i][axis];
      square += samples.px[i][axis] * samples.px[i][axis];
    }
  }
  const double left = square - right.dot(normal.ldlt().solve(right));
  return std::max(0.0, left) / (2 * (samples.size() - 3));
}

}  // namespace

MotionRate PredictMotion(const VehiclePose& pose, const RigidTransform& X_BC, double focal_px,
                         double depth_m) {
  const Eigen::Vector3d w_C = X_BC.R.transpose() * pose.angular_rate_B;
  MotionRate rate{pose.time, focal_px * Eigen::Vector2d(-w_C.y(), w_C.x())};
  if (depth_m > 0 && std::isfinite(depth_m)) {
    const Eigen::Vector3d v_C = X_BC.R.transpose() * (pose.X_WB.R.transpose() * pose.v_WB);
    rate.travel_px_per_s = -focal_px / depth_m * v_C.head<2>();
  }
  return rate;
}

void ImageTimeMonitor::AddRate(const MotionRate& rate) {
  Motion px_per_s;
  px_per_s << rate.turn_px_per_s, rate.travel_px_per_s;
  if (!px_per_s.allFinite() || (!rates_.empty() && rate.time <= rates_.back().time)) {
    return;
  }
  RatePoint point{rate.time, px_per_s, Motion::Zero()};
  if (!rates_.empty()) {
    const RatePoint& last = rates_.back();
    const double dt = SecondsBetween(last.time, rate.time);
    if (dt > kRateGap_s) {
      rates_.clear();
      motions_.clear();
    } else {
      point.moved_px = last.moved_px + 0.5 * dt * (last.px_per_s + px_per_s);
    }
  }
  rates_.push_back(point);
  while (SecondsBetween(rates_.front().time, rates_.back().time) > kRatesKept_s) {
    rates_.pop_front();
  }
}

void ImageTimeMonitor::AddMotion(const MotionSample& motion) {
  const double between_s = SecondsBetween(motion.from, motion.to);
  if (!(between_s > 0) || between_s > kPictureGap_s || !motion.shift_px.allFinite() ||
      (!motions_.empty() && motion.to <= motions_.back().to)) {
    return;
  }
  motions_.push_back(motion);
  while (SecondsBetween(motions_.front().to, motion.to) > kWindows_s[0]) {
    motions_.pop_front();
  }
  Verdict verdict = JudgeWindow(kWindows_s[0]);
  if (verdict.state != ImageTime::State::kOff) {
    const Verdict newest = JudgeWindow(kWindows_s[1]);
    verdict = newest.state == ImageTime::State::kOff ? newest : verdict;
  }
  Tell(verdict);
}

ImageTimeMonitor::Motion ImageTimeMonitor::MovedAt(double time_s) const {
  // Seconds from the oldest rate; the caller stays inside.
  const auto after =
      std::upper_bound(rates_.begin(), rates_.end(), time_s, [&](double t, const RatePoint& point) {
        return t < SecondsBetween(rates_.front().time, point.time);
      });
  if (after == rates_.end()) {
    return rates_.back().moved_px;
  }
  const RatePoint& b = *after;
  const RatePoint& a = *std::prev(after);
  const double t = time_s - SecondsBetween(rates_.front().time, a.time);
  const double share = t / SecondsBetween(a.time, b.time);
  const Motion mid = a.px_per_s + 0.5 * share * (b.px_per_s - a.px_per_s);
  return a.moved_px + t * mid;
}

ImageTimeMonitor::Motion ImageTimeMonitor::MovedBetween(double from_s, double to_s) const {
  return MovedAt(to_s) - MovedAt(from_s);
}

std::optional<ImageTimeMonitor::Fit> ImageTimeMonitor::FitAt(double shift_s,
                                                             double beside_s) const {
  const double newest_s = SecondsBetween(rates_.front().time, rates_.back().time);
  Samples left;
  for (std::size_t i = first_; i < motions_.size(); ++i) {
    const MotionSample& motion = motions_[i];
    const double from_s = SecondsBetween(rates_.front().time, motion.from) + shift_s;
    const double to_s = SecondsBetween(rates_.front().time, motion.to) + shift_s;
    const double apart_s = beside_s - shift_s;
    if (from_s + std::min(apart_s, 0.0) >= 0 && to_s + std::max(apart_s, 0.0) <= newest_s) {
      const Motion moved = MovedBetween(from_s, to_s);
      left.Add(to_s, motion.shift_px - moved.rowwise().sum(), moved.col(1));
    }
  }
  if (left.size() < kLeastPairs || left.time_s.back() - left.time_s.front() < kLeastSpan_s) {
    return std::nullopt;
  }
  return Fit{Unexplained(left), left.size()};
}

double ImageTimeMonitor::DifferenceOf(double shift_a_s, double shift_b_s) const {
  const double newest_s = SecondsBetween(rates_.front().time, rates_.back().time);
  const double least = std::min(shift_a_s, shift_b_s), most = std::max(shift_a_s, shift_b_s);
  Samples apart;
  for (std::size_t i = first_; i < motions_.size(); ++i) {
    const MotionSample& motion = motions_[i];
    const double from_s = SecondsBetween(rates_.front().time, motion.from);
    const double to_s = SecondsBetween(rates_.front().time, motion.to);
    if (from_s + least >= 0 && to_s + most <= newest_s) {
      const Motion a = MovedBetween(from_s + shift_a_s, to_s + shift_a_s);
      const Motion b = MovedBetween(from_s + shift_b_s, to_s + shift_b_s);
      apart.Add(to_s, (a - b).rowwise().sum(), a.col(1));
    }
  }
  return apart.size() < kLeastPairs ? 0 : Unexplained(apart);
}

std::optional<ImageTimeMonitor::Fit> ImageTimeMonitor::BestFit(double& shift_s) const {
  std::optional<Fit> best;
  const auto consider = [&](double candidate_s) {
    const std::optional<Fit> fit = FitAt(candidate_s, candidate_s);
    if (fit && (!best || fit->residual2_px2 < best->residual2_px2)) {
      best = fit;
      shift_s = candidate_s;
    }
  };
  const int steps = static_cast<int>(std::lround(kMostSearched_s / kStep_s));
  for (int i = -steps; i <= steps; ++i) {
    consider(i * kStep_s);
  }
  const double coarse_s = shift_s;
  consider(coarse_s - kFineStep_s);
  consider(coarse_s + kFineStep_s);
  return best;
}

ImageTimeMonitor::Verdict ImageTimeMonitor::JudgeWindow(double window_s) {
  first_ = 0;
  while (first_ < motions_.size() &&
         SecondsBetween(motions_[first_].to, motions_.back().to) > window_s) {
    ++first_;
  }
  double best_s = 0;
  const std::optional<Fit> best = rates_.size() < 2 ? std::nullopt : BestFit(best_s);
  if (!best) {
    return {};
  }
  Samples seen;
  for (std::size_t i = first_; i < motions_.size(); ++i) {
    const MotionSample& motion = motions_[i];
    seen.Add(SecondsBetween(motions_.front().to, motion.to), motion.shift_px,
             Eigen::Vector2d::Zero());
  }
  const double motion2_px2 = Unexplained(seen);
  const double noise2_px2 = std::max(best->residual2_px2, kLeastNoise2_px2);
  // What an offset of 50 ms more would leave; the offset's sigma follows from the slope.
  const double sharp2_px2 =
      std::max(DifferenceOf(best_s, best_s - kSharp_s), DifferenceOf(best_s, best_s + kSharp_s));
  const double sigma_s =
      sharp2_px2 > 0 ? kSharp_s * std::sqrt(noise2_px2 / (2 * best->count * sharp2_px2)) : INFINITY;
  if (!(sigma_s <= kMostSigma_s) || best->residual2_px2 > kExplained * motion2_px2) {
    return {};
  }
  const std::optional<Fit> none = FitAt(0, best_s);
  if (std::abs(best_s) > kLong_s && !(none && none->residual2_px2 > kBetterThanNone * noise2_px2)) {
    return {};
  }
  const bool off =
      std::abs(best_s) > ImageTime::kLimit_s + 1e-9 && std::abs(best_s) > kSigmas * sigma_s;
  return {off ? ImageTime::State::kOff : ImageTime::State::kAgrees, -best_s, sigma_s};
}

void ImageTimeMonitor::Tell(const Verdict& verdict) {
  using State = ImageTime::State;
  // While a fault stands, pictures that cannot tell count for neither side.
  if (verdict.state == State::kOff) {
    ++off_run_;
    agrees_run_ = 0;
  } else if (verdict.state == State::kAgrees) {
    ++agrees_run_;
    off_run_ = 0;
  } else if (status_.state != State::kOff) {
    off_run_ = 0;
  }
  const bool was_off = status_.state == State::kOff;
  const bool off = was_off ? agrees_run_ < kAgreesRun : off_run_ >= kOffRun;
  if (off && verdict.state == State::kOff) {
    status_ = {State::kOff, verdict.offset_s, verdict.sigma_s};
  } else if (!off) {
    status_ = verdict.state == State::kOff
                  ? ImageTime{}
                  : ImageTime{verdict.state, verdict.offset_s, verdict.sigma_s};
  }
}

}  // namespace palace
