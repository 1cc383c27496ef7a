#include "engine/camera/conversion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "engine/camera/alignment.h"
#include "engine/camera/cahvor.h"
#include "engine/camera/conversion_targets.h"

namespace palace {
namespace {

constexpr int kFitColumns = 33;
constexpr int kFitRows = 25;
constexpr int kCheckColumns = 64;
constexpr int kCheckRows = 48;
constexpr double kGood_px = 1e-9;  // rounding of the projections

struct Sample {
  Eigen::Vector2d pixel;
  Eigen::Vector3d direction;
};

/// Rays of a grid that includes the picture's corners.
std::vector<Sample> SamplesOf(const CameraModel& camera, int columns, int rows, int& without_ray) {
  std::vector<Sample> samples;
  without_ray = 0;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const Eigen::Vector2d pixel(i * (WidthOf(camera) - 1.0) / (columns - 1),
                                  j * (HeightOf(camera) - 1.0) / (rows - 1));
      if (const auto ray = RayFromPixelCamera(camera, pixel)) {
        samples.push_back({pixel, ray->direction});
      } else {
        ++without_ray;
      }
    }
  }
  return samples;
}

Residual Compare(const std::vector<Sample>& samples, const CameraModel& to) {
  Residual residual;
  double sum = 0;
  for (const Sample& sample : samples) {
    const auto seen = ProjectDirection(to, sample.direction);
    if (!seen) {
      ++residual.unseen;
      continue;
    }
    const double distance = (*seen - sample.pixel).norm();
    sum += distance * distance;
    ++residual.pixels;
    if (distance > residual.max_px) {
      residual.max_px = distance;
      residual.worst_pixel = sample.pixel;
    }
  }
  residual.rms_px = residual.pixels > 0 ? std::sqrt(sum / residual.pixels) : 0;
  return residual;
}

/// Residuals of all samples; nothing when one has no pixel.
std::optional<Eigen::VectorXd> Errors(const std::vector<Sample>& samples, const CameraModel& to) {
  Eigen::VectorXd errors(2 * static_cast<Eigen::Index>(samples.size()));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const auto seen = ProjectDirection(to, samples[i].direction);
    if (!seen) {
      return std::nullopt;
    }
    errors.segment<2>(2 * static_cast<Eigen::Index>(i)) = *seen - samples[i].pixel;
  }
  return errors;
}

/// Levenberg-Marquardt with central differences; each parameter is of the order of 1. Steps into
/// parameters that lose a ray count as uphill. Nothing when the start already loses one.
std::optional<Eigen::VectorXd> Fit(const std::vector<Sample>& samples,
                                   const ConversionTarget& target, Eigen::VectorXd x) {
  auto errors = Errors(samples, target.camera(x));
  if (!errors) {
    return std::nullopt;
  }
  const double good = kGood_px * kGood_px * static_cast<double>(samples.size());
  double damping = 1e-4;
  for (int iteration = 0; iteration < 200 && errors->squaredNorm() > good; ++iteration) {
    constexpr double kStep = 1e-6;
    Eigen::MatrixXd J(errors->size(), x.size());
    for (Eigen::Index k = 0; k < x.size(); ++k) {
      const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(x.size(), k);
      const auto plus = Errors(samples, target.camera(x + step));
      const auto minus = Errors(samples, target.camera(x - step));
      if (!plus || !minus) {
        return x;  // at the border of the model's range
      }
      J.col(k) = (*plus - *minus) / (2 * kStep);
    }
    const Eigen::MatrixXd normal = J.transpose() * J;
    const Eigen::VectorXd gradient = J.transpose() * *errors;
    bool improved = false;
    double gain = 0;
    while (!improved && damping < 1e12) {
      Eigen::MatrixXd damped = normal;
      damped.diagonal() += damping * (normal.diagonal().array() + 1e-12).matrix();
      const Eigen::VectorXd next = x - damped.ldlt().solve(gradient);
      const auto next_errors = next.allFinite() ? Errors(samples, target.camera(next))
                                                : std::optional<Eigen::VectorXd>();
      improved = next_errors && next_errors->squaredNorm() < errors->squaredNorm();
      if (improved) {
        gain = 1 - next_errors->squaredNorm() / errors->squaredNorm();
        x = next;
        errors = next_errors;
      }
      damping = improved ? std::max(damping / 10, 1e-15) : damping * 4;
    }
    if (!improved || gain < 1e-10) {
      break;
    }
  }
  return x;
}

double WidestAngle(const std::vector<Sample>& samples, const Eigen::Vector3d& axis) {
  double least = 1;
  for (const Sample& sample : samples) {
    least = std::min(least, sample.direction.dot(axis));
  }
  return std::acos(std::clamp(least, -1.0, 1.0));
}

Result<CameraModel> Refit(const CameraModel& source, LensFamily family,
                          const std::vector<Sample>& samples) {
  std::optional<CameraModel> best;
  double best_cost = std::numeric_limits<double>::infinity();
  for (const ConversionTarget& target : ConversionTargets(source, family)) {
    const auto x = Fit(samples, target, target.start);
    if (!x) {
      continue;
    }
    const double cost = Errors(samples, target.camera(*x))->squaredNorm();
    if (cost < best_cost) {
      best_cost = cost;
      best = target.camera(*x);
    }
  }
  if (!best) {
    const double angle = WidestAngle(samples, LinearPartOf(source).A);
    return InvalidError(
        "the picture holds rays " +
        std::to_string(static_cast<int>(std::lround(angle * 180 / std::numbers::pi))) +
        " degrees off the axis, beyond the range of " + LensFamilyName(family) +
        "; choose cahvore or fisheye");
  }
  return *best;
}

}  // namespace

const char* LensFamilyName(LensFamily family) {
  static constexpr std::array<const char*, 10> kNames = {
      "cahv",    "cahvor",  "cahvore", "tsai",     "pinhole",
      "opencv4", "opencv5", "opencv8", "opencv12", "fisheye"};
  return kNames[static_cast<std::size_t>(family)];
}

std::optional<LensFamily> LensFamilyFromName(const std::string& name) {
  for (int i = 0; i <= static_cast<int>(LensFamily::kFisheye); ++i) {
    if (name == LensFamilyName(static_cast<LensFamily>(i))) {
      return static_cast<LensFamily>(i);
    }
  }
  return std::nullopt;
}

Residual ResidualOf(const CameraModel& from, const CameraModel& to) {
  int without_ray = 0;
  Residual residual = Compare(SamplesOf(from, kCheckColumns, kCheckRows, without_ray), to);
  residual.without_ray = without_ray;
  return residual;
}

Result<ConvertedCamera> ConvertCamera(const CameraModel& source, LensFamily family) {
  if (WidthOf(source) < 2 || HeightOf(source) < 2) {
    return InvalidError("the camera model tells no picture size; give --size");
  }
  ConvertedCamera converted;
  if (IsOfFamily(source, family)) {
    converted.model = source;
    converted.residual = ResidualOf(source, source);
    return converted;
  }
  const CameraModel metric = InUnit(source, 1);
  int without_ray = 0;
  const std::vector<Sample> samples = SamplesOf(metric, kFitColumns, kFitRows, without_ray);
  if (2 * without_ray > kFitColumns * kFitRows) {
    return InvalidError(
        "more than half of the picture's pixels have no ray in this model; is its "
        "size right?");
  }
  if (const auto exact = ConvertedExactly(metric, family)) {
    converted.model = *exact;
  } else if (family == LensFamily::kCahv) {
    const auto linear = LinearizeCamera(metric);
    if (!linear) {
      return linear.error();
    }
    converted.model = {*linear, 1, metric.pose_is_known};
  } else {
    const auto fitted = Refit(metric, family, samples);
    if (!fitted) {
      return fitted.error();
    }
    converted.model = *fitted;
  }
  converted.residual = ResidualOf(metric, converted.model);
  const bool keeps_shear = family == LensFamily::kCahv || family == LensFamily::kCahvor ||
                           family == LensFamily::kCahvore;
  converted.lost_shear_px = keeps_shear ? 0 : PinholeFromCahv(LinearPartOf(metric)).shear_px;
  if (const auto* cahvore = std::get_if<CahvoreModel>(&metric.lens)) {
    for (const Sample& sample : samples) {
      const auto ray = RayFromPixelCamera(metric, sample.pixel);
      converted.lost_pupil_m =
          std::max(converted.lost_pupil_m, (ray->origin - cahvore->base.C).norm());
    }
  }
  return converted;
}

}  // namespace palace
