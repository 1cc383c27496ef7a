#include "engine/slad/plane_fit.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "tests/slad/worlds.h"

namespace palace {
namespace {

using testing::Flat;
using testing::MakeMap;
using testing::Slope;
using testing::WithBox;

/// Plain LMedS + least squares with every triple and sorted residuals, in double.
std::optional<Eigen::Vector3d> SlowFit(const GridF& z, int r, int c, int stride) {
  std::vector<Eigen::Vector4d> points;  // 1, x, y, z
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const int rr = r + dy * stride, cc = c + dx * stride;
      if (rr >= 0 && cc >= 0 && rr < z.rows() && cc < z.cols() && !std::isnan(z.at(rr, cc))) {
        points.push_back({1, double(dx), double(dy), double(z.at(rr, cc))});
      }
    }
  }
  std::optional<Eigen::Vector3d> best;
  double best_median = HUGE_VAL;
  const std::size_t n = points.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      for (std::size_t k = j + 1; k < n; ++k) {
        Eigen::Matrix3d a;
        a << points[i].head<3>().transpose(), points[j].head<3>().transpose(),
            points[k].head<3>().transpose();
        if (std::abs(a.determinant()) < 0.5) {
          continue;
        }
        const Eigen::Vector3d plane =
            a.inverse() * Eigen::Vector3d(points[i][3], points[j][3], points[k][3]);
        std::vector<double> residuals;
        for (const auto& p : points) {
          residuals.push_back(std::abs(p[3] - p.head<3>().dot(plane)));
        }
        std::sort(residuals.begin(), residuals.end());
        if (residuals[n / 2] < best_median - 1e-12) {
          best_median = residuals[n / 2];
          best = plane;
        }
      }
    }
  }
  if (!best) {
    return best;
  }
  const double threshold =
      std::max(1e-3, 2.5 * 1.4826 * (1 + 5.0 / std::max(1.0, double(n) - 3)) * best_median);
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const auto& p : points) {
    if (std::abs(p[3] - p.head<3>().dot(*best)) < threshold) {
      normal += p.head<3>() * p.head<3>().transpose();
      right += p[3] * p.head<3>();
    }
  }
  return Eigen::Vector3d(normal.ldlt().solve(right));
}

void CompareWithSlowFit(const GridF& z, int stride) {
  const PlaneMaps fast = FitThesisPlanes(z, 0.2, stride);
  int known = 0, different = 0;
  for (int r = 0; r < z.rows(); ++r) {
    for (int c = 0; c < z.cols(); ++c) {
      const auto slow = SlowFit(z, r, c, stride);
      ASSERT_EQ(std::isnan(fast.height_m.at(r, c)), !slow.has_value()) << r << ' ' << c;
      if (!slow) {
        continue;
      }
      ++known;
      const double spacing = 0.2 * stride;
      const bool same =
          std::abs(double(fast.height_m.at(r, c)) - slow->x()) < 2e-6 &&
          std::abs(double(fast.east_gradient.at(r, c)) * spacing - slow->y()) < 2e-6 &&
          std::abs(-double(fast.north_gradient.at(r, c)) * spacing - slow->z()) < 2e-6;
      different += same ? 0 : 1;
    }
  }
  ASSERT_GT(known, 0);
  // Two triples may tie to the last digit of a float; their planes are then equally good.
  EXPECT_LE(different, known / 500);
}

TEST(ThesisPlanes, EqualTheSlowReference) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random(seed, "lmeds");
    GridF z(24, 27);
    for (float& height : z.cells()) {
      height = static_cast<float>(0.05 * random.Normal() + (random.Uniform() < 0.15 ? 0.7 : 0.0));
    }
    CompareWithSlowFit(z, 1);
    CompareWithSlowFit(z, 2);
    for (float& height : z.cells()) {
      if (random.Uniform() < 0.1) {
        height = kUnknownValue;
      }
    }
    CompareWithSlowFit(z, 1);
  }
}

TEST(ThesisPlanes, TwoRaisedCellsOfNineDoNotTiltThePlane) {
  GridF z(3, 3, 0.0F);
  z.at(0, 0) = z.at(1, 2) = 0.15F;
  const PlaneMaps planes = FitThesisPlanes(z, 0.18, 1);
  EXPECT_NEAR(double(planes.height_m.at(1, 1)), 0, 1e-6);
  EXPECT_NEAR(double(planes.north_gradient.at(1, 1)), 0, 1e-6);
}

TEST(FootprintPlanes, TableDoesNotTiltTheGroundBesideIt) {
  const ElevationMap map = MakeMap(80, 80, 0.15, WithBox(Slope(Rad(4), Rad(30)), 0, 0, 1.2, 0.75));
  const FootprintPlanes planes = FitFootprintPlanes(map, 3.6);
  for (int r = 0; r < 80; ++r) {
    for (int c = 0; c < 80; ++c) {
      const double tangent = std::hypot(double(planes.plane.north_gradient.at(r, c)),
                                        double(planes.plane.east_gradient.at(r, c)));
      ASSERT_NEAR(Deg(std::atan(tangent)), 4, 0.05) << r << ' ' << c;
    }
  }
}

TEST(FootprintPlanes, SigmaCoversTheScatterOfTheSlope) {
  double squares = 0, predicted = 0;
  constexpr int kWorlds = 60;
  for (std::uint64_t seed = 1; seed <= kWorlds; ++seed) {
    const ElevationMap map = MakeMap(31, 31, 0.15, Slope(Rad(5), 0), 0.05, seed);
    const FootprintPlanes planes = FitFootprintPlanes(map, 3.6);
    squares += std::pow(double(planes.plane.north_gradient.at(15, 15)) - std::tan(Rad(5)), 2);
    predicted += std::pow(double(planes.gradient_sigma.at(15, 15)), 2);
  }
  // Cells are independent here; the prediction allows for groups of four that share their noise.
  EXPECT_GT(predicted / squares, 2.0);
  EXPECT_LT(predicted / squares, 8.0);
}

}  // namespace
}  // namespace palace
