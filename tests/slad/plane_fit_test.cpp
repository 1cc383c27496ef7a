#include "engine/slad/hazards/plane_fit.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "tests/slad/footprint_reference.h"
#include "tests/slad/worlds.h"

namespace palace {
namespace {

using testing::Flat;
using testing::MakeMap;
using testing::PlainFootprintPlanes;
using testing::RandomGround;
using testing::Slope;
using testing::WithBox;

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

/// Of equal bits but for what kind of NaN it is; -1, or the first cell that differs.
std::ptrdiff_t FirstThatDiffers(const GridF& a, const GridF& b) {
  const auto same = [](float x, float y) {
    return std::bit_cast<std::uint32_t>(x) == std::bit_cast<std::uint32_t>(y) ||
           (std::isnan(x) && std::isnan(y));
  };
  const auto at =
      std::mismatch(a.cells().begin(), a.cells().end(), b.cells().begin(), b.cells().end(), same);
  return at.first == a.cells().end() ? -1 : at.first - a.cells().begin();
}

/// Holes of all sizes, filled cells, cells without height or noise, and raised surfaces.
struct Field {
  ElevationMap map;
  Grid<std::uint8_t> flags;
};
Field SpoiltField(std::uint64_t seed) {
  RandomStream random(seed, "spoilt field");
  const int rows = 1 + random.Index(90), cols = 1 + random.Index(300);
  Field field{RandomGround(rows, cols, 0.15, seed), {}};
  field.flags = Grid<std::uint8_t>(seed % 3 == 0 ? 0 : rows, seed % 3 == 0 ? 0 : cols, 0);
  const Cell hole{random.Index(rows), random.Index(cols)};
  const int hole_cells = random.Index(40);
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < cols; ++c) {
      const bool in_hole =
          std::abs(r - hole.row) < hole_cells && std::abs(c - hole.col) < hole_cells;
      if (in_hole || random.Uniform() < 0.01) {
        field.map.state.at(r, c) =
            random.Uniform() < 0.2 ? CellState::kFilled : CellState::kUnknown;
        field.map.height_m.at(r, c) = kUnknownValue;
      } else if (seed % 5 == 0 && random.Uniform() < 1e-3) {
        field.map.height_m.at(r, c) = kUnknownValue;  // though it is called measured
      } else if (seed % 7 == 0 && random.Uniform() < 1e-3) {
        field.map.variance_m2.at(r, c) = kUnknownValue;
      }
      if (!field.flags.empty() && random.Uniform() < 0.004) {
        for (int k = 0; k < 9; ++k) {
          const Cell near{r + k / 3, c + k % 3};
          if (field.map.geometry.Contains(near)) {
            field.flags.at(near) = kFlagElevated;
            field.map.height_m.at(near) += 0.5F;
          }
        }
      }
    }
  }
  return field;
}

TEST(FootprintPlanes, AreThePlainOnesToTheBit) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    const Field field = SpoiltField(seed);
    // Windows of all widths, the last ones wider than most of these maps.
    const double diameter_m = 0.3 * double(1 + seed % 20) * (seed % 10 == 0 ? 6 : 1);
    const FootprintPlanes fast = FitFootprintPlanes(field.map, diameter_m, field.flags);
    const FootprintPlanes plain = PlainFootprintPlanes(field.map, diameter_m, field.flags);
    EXPECT_EQ(FirstThatDiffers(fast.plane.height_m, plain.plane.height_m), -1);
    EXPECT_EQ(FirstThatDiffers(fast.plane.residual_m, plain.plane.residual_m), -1);
    EXPECT_EQ(FirstThatDiffers(fast.plane.north_gradient, plain.plane.north_gradient), -1);
    EXPECT_EQ(FirstThatDiffers(fast.plane.east_gradient, plain.plane.east_gradient), -1);
    EXPECT_EQ(FirstThatDiffers(fast.gradient_sigma, plain.gradient_sigma), -1);
    EXPECT_EQ(FirstThatDiffers(fast.cell_variance_m2, plain.cell_variance_m2), -1);
  }
}

TEST(FootprintPlanes, GroundWithoutOutliersIsSolvedOnceAndStays) {
  // No cell stands off its plane: later passes find every weight as it was.
  const ElevationMap map = MakeMap(70, 150, 0.15, Slope(Rad(3), 1), 0.004, 5);
  const FootprintPlanes fast = FitFootprintPlanes(map, 3.6);
  const FootprintPlanes plain = PlainFootprintPlanes(map, 3.6, {});
  EXPECT_EQ(FirstThatDiffers(fast.plane.height_m, plain.plane.height_m), -1);
  EXPECT_EQ(FirstThatDiffers(fast.gradient_sigma, plain.gradient_sigma), -1);
}

}  // namespace
}  // namespace palace
