#include "engine/slad/hazards/plane_fit.h"

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
