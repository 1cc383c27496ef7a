#include "engine/slad/pictures/laid_view.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "engine/core/median.h"

namespace palace {
namespace {

// The ground beside the line, rows and columns apart.
constexpr int kBandFrom_px = 6, kBandTo_px = 26, kBandStep_px = 4;
constexpr int kSearch_px = 10;  // what the pose may leave over
constexpr int kSearchStride_px = 20;
constexpr int kIterations = 3;
constexpr double kLeastCorrelation = 0.3;
constexpr double kOutlier_medians = 3 * 1.4826;  // of sizes: 3 sigma
constexpr std::size_t kLeastSamples = 100;

}  // namespace

double GreyAt(const ImageF& picture, const Eigen::Vector2d& q) {
  const int x = static_cast<int>(q.x()), y = static_cast<int>(q.y());
  const double f = q.x() - x, g = q.y() - y;
  const float *a = picture.row(y) + x, *b = picture.row(y + 1) + x;
  return (1 - g) * ((1 - f) * double{a[0]} + f * double{a[1]}) +
         g * ((1 - f) * double{b[0]} + f * double{b[1]});
}

bool IsInside(const ImageF& picture, const Eigen::Vector2d& q, double rim_px) {
  return q.x() >= rim_px && q.y() >= rim_px && q.x() < picture.width() - 1 - rim_px &&
         q.y() < picture.height() - 1 - rim_px;
}

LaidView::LaidView(const SceneView& view, const SceneGround& ground,
                   std::shared_ptr<const ImageF> smooth, const OlderView& old)
    : view_(view),
      ground_(ground),
      now_(std::move(smooth)),
      old_(old.smooth),
      X_OldW_(old.pose.X_WC.Inverse()) {
  FindShift();
}

std::optional<LaidView::Registered> LaidView::Register(const PictureLine& line) const {
  return Fit(Band(line));
}

std::optional<double> LaidView::GroundAt(int x, int y) const {
  const int i = x / kBlock_px, j = y / kBlock_px;
  if (x < 0 || y < 0 || i >= ground_.cols() || j >= ground_.rows() ||
      ground_.usable.at(i, j) == 0) {
    return std::nullopt;
  }
  return double{ground_.disparity_px.at(i, j)};
}

Eigen::Vector2d LaidView::InOld(double x, double y, double disparity_px) const {
  const PinholeCamera& camera = view_.range->camera;
  const Eigen::Vector3d p = X_OldW_ * PointAt(view_, x, y, disparity_px);
  if (!(p.z() > 0)) {
    return Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
  }
  return {camera.fx_px * p.x() / p.z() + camera.cx_px, camera.fy_px * p.y() / p.z() + camera.cy_px};
}

void LaidView::FindShift() {
  std::vector<Laid> samples;
  for (int y = kSearchStride_px / 2; y < now_->height(); y += kSearchStride_px) {
    for (int x = kSearchStride_px / 2; x < now_->width(); x += kSearchStride_px) {
      const auto ground = GroundAt(x, y);
      if (!ground) {
        continue;
      }
      const Eigen::Vector2d q = InOld(x, y, *ground);
      if (IsInside(old_, q, kSearch_px + 2)) {
        samples.push_back({double{now_->at(x, y)}, q});
      }
    }
  }
  std::vector<double> off(samples.size());
  const auto left_over = [&](const Eigen::Vector2d& by) {
    double mean = 0;
    for (std::size_t k = 0; k < samples.size(); ++k) {
      off[k] = GreyAt(old_, samples[k].q + by) - samples[k].grey;
      mean += off[k] / static_cast<double>(samples.size());
    }
    return std::accumulate(off.begin(), off.end(), 0.0,
                           [&](double sum, double one) { return sum + std::abs(one - mean); });
  };
  // Every second pixel, then those around the best.
  for (const int step : {2, 1}) {
    const int reach = step > 1 ? kSearch_px : 1;
    const Eigen::Vector2d around = shift_px_;
    double least = std::numeric_limits<double>::infinity();
    for (int dy = -reach; dy <= reach; dy += step) {
      for (int dx = -reach; dx <= reach; dx += step) {
        const Eigen::Vector2d by = around + Eigen::Vector2d(dx, dy);
        const double left = left_over(by);
        if (left < least) {
          least = left;
          shift_px_ = by;
        }
      }
    }
  }
}

std::vector<Laid> LaidView::Band(const PictureLine& line) const {
  std::vector<Laid> band;
  for (std::size_t k = 0; k < line.pixels.size(); k += kBandStep_px / PictureLine::kStep_px) {
    const int x = static_cast<int>(std::lround(line.pixels[k].x()));
    for (int off = kBandFrom_px; off <= kBandTo_px; off += kBandStep_px) {
      for (const int side : {-off, off}) {
        const int y = static_cast<int>(std::lround(line.pixels[k].y())) + side;
        const auto ground = GroundAt(x, y);
        if (!ground) {
          continue;
        }
        const Eigen::Vector2d q = InOld(x, y, *ground) + shift_px_;
        if (IsInside(old_, q, kSearch_px + 2)) {
          band.push_back({double{now_->at(x, y)}, q, line.Along(x)});
        }
      }
    }
  }
  return band;
}

/// A sample of the ground beside the line, where the fit lays it in the older picture.
struct LaidView::OnOld {
  double grey = 0, gx = 0, gy = 0;
  double off = 0;  ///< grey, less the newer picture's
};

std::optional<std::vector<LaidView::OnOld>> LaidView::Sample(const std::vector<Laid>& band,
                                                             const Registered& at) const {
  const Eigen::Vector2d dx(1, 0), dy(0, 1);
  std::vector<OnOld> samples;
  samples.reserve(band.size());
  for (const Laid& laid : band) {
    const Eigen::Vector2d q = at(laid);
    if (!IsInside(old_, q, 1)) {
      return std::nullopt;
    }
    const double grey = GreyAt(old_, q);
    samples.push_back({grey, (GreyAt(old_, q + dx) - GreyAt(old_, q - dx)) / 2,
                       (GreyAt(old_, q + dy) - GreyAt(old_, q - dy)) / 2, grey - laid.grey});
  }
  return samples;
}

/// What stands over the ground, the line itself above all, lies elsewhere in the older picture: on
/// faint ground it would draw the fit to where it is hidden.
std::pair<double, double> LaidView::Usual(const std::vector<OnOld>& samples) {
  std::vector<double> sizes;
  sizes.reserve(samples.size());
  for (const OnOld& sample : samples) {
    sizes.push_back(sample.off);
  }
  const double middle = UpperMedian(sizes);
  for (double& size : sizes) {
    size = std::abs(size - middle);
  }
  return {middle, kOutlier_medians * UpperMedian(sizes)};
}

/// Least squares on the grey, outliers left out: shift along and across, turn.
std::optional<LaidView::Registered> LaidView::Fit(const std::vector<Laid>& band) const {
  if (band.size() < kLeastSamples) {
    return std::nullopt;
  }
  Registered found;
  for (int iteration = 0;; ++iteration) {
    const auto samples = Sample(band, found);
    if (!samples) {
      return std::nullopt;
    }
    const auto [middle, most_off] = Usual(*samples);
    // The fourth unknown is what the light changed.
    Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
    Eigen::Vector4d right = Eigen::Vector4d::Zero();
    double n = 0, sum = 0, square = 0, product = 0, sum_old = 0, square_old = 0;
    for (std::size_t k = 0; k < band.size(); ++k) {
      const OnOld& on_old = (*samples)[k];
      if (std::abs(on_old.off - middle) > most_off) {
        continue;
      }
      const double grey = band[k].grey;
      const Eigen::Vector4d by(on_old.gx, on_old.gy, on_old.gy * band[k].along, 1);
      normal += by * by.transpose();
      right -= by * on_old.off;
      n += 1;
      sum += grey;
      square += grey * grey;
      product += grey * on_old.grey;
      sum_old += on_old.grey;
      square_old += on_old.grey * on_old.grey;
    }
    const Eigen::LDLT<Eigen::Matrix4d> solver(normal);
    if (solver.info() != Eigen::Success || !(solver.vectorD().minCoeff() > 0)) {
      return std::nullopt;
    }
    const Eigen::Vector4d step = solver.solve(right);
    if (!(step.head<3>().norm() < kSearch_px)) {
      return std::nullopt;
    }
    if (iteration == kIterations) {
      const double spread = square - sum * sum / n, old_spread = square_old - sum_old * sum_old / n;
      const double common = product - sum * sum_old / n;
      if (!(common > kLeastCorrelation * std::sqrt(spread * old_spread))) {
        return std::nullopt;
      }
      // Of pictures that are alike to the bit rounding leaves less than nothing.
      const double left_over = std::max(0.0, spread + old_spread - 2 * common) / n;
      found.sigma_px = std::sqrt(left_over * solver.solve(Eigen::Vector4d::Unit(1)).eval()(1));
      return found;
    }
    found.left_px += step.head<3>();
  }
}

}  // namespace palace
