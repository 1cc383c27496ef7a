#include "engine/simulation/picture_tiles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "engine/camera/camera_model.h"
#include "engine/core/units.h"

namespace palace {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kWidestTile_rad = Rad(70);
constexpr int kMargin_px = 3;  // for cubic interpolation
constexpr int kMostSide_px = 8192;
constexpr float kNowhere = -1e4F;

/// Unit rays of every pixel in the camera's own axes; NaN where there is none.
Image<Vector3d> RaysOf(const CameraModel& model) {
  const Eigen::Matrix3d R_CF = RotationOf(model);
  Image<Vector3d> rays(WidthOf(model), HeightOf(model), Vector3d::Constant(NAN));
  for (int y = 0; y < rays.height(); ++y) {
    for (int x = 0; x < rays.width(); ++x) {
      if (const auto ray = RayFromPixelCamera(model, {x, y})) {
        rays.at(x, y) = R_CF * ray->direction.normalized();
      }
    }
  }
  return rays;
}

/// The greatest angle between the rays at the ends of a line of pixels through the middle.
int PartsAcross(const Image<Vector3d>& rays, bool rows) {
  const int length = rows ? rays.height() : rays.width();
  double span_rad = 0;
  Vector3d last = Vector3d::Constant(NAN);
  for (int i = 0; i < length; ++i) {
    const Vector3d& ray = rows ? rays.at(rays.width() / 2, i) : rays.at(i, rays.height() / 2);
    if (ray.allFinite()) {
      span_rad += last.allFinite() ? std::acos(std::min(1.0, ray.dot(last))) : 0;
      last = ray;
    }
  }
  return std::max(1, static_cast<int>(std::ceil(span_rad / kWidestTile_rad)));
}

/// The axes of a camera that looks along `ahead`, its rows as parallel to x as that allows.
Eigen::Matrix3d LookingAlong(const Vector3d& ahead) {
  const Vector3d level =
      std::abs(ahead.x()) < 0.99 ? Vector3d(Vector3d::UnitX()) : Vector3d(-Vector3d::UnitZ());
  Eigen::Matrix3d R;
  R.col(2) = ahead;
  R.col(0) = (level - level.dot(ahead) * ahead).normalized();
  R.col(1) = R.col(2).cross(R.col(0));
  return R;
}

/// Where the tile's rays meet the plane at unit depth before it; NaN for none.
Image<Vector2d> OnUnitPlane(const Image<Vector3d>& rays, const PictureTile& tile) {
  constexpr double kLeastDepth = 0.1;
  Image<Vector2d> plane(tile.width, tile.height, Vector2d::Constant(NAN));
  for (int y = 0; y < tile.height; ++y) {
    for (int x = 0; x < tile.width; ++x) {
      const Vector3d ray_T = tile.R_CT.transpose() * rays.at(tile.x + x, tile.y + y);
      if (ray_T.z() > kLeastDepth) {  // not NaN
        plane.at(x, y) = ray_T.head<2>() / ray_T.z();
      }
    }
  }
  return plane;
}

/// Pixels for each unit of the plane, where the lens has most.
double FinestScale(const Image<Vector2d>& plane) {
  double least = std::numeric_limits<double>::infinity();
  const auto see = [&](const Vector2d& step) {
    const double size = step.norm();
    least = size > 0 && size < least ? size : least;  // not NaN
  };
  for (int y = 0; y < plane.height(); ++y) {
    for (int x = 0; x < plane.width(); ++x) {
      if (x > 0) {
        see(plane.at(x, y) - plane.at(x - 1, y));
      }
      if (y > 0) {
        see(plane.at(x, y) - plane.at(x, y - 1));
      }
    }
  }
  return std::isfinite(least) ? 1 / least : 1;
}

/// The pinhole that covers the tile, and where its pixels lie there.
void CoverTile(const Image<Vector3d>& rays, PictureTile& tile) {
  const Image<Vector2d> plane = OnUnitPlane(rays, tile);
  Eigen::AlignedBox2d box;
  for (const Vector2d& point : plane.pixels()) {
    if (point.allFinite()) {
      box.extend(point);
    }
  }
  if (box.isEmpty()) {
    box.extend(Vector2d(0, 0));
  }
  const double side = std::max(box.sizes().maxCoeff(), 1e-9);
  const double f_px = std::min(FinestScale(plane), (kMostSide_px - 2 * kMargin_px - 2) / side);
  const Vector2d first = Vector2d::Constant(kMargin_px) - f_px * box.min();
  const Eigen::Vector2i size = (f_px * box.sizes()).array().ceil().cast<int>() + 2 * kMargin_px + 1;
  tile.camera = {size.x(), size.y(), f_px, f_px, first.x(), first.y()};
  tile.from_x = ImageF(tile.width, tile.height, kNowhere);
  tile.from_y = tile.from_x;
  for (int y = 0; y < tile.height; ++y) {
    for (int x = 0; x < tile.width; ++x) {
      if (const Vector2d at = f_px * plane.at(x, y) + first; at.allFinite()) {
        tile.from_x.at(x, y) = static_cast<float>(at.x());
        tile.from_y.at(x, y) = static_cast<float>(at.y());
      }
    }
  }
}

/// Equal parts of a side, the last one what is left.
template <typename Each>
void Cut(int side, int parts, Each&& each) {
  const int length = (side + parts - 1) / parts;
  for (int first = 0; first < side; first += length) {
    each(first, std::min(length, side - first));
  }
}

std::vector<PictureTile> TilesOfPinhole(const PinholeCamera& camera, int bands) {
  std::vector<PictureTile> tiles;
  Cut(camera.height, bands, [&](int first, int rows) {
    PictureTile tile{0, first, camera.width, rows, camera, Eigen::Matrix3d::Identity(), {}, {}};
    tile.camera.height = rows;
    tile.camera.cy_px -= first;
    tiles.push_back(std::move(tile));
  });
  return tiles;
}

}  // namespace

std::vector<PictureTile> TilesOf(const RigCamera& camera, int bands) {
  if (!camera.model) {
    return TilesOfPinhole(camera.pinhole, bands);
  }
  const Image<Vector3d> rays = RaysOf(*camera.model);
  const int columns = PartsAcross(rays, false);
  std::vector<PictureTile> tiles;
  Cut(rays.height(), std::max(bands, PartsAcross(rays, true)), [&](int top, int rows) {
    Cut(rays.width(), columns, [&](int left, int width) {
      PictureTile tile{left, top, width, rows, {}, Eigen::Matrix3d::Identity(), {}, {}};
      Vector3d middle = Vector3d::Zero();
      for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < width; ++x) {
          const Vector3d& ray = rays.at(left + x, top + y);
          middle += ray.allFinite() ? ray : Vector3d::Zero();
        }
      }
      if (middle.norm() > 0) {
        tile.R_CT = LookingAlong(middle.normalized());
      }
      CoverTile(rays, tile);
      tiles.push_back(std::move(tile));
    });
  });
  return tiles;
}

ImageF ThroughLens(const PictureTile& tile, ImageF drawing) {
  if (tile.from_x.empty()) {
    return drawing;
  }
  const auto view = [](const ImageF& image) {
    // OpenCV has no read-only view; remap does not write these.
    return cv::Mat(image.height(), image.width(), CV_32F, const_cast<float*>(image.row(0)));
  };
  ImageF seen(tile.width, tile.height);
  cv::Mat target = view(seen);
  cv::remap(view(drawing), target, view(tile.from_x), view(tile.from_y), cv::INTER_CUBIC,
            cv::BORDER_CONSTANT, cv::Scalar(0));
  return seen;
}

}  // namespace palace
