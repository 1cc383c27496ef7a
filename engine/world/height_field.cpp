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
};

/// One axis of a ray: where it leaves a block of so many cells a side, where it entered a cell.
struct Axis {
  Axis(double from, double per) : at(from), per_s(per), ahead(per > 0 ? 1 : 0) {}
  double Leaves(std::int64_t block, double side) const {
    return std::abs(per_s) > 0 ? (static_cast<double>(block + ahead) * side - at) / per_s
                               : kInfinity;
  }
  double Enters(std::int64_t cell) const {
    return std::abs(per_s) > 0 ? (static_cast<double>(cell + 1 - ahead) - at) / per_s : 0;
  }
  double at, per_s;
  std::int64_t ahead;  ///< 1: it leaves by the block's far side
};

/// Of an endless row of blocks that goes on mirrored, `side` of them, a power of two.
std::int64_t Folded(std::int64_t index, std::int64_t side) {
  const std::int64_t within = index & (2 * side - 1);
  return within < side ? within : 2 * side - 1 - within;
}

/// The same of corners: the last block's far one is shared with its mirror image.
std::int64_t Mirrored(std::int64_t index, std::int64_t side) {
  const std::int64_t within = index & (2 * side - 1);
  return within <= side ? within : 2 * side - within;
}

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

HeightField::Corners HeightField::CornersOf(std::int64_t i, std::int64_t j) const {
  const auto row = static_cast<std::int64_t>(cells_) + 1;
  std::int64_t south = i, north = i + 1, west = j, east = j + 1;
  if (i < 0 || j < 0 || i >= cells_ || j >= cells_) {
    south = Mirrored(i, cells_), north = Mirrored(i + 1, cells_);
    west = Mirrored(j, cells_), east = Mirrored(j + 1, cells_);
  }
  const auto at = [&](std::int64_t k, std::int64_t l) {
    return static_cast<double>(corners_[static_cast<std::size_t>(k * row + l)]);
  };
  return {at(south, west), at(north, west), at(south, east), at(north, east)};
}

float HeightField::Highest(int level, std::int64_t i, std::int64_t j) const {
  const std::int64_t blocks = cells_ >> level;
  return levels_[static_cast<std::size_t>(level)]
                [static_cast<std::size_t>(Folded(i, blocks) * blocks + Folded(j, blocks))];
}

double HeightField::HighestIn(const Eigen::AlignedBox2d& cells) const {
  constexpr double kBlocks = 3;  // a side, at most one more
  const double size = cells.sizes().maxCoeff();
  const int top = static_cast<int>(levels_.size()) - 1;
  int level = 0;
  double per_cell = 1;
  for (; level < top && size * per_cell > kBlocks; ++level) {
    per_cell /= 2;
  }
  if (level == top) {
    return highest_m();
  }
  const auto block = [&](double at) { return static_cast<std::int64_t>(FastFloor(at * per_cell)); };
  float highest = -std::numeric_limits<float>::infinity();
  for (std::int64_t i = block(cells.min().x()); i <= block(cells.max().x()); ++i) {
    for (std::int64_t j = block(cells.min().y()); j <= block(cells.max().y()); ++j) {
      highest = std::max(highest, Highest(level, i, j));
    }
  }
  return static_cast<double>(highest);
}

double HeightField::Height(double north_m, double east_m) const {
  const double x = (north_m - place_.north_m) / cell_m_, y = (east_m - place_.east_m) / cell_m_;
  const double i = FastFloor(x), j = FastFloor(y);
  const Corners c = CornersOf(static_cast<std::int64_t>(i), static_cast<std::int64_t>(j));
  const double a = x - i, b = y - j;
  return a >= b ? c.sw + (c.nw - c.sw) * a + (c.ne - c.nw) * b
                : c.sw + (c.ne - c.se) * a + (c.se - c.sw) * b;
}

HeightField::Triangle HeightField::TriangleAt(double north_m, double east_m) const {
  const double x = (north_m - place_.north_m) / cell_m_, y = (east_m - place_.east_m) / cell_m_;
  const double i = FastFloor(x), j = FastFloor(y);
  return {static_cast<std::int64_t>(i), static_cast<std::int64_t>(j), x - i >= y - j};
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

double HeightField::ClearUpTo(const Beam& beam_W) const {
  constexpr double kOver_m = 1e-6;  // far more than rounding
  constexpr int kSteps = 14;
  constexpr double kFine = 0.25;  // cells: where steps are too short to be worth another
  const auto in_cells = [&](double s, Eigen::AlignedBox2d& box) {
    for (const Vector3d& edge : beam_W.edges()) {
      const Vector3d at = beam_W.p() + s * edge;
      box.extend(
          Eigen::Vector2d((at.x() - place_.north_m) / cell_m_, (at.y() - place_.east_m) / cell_m_));
    }
  };
  double steepest = 0, flattest = kInfinity;  // metres down a unit of s
  for (const Vector3d& edge : beam_W.edges()) {
    steepest = std::max(steepest, edge.z());
    flattest = std::min(flattest, edge.z());
  }
  const double over_m = -beam_W.p().z() - highest_m() - kOver_m;
  if (!(flattest > 0) || over_m < 0) {
    return 0;
  }
  double clear = over_m / steepest;
  double step = (highest_m() - lowest_m_) / steepest;
  for (int k = 0; k < kSteps; ++k) {
    Eigen::AlignedBox2d box;
    in_cells(clear, box);
    const double across = box.sizes().maxCoeff();
    in_cells(clear + step, box);
    const double lowest_clear = (-beam_W.p().z() - HighestIn(box) - kOver_m) / steepest;
    if (lowest_clear >= clear + step) {
      clear += step;
      continue;
    }
    clear = std::max(clear, lowest_clear);
    if (box.sizes().maxCoeff() < across + kFine) {
      break;
    }
    step /= 2;
  }
  return clear;
}

double HeightField::Cast(const Vector3d& p_W, const Vector3d& r_W, double clear) const {
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
  const bool shortened = clear > s;
  const int top = static_cast<int>(levels_.size()) - 1;
  const Axis along_north(ray.x, ray.dx), along_east(ray.y, ray.dy);
  int level = shortened ? 0 : std::min(top, 3);
  double side = std::int64_t{1} << level, per_cell = 1 / side;  // a power of two: both are exact
  const auto block = [&](double at) { return static_cast<std::int64_t>(FastFloor(at * per_cell)); };
  const double start = shortened ? clear : s;
  std::int64_t i = block(ray.x + start * ray.dx), j = block(ray.y + start * ray.dy);
  // Through a corner of cells rounding decides the way: it is to decide as it does from afar.
  const auto at_corner = [](double x, double y) { return std::abs(x - y) <= 1e-9 * std::abs(x); };
  if (shortened) {
    const double in_x = along_north.Enters(i), in_y = along_east.Enters(j);
    if (at_corner(in_x, in_y)) {
      return Cast(p_W, r_W, 0);
    }
    s = std::max({s, in_x, in_y});
  }
  // A ray nearly along the ground may cross very many cells: it is given up far outside of any
  // picture.
  for (int steps = 0; steps < 200'000; ++steps) {
    const double out_x = along_north.Leaves(i, side), out_y = along_east.Leaves(j, side);
    if (shortened && at_corner(out_x, out_y)) {
      return Cast(p_W, r_W, 0);
    }
    const double out = std::max(s, std::min(out_x, out_y));
    const double lowest = ray.h + ray.dh * (ray.dh < 0 ? out : s);
    if (lowest <= static_cast<double>(Highest(level, i, j))) {
      if (level > 0) {
        --level;
        side /= 2, per_cell *= 2;
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
      side *= 2, per_cell /= 2;
      i >>= 1;
      j >>= 1;
    }
  }
  return kInfinity;
}

}  // namespace palace
