#include "engine/tracking/picture_shift.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <opencv2/core/eigen.hpp>
#include <opencv2/imgproc.hpp>

namespace palace {
namespace {

constexpr int kLeastSide_px = 24;  // of a level that is used
constexpr int kIterations = 12;
constexpr double kStill_px = 0.002;     // a step that ends the iteration
constexpr double kLeastGradient = 1.0;  // mean squared, grey levels per block
constexpr double kLeastOverlap = 0.5;
constexpr double kLeastCorrelation = 0.8;

ImageF BlockMeans(const ImageU8& picture, int side) {
  ImageF means(picture.width() / side, picture.height() / side);
  for (int y = 0; y < means.height(); ++y) {
    for (int x = 0; x < means.width(); ++x) {
      int sum = 0;
      for (int v = 0; v < side; ++v) {
        const std::uint8_t* row = picture.row(y * side + v) + x * side;
        for (int u = 0; u < side; ++u) {
          sum += row[u];
        }
      }
      means.at(x, y) = static_cast<float>(sum) / static_cast<float>(side * side);
    }
  }
  return means;
}

ImageF Halved(const ImageF& image) {
  ImageF half(image.width() / 2, image.height() / 2);
  for (int y = 0; y < half.height(); ++y) {
    for (int x = 0; x < half.width(); ++x) {
      half.at(x, y) = 0.25F * (image.at(2 * x, 2 * y) + image.at(2 * x + 1, 2 * y) +
                               image.at(2 * x, 2 * y + 1) + image.at(2 * x + 1, 2 * y + 1));
    }
  }
  return half;
}

/// Sums over the pixels that both pictures show at one displacement.
struct Sums {
  double count = 0;
  Eigen::Matrix2d gradients = Eigen::Matrix2d::Zero();
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
  Eigen::Vector2d gradient_difference = Eigen::Vector2d::Zero();
  double before = 0, after = 0, before2 = 0, after2 = 0, both = 0;
};

Sums SumAt(const ImageF& before, const ImageF& after, const Eigen::Vector2d& d) {
  Sums sums;
  const int dx = static_cast<int>(std::floor(d.x())), dy = static_cast<int>(std::floor(d.y()));
  const double tx = d.x() - dx, ty = d.y() - dy;
  for (int y = std::max(1, -dy); y < std::min(before.height() - 1, before.height() - 1 - dy); ++y) {
    for (int x = std::max(1, -dx); x < std::min(before.width() - 1, before.width() - 1 - dx); ++x) {
      const double a = before.at(x, y);
      const float* top = after.row(y + dy) + x + dx;
      const float* low = after.row(y + dy + 1) + x + dx;
      const double b =
          (1 - ty) * ((1 - tx) * static_cast<double>(top[0]) + tx * static_cast<double>(top[1])) +
          ty * ((1 - tx) * static_cast<double>(low[0]) + tx * static_cast<double>(low[1]));
      const double gx = 0.5 * static_cast<double>(before.at(x + 1, y) - before.at(x - 1, y));
      const double gy = 0.5 * static_cast<double>(before.at(x, y + 1) - before.at(x, y - 1));
      sums.count += 1;
      sums.gradients(0, 0) += gx * gx;
      sums.gradients(0, 1) += gx * gy;
      sums.gradients(1, 1) += gy * gy;
      sums.gradient += Eigen::Vector2d(gx, gy);
      sums.gradient_difference += (b - a) * Eigen::Vector2d(gx, gy);
      sums.before += a;
      sums.after += b;
      sums.before2 += a * a;
      sums.after2 += b * b;
      sums.both += a * b;
    }
  }
  sums.gradients(1, 0) = sums.gradients(0, 1);
  return sums;
}

/// The step that brings the pictures together, the change of brightness solved out; nothing where
/// they overlap too little or show no texture.
std::optional<Eigen::Vector2d> Step(const Sums& sums, double pixels) {
  if (sums.count < kLeastOverlap * pixels) {
    return std::nullopt;
  }
  const Eigen::Vector2d mean = sums.gradient / sums.count;
  const Eigen::Matrix2d A = sums.gradients / sums.count - mean * mean.transpose();
  const double trace = A.trace(), determinant = A.determinant();
  const double least =
      trace / 2 - std::sqrt(std::max(0.0, trace * trace / 4 - determinant));  // eigenvalue
  if (!(least >= kLeastGradient)) {
    return std::nullopt;
  }
  const Eigen::Vector2d b =
      sums.gradient_difference / sums.count - mean * ((sums.after - sums.before) / sums.count);
  return Eigen::Vector2d(-(A(1, 1) * b.x() - A(0, 1) * b.y()) / determinant,
                         -(A(0, 0) * b.y() - A(1, 0) * b.x()) / determinant);
}

double Correlation(const Sums& sums) {
  const double n = sums.count;
  const double a = sums.before2 - sums.before * sums.before / n;
  const double b = sums.after2 - sums.after * sums.after / n;
  return a > 0 && b > 0 ? (sums.both - sums.before * sums.after / n) / std::sqrt(a * b) : 0;
}

/// The levels below the finest, as far as it is large enough.
PicturePyramid WithLevels(ImageF level) {
  PicturePyramid pyramid;
  for (ImageF& kept : pyramid.levels) {
    if (std::min(level.width(), level.height()) < kLeastSide_px) {
      break;
    }
    kept = level;
    level = Halved(level);
  }
  return pyramid;
}

}  // namespace

PicturePyramid MakePyramid(const ImageU8& picture) {
  return WithLevels(BlockMeans(picture, PicturePyramid::kFinest));
}

PicturePyramid TurnedAroundMiddle(const PicturePyramid& before, const PinholeCamera& camera,
                                  const Eigen::Matrix3d& R_now_before) {
  const ImageF& finest = before.levels[0];
  if (finest.empty()) {
    return before;
  }
  // A block's middle is half a block from its first pixel, less half a pixel.
  constexpr double kSide = PicturePyramid::kFinest, kMiddle = (kSide - 1) / 2;
  Eigen::Matrix3d K = Eigen::Matrix3d::Identity();
  K.diagonal() << camera.fx_px / kSide, camera.fy_px / kSide, 1;
  K.col(2) << (camera.cx_px - kMiddle) / kSide, (camera.cy_px - kMiddle) / kSide, 1;
  const Eigen::Vector3d axis = R_now_before.col(2) / R_now_before(2, 2);
  Eigen::Matrix3d back = Eigen::Matrix3d::Identity();
  back.topRightCorner<2, 1>() = (K.col(2) - K * axis).head<2>();
  cv::Mat H;
  cv::eigen2cv(Eigen::Matrix3d(back * K * R_now_before * K.inverse()), H);
  ImageF turned(finest.width(), finest.height());
  // OpenCV reads through a pointer that is not const.
  const cv::Mat from(finest.height(), finest.width(), CV_32F, const_cast<float*>(finest.row(0)));
  cv::Mat to(turned.height(), turned.width(), CV_32F, turned.row(0));
  cv::warpPerspective(from, to, H, to.size(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return WithLevels(std::move(turned));
}

std::optional<Eigen::Vector2d> ShiftBetween(const PicturePyramid& before,
                                            const PicturePyramid& after) {
  const ImageF& finest = before.levels[0];
  if (finest.empty() || finest.width() != after.levels[0].width() ||
      finest.height() != after.levels[0].height()) {
    return std::nullopt;
  }
  Eigen::Vector2d d = Eigen::Vector2d::Zero();
  double correlation = 0;
  for (int level = PicturePyramid::kLevels - 1; level >= 0; --level) {
    const ImageF& a = before.levels[static_cast<std::size_t>(level)];
    const ImageF& b = after.levels[static_cast<std::size_t>(level)];
    if (a.empty()) {
      continue;
    }
    d *= 2;
    for (int i = 0; i < kIterations; ++i) {
      const Sums sums = SumAt(a, b, d);
      const auto step = Step(sums, static_cast<double>(a.width()) * a.height());
      if (!step) {
        return std::nullopt;
      }
      correlation = Correlation(sums);
      d += *step;
      if (step->norm() < kStill_px) {
        break;
      }
    }
  }
  if (!(correlation >= kLeastCorrelation)) {
    return std::nullopt;
  }
  return PicturePyramid::kFinest * d;
}

}  // namespace palace
