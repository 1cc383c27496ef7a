#include "engine/camera/conversion_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace palace {
namespace {

constexpr double kGood_px = 1e-9;  // rounding of the projections
constexpr double kFine_px = 1;     // no other way down is tried below
constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr std::array<Eigen::Index, 5> kAnchored = {0, 1, 2, 5, 6};  // turn and centre

/// Errors of the first `count` samples, NaN where a ray has no pixel, and the prior's.
class Residuals {
 public:
  Residuals(const std::vector<RaySample>& samples, std::size_t count,
            const ConversionTarget& target, const Eigen::VectorXd& anchor, double lost_px)
      : samples_(samples),
        pixels_(static_cast<Eigen::Index>(2 * count)),
        target_(target),
        anchor_(anchor),
        weight_px_(target.prior_weight * target.focal_px * std::sqrt(static_cast<double>(count))),
        lost_px_(lost_px) {}

  /// Sum of squares; a lost ray counts as one that is lost_px off.
  double Cost(const Eigen::VectorXd& errors) const {
    return PixelCost(errors) + errors.tail<kAnchored.size()>().squaredNorm();
  }
  double PixelCost(const Eigen::VectorXd& errors) const {
    double cost = 0;
    for (Eigen::Index i = 0; i < pixels_; i += 2) {
      const double square = errors.segment<2>(i).squaredNorm();
      cost += std::isfinite(square) ? square : lost_px_ * lost_px_;
    }
    return cost;
  }

  Eigen::VectorXd At(const Eigen::VectorXd& x) const {
    Eigen::VectorXd errors(pixels_ + static_cast<Eigen::Index>(kAnchored.size()));
    const CameraModel camera = target_.camera(x);
    for (Eigen::Index i = 0; i < pixels_; i += 2) {
      const RaySample& sample = samples_[static_cast<std::size_t>(i / 2)];
      const auto seen = ProjectDirection(camera, sample.direction);
      errors.segment<2>(i) = seen ? Eigen::Vector2d(*seen - sample.pixel)
                                  : Eigen::Vector2d(Eigen::Vector2d::Constant(NAN));
    }
    for (std::size_t i = 0; i < kAnchored.size(); ++i) {
      errors[pixels_ + static_cast<Eigen::Index>(i)] =
          weight_px_ * (x[kAnchored[i]] - anchor_[kAnchored[i]]);
    }
    return errors;
  }

  /// Derivative of At, whose value at x is `errors`; 0 for lost rays.
  Eigen::MatrixXd SlopeAt(const Eigen::VectorXd& x, const Eigen::VectorXd& errors) const {
    Eigen::MatrixXd J(errors.size(), x.size());
    for (Eigen::Index k = 0; k < x.size(); ++k) {
      const double h = 1e-6 * std::max(1.0, std::abs(x[k]));
      const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(x.size(), k);
      const Eigen::VectorXd plus = At(x + step);
      const Eigen::VectorXd minus = At(x - step);
      for (Eigen::Index i = 0; i < errors.size(); ++i) {
        const bool has_plus = std::isfinite(plus[i]) && std::isfinite(errors[i]);
        const bool has_minus = std::isfinite(minus[i]) && std::isfinite(errors[i]);
        const double rise = (has_plus ? plus[i] : errors[i]) - (has_minus ? minus[i] : errors[i]);
        J(i, k) = has_plus || has_minus ? rise / (has_plus && has_minus ? 2 * h : h) : 0;
      }
    }
    return J;
  }

 private:
  const std::vector<RaySample>& samples_;
  Eigen::Index pixels_;
  const ConversionTarget& target_;
  const Eigen::VectorXd& anchor_;
  double weight_px_;
  double lost_px_;
};

Eigen::VectorXd WithoutLost(const Eigen::VectorXd& errors) {
  return errors.unaryExpr([](double e) { return std::isfinite(e) ? e : 0; });
}

/// Levenberg-Marquardt from x.
Eigen::VectorXd Descend(const Residuals& residuals, Eigen::VectorXd x) {
  Eigen::VectorXd errors = residuals.At(x);
  double cost = residuals.Cost(errors);
  const double good = kGood_px * kGood_px * static_cast<double>(errors.size());
  double damping = 1e-4;
  int idle = 0;
  for (int iteration = 0; iteration < 60 && idle < 3 && cost > good; ++iteration) {
    const Eigen::MatrixXd J = residuals.SlopeAt(x, errors);
    const Eigen::MatrixXd normal = J.transpose() * J;
    const Eigen::VectorXd gradient = J.transpose() * WithoutLost(errors);
    const double before = cost;
    bool improved = false;
    while (!improved && damping < 1e12) {
      Eigen::MatrixXd damped = normal;
      damped.diagonal() += damping * (normal.diagonal().array() + 1e-12).matrix();
      const Eigen::VectorXd next = x - damped.ldlt().solve(gradient);
      if (next.allFinite()) {
        Eigen::VectorXd next_errors = residuals.At(next);
        const double next_cost = residuals.Cost(next_errors);
        improved = next_cost < before;
        if (improved) {
          x = next;
          errors = std::move(next_errors);
          cost = next_cost;
        }
      }
      damping = improved ? std::max(damping / 10, 1e-15) : damping * 4;
    }
    if (!improved) {
      break;
    }
    idle = 1 - cost / before < 1e-7 ? idle + 1 : 0;
  }
  return x;
}

}  // namespace

std::optional<TargetFit> FitTarget(const std::vector<RaySample>& samples,
                                   const std::vector<RaySample>& judges,
                                   const ConversionTarget& target, const Eigen::VectorXd& start) {
  const CameraModel camera = target.camera(target.start);
  const double diagonal_px = std::hypot(WidthOf(camera), HeightOf(camera));
  const Residuals all(samples, samples.size(), target, start, diagonal_px);
  const Residuals all_or_none(samples, samples.size(), target, start, kNever);
  const Residuals judged(judges, judges.size(), target, start, diagonal_px);
  if (!all.At(target.start).allFinite()) {
    return std::nullopt;
  }
  TargetFit best{start, judged.PixelCost(judged.At(start))};
  const auto is_fine = [&] {
    return best.cost_px2 < kFine_px * kFine_px * static_cast<double>(judges.size());
  };
  const auto descend_from = [&](const Eigen::VectorXd& from) {
    for (const Residuals* residuals : {&all_or_none, &all}) {
      const Eigen::VectorXd x = Descend(*residuals, from);
      const double cost_px2 = judged.PixelCost(judged.At(x));
      if (cost_px2 < best.cost_px2) {
        best = {x, cost_px2};
      }
      if (target.only_refines || is_fine()) {
        return;
      }
    }
  };
  descend_from(start);
  if (target.only_refines || is_fine()) {
    return best;
  }
  descend_from(target.start);
  Eigen::VectorXd grown = target.start;
  for (const double share : {0.4, 0.6, 0.8, 0.9, 0.97}) {
    const auto count = static_cast<std::size_t>(share * static_cast<double>(samples.size()));
    grown = Descend(Residuals(samples, count, target, start, diagonal_px), grown);
  }
  descend_from(grown);
  return best;
}

double GradientCosine(const std::vector<RaySample>& samples, const ConversionTarget& target,
                      const Eigen::VectorXd& x) {
  const Residuals all(samples, samples.size(), target, x, kNever);
  const Eigen::VectorXd errors = all.At(x);
  const Eigen::MatrixXd J =
      all.SlopeAt(x, errors).topRows(errors.size() - static_cast<Eigen::Index>(kAnchored.size()));
  const Eigen::VectorXd pixels = WithoutLost(errors).head(J.rows());
  double greatest = 0;
  for (Eigen::Index k = 0; k < J.cols(); ++k) {
    const double size = J.col(k).norm() * pixels.norm();
    greatest = std::max(greatest, size > 0 ? std::abs(J.col(k).dot(pixels)) / size : 0);
  }
  return greatest;
}

}  // namespace palace
