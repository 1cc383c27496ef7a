#include "engine/camera/conversion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "engine/camera/alignment.h"
#include "engine/camera/cahvor.h"
#include "engine/camera/conversion_fit.h"
#include "engine/camera/conversion_targets.h"

namespace palace {
namespace {

constexpr int kFitColumns = 33;
constexpr int kFitRows = 25;
constexpr int kCheckColumns = 64;
constexpr int kCheckRows = 48;

/// Rays of a grid that includes the picture's corners.
std::vector<RaySample> SamplesOf(const CameraModel& camera, int columns, int rows,
                                 int& without_ray) {
  std::vector<RaySample> samples;
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

Residual Compare(const std::vector<RaySample>& samples, const CameraModel& to) {
  Residual residual;
  double sum = 0;
  for (const RaySample& sample : samples) {
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

double WidestAngle(const std::vector<RaySample>& samples, const Eigen::Vector3d& axis) {
  double least = 1;
  for (const RaySample& sample : samples) {
    least = std::min(least, sample.direction.dot(axis));
  }
  return std::acos(std::clamp(least, -1.0, 1.0));
}

/// A fitted family: the best of its targets, and that of the first, which extends smaller ones.
struct FamilyFit {
  CameraModel camera;
  TargetFit first;
  double cost_px2 = 0;
};

/// Fits the nested families first: each begins where the smaller one ended.
std::optional<FamilyFit> FitFamily(const CameraModel& source, LensFamily family,
                                   const std::vector<RaySample>& samples,
                                   const std::vector<RaySample>& judges, double widest_tangent) {
  const auto smaller = NestedFamily(family);
  const auto nested = smaller ? FitFamily(source, *smaller, samples, judges, widest_tangent)
                              : std::optional<FamilyFit>();
  std::optional<FamilyFit> best;
  for (const ConversionTarget& target : ConversionTargets(source, family, widest_tangent)) {
    Eigen::VectorXd start = target.start;
    const bool is_first = !best;
    if (nested && is_first) {
      start.head(nested->first.x.size()) = nested->first.x;
    }
    const auto fit = FitTarget(samples, judges, target, start);
    if (is_first && fit) {
      best = FamilyFit{target.camera(fit->x), *fit, fit->cost_px2};
    } else if (fit && fit->cost_px2 < best->cost_px2) {
      best->camera = target.camera(fit->x);
      best->cost_px2 = fit->cost_px2;
    }
  }
  return best;
}

Result<CameraModel> Refit(const CameraModel& source, LensFamily family,
                          std::vector<RaySample> samples) {
  int without_ray = 0;
  const std::vector<RaySample> judges = SamplesOf(source, kCheckColumns, kCheckRows, without_ray);
  const Eigen::Vector3d axis = LinearPartOf(source).A;
  std::stable_sort(samples.begin(), samples.end(), [&](const RaySample& a, const RaySample& b) {
    return a.direction.dot(axis) > b.direction.dot(axis);
  });
  const double angle = WidestAngle(samples, axis);
  const auto fit = FitFamily(source, family, samples, judges, angle < 1.57 ? std::tan(angle) : 1);
  if (!fit) {
    return InvalidError(
        "the picture holds rays " +
        std::to_string(static_cast<int>(std::lround(angle * 180 / std::numbers::pi))) +
        " degrees off the axis, beyond the range of " + LensFamilyName(family) +
        "; choose cahvore or fisheye");
  }
  return fit->camera;
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
  const std::vector<RaySample> samples = SamplesOf(metric, kFitColumns, kFitRows, without_ray);
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
    for (const RaySample& sample : samples) {
      const auto ray = RayFromPixelCamera(metric, sample.pixel);
      converted.lost_pupil_m =
          std::max(converted.lost_pupil_m, (ray->origin - cahvore->base.C).norm());
    }
  }
  return converted;
}

}  // namespace palace
