// Exact LMedS over 3x3 samples, then least squares on the inliers (thesis 4.3.2, erratum E24).
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Dense>

#include "engine/slad/lmeds_tables.h"
#include "engine/slad/plane_fit.h"

namespace palace {
namespace {

/// Rousseeuw's finite-sample robust scale of n points and three parameters, times 2.5.
double InlierFactor(int n) { return 2.5 * 1.4826 * (1.0 + 5.0 / std::max(1, n - 3)); }
/// Rounding must not reject points of an exact plane.
constexpr double kLeastThreshold_m = 1e-3;

constexpr int kLanes = 4;
using Lanes = Eigen::Array<float, kLanes, 1>;

/// A plane z = height + east * x + south * y in cells of the window.
struct WindowPlane {
  double height = 0, east = 0, south = 0;
};

const lmeds::Tables& SharedTables() {
  static const lmeds::Tables tables = lmeds::MakeTables();
  return tables;
}

/// Fits four neighbouring windows at once, one a lane. Costs are the same whatever the heights.
class FourFits {
 public:
  /// z: the nine samples of the four windows, relative to each window's middle.
  void Run(const std::array<Lanes, 9>& z) {
    FindDeterminants(z);
    FindBestTriple();
    LeastSquares(z);
  }
  Lanes height, east, south;  ///< results, per cell

 private:
  void FindDeterminants(const std::array<Lanes, 9>& z) {
    for (std::size_t q = 0; q < lmeds::kQuadruples; ++q) {
      const lmeds::Quadruple& quad = tables_.quadruples[q];
      const auto term = [&](std::size_t n) {
        return quad.weight[n] * z[static_cast<std::size_t>(quad.point[n])];
      };
      determinant_[q] = ((term(0) + term(1)) + (term(2) + term(3))).abs();
    }
  }

  void FindBestTriple() {
    best_ = Lanes::Constant(HUGE_VALF);
    for (std::size_t t = 0; t < lmeds::kTriples; ++t) {
      const auto d = [&](std::size_t n) -> const Lanes& {
        return determinant_[static_cast<std::size_t>(tables_.triples[t].quadruple[n])];
      };
      // Smallest and second smallest, merged pair by pair.
      const Lanes a = d(0).min(d(1)), b = d(0).max(d(1));
      const Lanes low1 = d(2).min(d(3)), high1 = d(2).max(d(3));
      const Lanes a1 = a.min(low1), b1 = a.max(low1).min(b.min(high1));
      const Lanes low2 = d(4).min(d(5)), high2 = d(4).max(d(5));
      median_[t] = a1.max(low2).min(b1.min(high2)) * tables_.triples[t].inverse_area;
      best_ = best_.min(median_[t]);
    }
  }

  WindowPlane PlaneOfBest(const std::array<Lanes, 9>& z, int lane) const {
    std::size_t t = 0;
    while (median_[t][lane] != best_[lane]) {
      ++t;
    }
    const auto& p = tables_.triples[t].point;
    const double z0 = static_cast<double>(z[static_cast<std::size_t>(p[0])][lane]);
    const double z1 = static_cast<double>(z[static_cast<std::size_t>(p[1])][lane]) - z0;
    const double z2 = static_cast<double>(z[static_cast<std::size_t>(p[2])][lane]) - z0;
    const int x1 = lmeds::X(p[1]) - lmeds::X(p[0]), y1 = lmeds::Y(p[1]) - lmeds::Y(p[0]);
    const int x2 = lmeds::X(p[2]) - lmeds::X(p[0]), y2 = lmeds::Y(p[2]) - lmeds::Y(p[0]);
    const double area = x1 * y2 - x2 * y1;
    WindowPlane plane;
    plane.east = (z1 * y2 - z2 * y1) / area;
    plane.south = (x1 * z2 - x2 * z1) / area;
    plane.height = z0 - plane.east * lmeds::X(p[0]) - plane.south * lmeds::Y(p[0]);
    return plane;
  }

  void LeastSquares(const std::array<Lanes, 9>& z) {
    Lanes height0, east0, south0;
    for (int lane = 0; lane < kLanes; ++lane) {
      const WindowPlane plane = PlaneOfBest(z, lane);
      height0[lane] = static_cast<float>(plane.height);
      east0[lane] = static_cast<float>(plane.east);
      south0[lane] = static_cast<float>(plane.south);
    }
    const Lanes threshold =
        (best_ * static_cast<float>(InlierFactor(9))).max(static_cast<float>(kLeastThreshold_m));
    Lanes w[9], wz[9];
    for (int i = 0; i < 9; ++i) {
      const Lanes& zi = z[static_cast<std::size_t>(i)];
      const Lanes r = zi - height0 - east0 * static_cast<float>(lmeds::X(i)) -
                      south0 * static_cast<float>(lmeds::Y(i));
      // 1 inside the threshold, 0 outside, without a branch.
      w[i] = ((threshold - r.abs()) * 1e30F).max(0.0F).min(1.0F);
      wz[i] = w[i] * zi;
    }
    Solve(w, wz);
  }

  void Solve(const Lanes (&w)[9], const Lanes (&wz)[9]) {
    const Lanes west = w[0] + w[3] + w[6], right = w[2] + w[5] + w[8];
    const Lanes north = w[0] + w[1] + w[2], bottom = w[6] + w[7] + w[8];
    const Lanes n = north + bottom + w[3] + w[4] + w[5];
    const Lanes sx = right - west, sxx = right + west;
    const Lanes sy = bottom - north, syy = bottom + north;
    const Lanes sxy = (w[0] + w[8]) - (w[2] + w[6]);
    const Lanes sz =
        ((wz[0] + wz[1]) + (wz[2] + wz[3])) + ((wz[4] + wz[5]) + (wz[6] + wz[7])) + wz[8];
    const Lanes sxz = (wz[2] + wz[5] + wz[8]) - (wz[0] + wz[3] + wz[6]);
    const Lanes syz = (wz[6] + wz[7] + wz[8]) - (wz[0] + wz[1] + wz[2]);
    // Normal equations times n; the determinant is a whole number, at least 1, as the best triple
    // itself lies inside the threshold.
    const Lanes cxx = n * sxx - sx * sx, cyy = n * syy - sy * sy, cxy = n * sxy - sx * sy;
    const Lanes cxz = n * sxz - sx * sz, cyz = n * syz - sy * sz;
    const Lanes determinant = cxx * cyy - cxy * cxy;
    east = (cxz * cyy - cyz * cxy) / determinant;
    south = (cyz * cxx - cxz * cxy) / determinant;
    height = (sz - east * sx - south * sy) / n;
  }

  const lmeds::Tables& tables_ = SharedTables();
  std::array<Lanes, lmeds::kQuadruples> determinant_;
  std::array<Lanes, lmeds::kTriples> median_;
  Lanes best_;
};

struct Sample {
  int x = 0, y = 0;
  double z = 0;
};

std::optional<WindowPlane> PlaneThrough(const Sample& a, const Sample& b, const Sample& c) {
  const int x1 = b.x - a.x, y1 = b.y - a.y, x2 = c.x - a.x, y2 = c.y - a.y;
  const int area = x1 * y2 - x2 * y1;
  if (area == 0) {
    return std::nullopt;
  }
  const double z1 = b.z - a.z, z2 = c.z - a.z;
  WindowPlane plane;
  plane.east = (z1 * y2 - z2 * y1) / area;
  plane.south = (x1 * z2 - x2 * z1) / area;
  plane.height = a.z - plane.east * a.x - plane.south * a.y;
  return plane;
}

double Residual(const WindowPlane& plane, const Sample& s) {
  return std::abs(s.z - plane.height - plane.east * s.x - plane.south * s.y);
}

/// The same fit for windows with unknown samples, at rims and holes: any 3 to 9 samples.
std::optional<WindowPlane> FitSamples(const std::vector<Sample>& samples) {
  std::optional<WindowPlane> best;
  double best_median = HUGE_VAL;
  const std::size_t n = samples.size();
  std::array<double, 9> residuals;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      for (std::size_t k = j + 1; k < n; ++k) {
        const auto plane = PlaneThrough(samples[i], samples[j], samples[k]);
        if (!plane) {
          continue;
        }
        for (std::size_t m = 0; m < n; ++m) {
          residuals[m] = Residual(*plane, samples[m]);
        }
        const auto middle = residuals.begin() + static_cast<std::ptrdiff_t>(n / 2);
        std::nth_element(residuals.begin(), middle,
                         residuals.begin() + static_cast<std::ptrdiff_t>(n));
        if (*middle < best_median) {
          best_median = *middle;
          best = plane;
        }
      }
    }
  }
  if (!best) {
    return std::nullopt;
  }
  const double threshold =
      std::max(InlierFactor(static_cast<int>(n)) * best_median, kLeastThreshold_m);
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const Sample& s : samples) {
    if (Residual(*best, s) < threshold) {
      const Eigen::Vector3d basis(1, s.x, s.y);
      normal += basis * basis.transpose();
      right += basis * s.z;
    }
  }
  const Eigen::Vector3d solution = normal.inverse() * right;
  return WindowPlane{solution.x(), solution.y(), solution.z()};
}

/// Writes one cell's plane; gradients from cells of the window to metres per metre.
struct PlaneWriter {
  PlaneMaps maps;
  double spacing_m;

  void Set(int r, int c, float height_m, float east, float south) {
    maps.height_m.at(r, c) = height_m;
    maps.east_gradient.at(r, c) = static_cast<float>(static_cast<double>(east) / spacing_m);
    maps.north_gradient.at(r, c) = static_cast<float>(-static_cast<double>(south) / spacing_m);
  }
};

void FitOneCell(const GridF& height_m, int r, int c, int stride, PlaneWriter& out) {
  std::vector<Sample> samples;
  samples.reserve(lmeds::kPoints);
  for (int i = 0; i < lmeds::kPoints; ++i) {
    const int rr = r + lmeds::Y(i) * stride, cc = c + lmeds::X(i) * stride;
    if (rr >= 0 && cc >= 0 && rr < height_m.rows() && cc < height_m.cols() &&
        !std::isnan(height_m.at(rr, cc))) {
      samples.push_back({lmeds::X(i), lmeds::Y(i), static_cast<double>(height_m.at(rr, cc))});
    }
  }
  if (const auto plane = FitSamples(samples)) {
    out.Set(r, c, static_cast<float>(plane->height), static_cast<float>(plane->east),
            static_cast<float>(plane->south));
  }
}

}  // namespace

PlaneMaps FitThesisPlanes(const GridF& height_m, double cell_m, int stride) {
  PALACE_CHECK(cell_m > 0 && stride >= 1, cell_m, stride);
  const int rows = height_m.rows(), cols = height_m.cols();
  const GridF unknown(rows, cols, kUnknownValue);
  PlaneWriter out{{unknown, unknown, unknown}, cell_m * stride};
  FourFits fits;
  std::array<Lanes, 9> z;
  for (int r = 0; r < rows; ++r) {
    const bool inner_row = r >= stride && r + stride < rows;
    int c = 0;
    while (c < cols) {
      bool complete = inner_row && c >= stride && c + kLanes + stride <= cols;
      if (complete) {
        const Eigen::Map<const Lanes> middle(height_m.row(r) + c);
        Lanes sum = Lanes::Zero();
        for (int i = 0; i < lmeds::kPoints; ++i) {
          const Eigen::Map<const Lanes> raw(height_m.row(r + lmeds::Y(i) * stride) + c +
                                            lmeds::X(i) * stride);
          z[static_cast<std::size_t>(i)] = raw - middle;
          sum += z[static_cast<std::size_t>(i)];
        }
        complete = !std::isnan(sum.sum());
      }
      if (!complete) {
        FitOneCell(height_m, r, c, stride, out);
        ++c;
        continue;
      }
      fits.Run(z);
      for (int lane = 0; lane < kLanes; ++lane) {
        out.Set(r, c + lane, height_m.at(r, c + lane) + fits.height[lane], fits.east[lane],
                fits.south[lane]);
      }
      c += kLanes;
    }
  }
  return std::move(out.maps);
}

}  // namespace palace
