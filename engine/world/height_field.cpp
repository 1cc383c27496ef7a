#include "engine/world/height_field.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <opencv2/core/utility.hpp>

#include "engine/core/check.h"
#include "engine/world/lattice_noise.h"

namespace palace {
namespace {

using Eigen::Vector3d;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A ray in cells of the field: x to the north, y to the east, h up in metres.
struct CellRay {
  double x, y, h;
  double dx, dy, dh;

  double Leaves(double low, double high, double at, double per_s) const {
    return per_s > 0 ? (high - at) / per_s : per_s < 0 ? (low - at) / per_s : kInfinity;
  }
};

}  // namespace

HeightField::HeightField(const Place& place, const std::function<double(double, double)>& height)
    : place_(place), cells_(1 << place.levels), cell_m_(place.size_m / cells_) {
  PALACE_CHECK(place.levels >= 4 && place.levels <= 12 && place.size_m > 0, place.levels,
               place.size_m);
  corners_.resize(static_cast<std::size_t>(cells_ + 1) * static_cast<std::size_t>(cells_ + 1));
  cv::parallel_for_(cv::Range(0, cells_ + 1), [&](const cv::Range& rows) {
    for (int i = rows.start; i < rows.end; ++i) {
      for (int j = 0; j <= cells_; ++j) {
        corners_[At(i, j)] =
            static_cast<float>(height(place_.north_m + i * cell_m_, place_.east_m + j * cell_m_));
      }
    }
  });
  lowest_m_ = static_cast<double>(*std::min_element(corners_.begin(), corners_.end()));
  const auto side = static_cast<std::size_t>(cells_);
  levels_.emplace_back(side * side);
  for (int i = 0; i < cells_; ++i) {
    for (int j = 0; j < cells_; ++j) {
      levels_[0][static_cast<std::size_t>(i) * side + static_cast<std::size_t>(j)] =
          std::max({corners_[At(i, j)], corners_[At(i + 1, j)], corners_[At(i, j + 1)],
                    corners_[At(i + 1, j + 1)]});
    }
  }
  for (std::size_t fine = side; fine > 1; fine /= 2) {
    const std::vector<float>& below = levels_.back();
    std::vector<float> next(fine / 2 * (fine / 2));
    for (std::size_t i = 0; i < fine / 2; ++i) {
      for (std::size_t j = 0; j < fine / 2; ++j) {
        const float* at = &below[2 * i * fine + 2 * j];
        next[i * (fine / 2) + j] = std::max({at[0], at[1], at[fine], at[fine + 1]});
      }
    }
    levels_.push_back(std::move(next));
  }
}

int HeightField::Mirrored(std::int64_t index) const {
  const std::int64_t twice = 2 * static_cast<std::int64_t>(cells_);
  const std::int64_t within = ((index % twice) + twice) % twice;
  return static_cast<int>(within <= cells_ ? within : twice - within);
}

float HeightField::Highest(int level, std::int64_t i, std::int64_t j) const {
  const std::int64_t side = cells_ >> level;
  const auto fold = [side](std::int64_t index) {
    const std::int64_t within = ((index % (2 * side)) + 2 * side) % (2 * side);
    return static_cast<std::size_t>(within < side ? within : 2 * side - 1 - within);
  };
  return levels_[static_cast<std::size_t>(level)]
                [fold(i) * static_cast<std::size_t>(side) + fold(j)];
}

HeightField::Corners HeightField::CornersOf(std::int64_t i, std::int64_t j) const {
  const int south = Mirrored(i), north = Mirrored(i + 1);
  const int west = Mirrored(j), east = Mirrored(j + 1);
  return {Corner(south, west), Corner(north, west), Corner(south, east), Corner(north, east)};
}

double HeightField::Height(double north_m, double east_m) const {
  const double x = (north_m - place_.north_m) / cell_m_, y = (east_m - place_.east_m) / cell_m_;
  const double i = FastFloor(x), j = FastFloor(y);
  const Corners c = CornersOf(static_cast<std::int64_t>(i), static_cast<std::int64_t>(j));
  const double a = x - i, b = y - j;
  return a >= b ? c.sw + (c.nw - c.sw) * a + (c.ne - c.nw) * b
                : c.sw + (c.ne - c.se) * a + (c.se - c.sw) * b;
}

Vector3d HeightField::Normal(double north_m, double east_m) const {
  const double x = (north_m - place_.north_m) / cell_m_, y = (east_m - place_.east_m) / cell_m_;
  const double i = FastFloor(x), j = FastFloor(y);
  const Corners c = CornersOf(static_cast<std::int64_t>(i), static_cast<std::int64_t>(j));
  const bool north_half = x - i >= y - j;
  const double rise_north = (north_half ? c.nw - c.sw : c.ne - c.se) / cell_m_;
  const double rise_east = (north_half ? c.ne - c.nw : c.se - c.sw) / cell_m_;
  return Vector3d(-rise_north, -rise_east, -1).normalized();
}

double HeightField::Cast(const Vector3d& p_W, const Vector3d& r_W) const {
  const CellRay ray{(p_W.x() - place_.north_m) / cell_m_,
                    (p_W.y() - place_.east_m) / cell_m_,
                    -p_W.z(),
                    r_W.x() / cell_m_,
                    r_W.y() / cell_m_,
                    -r_W.z()};
  double s = 0;
  if (ray.h > highest_m()) {
    if (!(ray.dh < 0)) {
      return kInfinity;
    }
    s = (highest_m() - ray.h) / ray.dh;
  }
  const int top = static_cast<int>(levels_.size()) - 1;
  int level = std::min(top, 3);
  const auto block = [&](double at) {
    return static_cast<std::int64_t>(FastFloor(std::ldexp(at, -level)));
  };
  std::int64_t i = block(ray.x + s * ray.dx), j = block(ray.y + s * ray.dy);
  // A ray nearly along the ground may cross very many cells: it is given up far outside of any
  // picture.
  for (int steps = 0; steps < 200'000; ++steps) {
    const auto side = static_cast<double>(std::int64_t{1} << level);
    const double low_x = static_cast<double>(i) * side, low_y = static_cast<double>(j) * side;
    const double out_x = ray.Leaves(low_x, low_x + side, ray.x, ray.dx);
    const double out_y = ray.Leaves(low_y, low_y + side, ray.y, ray.dy);
    const double out = std::max(s, std::min(out_x, out_y));
    const double lowest = ray.h + ray.dh * (ray.dh < 0 ? out : s);
    if (lowest <= static_cast<double>(Highest(level, i, j))) {
      if (level > 0) {
        --level;
        const auto child = [&](std::int64_t parent, double at) {
          return std::clamp(block(at), 2 * parent, 2 * parent + 1);
        };
        i = child(i, ray.x + s * ray.dx);
        j = child(j, ray.y + s * ray.dy);
        continue;
      }
      // Two planes, one on each side of the diagonal; on each the ray's height over it is linear.
      const Corners c = CornersOf(i, j);
      const double a0 = ray.x - static_cast<double>(i), b0 = ray.y - static_cast<double>(j);
      const double turn = ray.dx != ray.dy ? (b0 - a0) / (ray.dx - ray.dy) : kInfinity;
      const bool turns = turn > s && turn < out;
      const double middle = 0.5 * (s + (turns ? turn : std::min(out, s + 1)));
      bool north_half = a0 + middle * ray.dx >= b0 + middle * ray.dy;
      double from = s;
      for (const double to : {turns ? turn : out, out}) {
        const double rise_x = north_half ? c.nw - c.sw : c.ne - c.se;
        const double rise_y = north_half ? c.ne - c.nw : c.se - c.sw;
        const double over = ray.h - (c.sw + rise_x * a0 + rise_y * b0);
        const double per_s = ray.dh - rise_x * ray.dx - rise_y * ray.dy;
        const double at_from = over + per_s * from;
        if (at_from < -1e-6 && from == 0) {
          return kInfinity;  // it starts below the ground
        }
        if (over + per_s * to <= 0) {
          return per_s < 0 ? std::clamp(-over / per_s, from, to) : from;
        }
        if (!turns) {
          break;
        }
        from = to;
        north_half = !north_half;
      }
    }
    if (ray.dh >= 0 && ray.h + ray.dh * out > highest_m()) {
      return kInfinity;
    }
    if (!std::isfinite(out)) {
      return kInfinity;
    }
    s = out;
    const bool along_x = out_x <= out_y;
    std::int64_t& index = along_x ? i : j;
    const std::int64_t before = index;
    index += (along_x ? ray.dx : ray.dy) > 0 ? 1 : -1;
    if (level < top && (before >> 1) != (index >> 1)) {
      ++level;
      i >>= 1;
      j >>= 1;
    }
  }
  return kInfinity;
}

}  // namespace palace
