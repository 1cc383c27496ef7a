// The gear on the ground: closed forms, and the fast loops against a gear put down by brute force.
#include "engine/slad/hazards/touchdown.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "engine/core/units.h"
#include "engine/slad/slad.h"
#include "tests/slad/worlds.h"

namespace palace {
namespace {

using testing::Flat;
using testing::Height;
using testing::MakeMap;
using testing::Slope;
using testing::WithBox;

constexpr double kCell_m = 0.15;

Lander Gear(LandingGear gear) {
  Lander lander;
  lander.gear = gear;
  return lander;
}

GridF Heights(const Height& height, int side = 21) {
  return MakeMap(side, side, kCell_m, height).height_m;
}

/// What a gear does that is put down on bilinear ground, by trying pitches.
struct BruteForce {
  double tilt_rad = 0, rise_m = -HUGE_VAL;
  bool tie = false;  ///< balanced between two pitches of like size
};
class BruteGear {
 public:
  BruteGear(const GridF& height_m, const Lander& lander, Cell middle)
      : height_m_(height_m), lander_(lander), middle_(middle) {}

  BruteForce At(double heading_rad) const {
    BruteForce worst;
    if (lander_.gear == LandingGear::kSkids) {
      AddSkids(heading_rad, worst);
    } else {
      AddPads(heading_rad, worst);
    }
    return worst;
  }

 private:
  /// x forward, y to the right, metres.
  double Ground(double heading_rad, double x, double y) const {
    const double north = x * std::cos(heading_rad) - y * std::sin(heading_rad);
    const double east = x * std::sin(heading_rad) + y * std::cos(heading_rad);
    const double row = middle_.row - north / kCell_m, col = middle_.col + east / kCell_m;
    const int r = int(std::floor(row + 1e-9)), c = int(std::floor(col + 1e-9));
    const double v = row - r, u = col - c;
    const auto z = [&](int dr, int dc) { return double(height_m_.at(r + dr, c + dc)); };
    return (1 - v) * ((1 - u) * z(0, 0) + u * z(0, 1)) + v * ((1 - u) * z(1, 0) + u * z(1, 1));
  }

  void AddPlane(double heading_rad, double pitch, double roll, double middle_m,
                BruteForce& worst) const {
    const double north = pitch * std::cos(heading_rad) - roll * std::sin(heading_rad);
    const double east = pitch * std::sin(heading_rad) + roll * std::cos(heading_rad);
    const Eigen::Vector3d normal = Eigen::Vector3d(-north, -east, -1).normalized();
    worst.tilt_rad = std::max(worst.tilt_rad, std::acos(std::min(1.0, normal.dot(lander_.up_W()))));
    for (int r = 0; r < height_m_.rows(); ++r) {
      for (int c = 0; c < height_m_.cols(); ++c) {
        const double n = (middle_.row - r) * kCell_m, e = (c - middle_.col) * kCell_m;
        const double x = n * std::cos(heading_rad) + e * std::sin(heading_rad);
        const double y = e * std::cos(heading_rad) - n * std::sin(heading_rad);
        if (std::abs(x) <= lander_.gear_length_m / 2 && std::abs(y) <= lander_.gear_width_m / 2) {
          worst.rise_m =
              std::max(worst.rise_m, double(height_m_.at(r, c)) - middle_m - n * north - e * east);
        }
      }
    }
  }

  double Support(double heading_rad, double side, double pitch) const {
    double most = -HUGE_VAL;
    for (int k = 0; k <= 8; ++k) {
      const double x = lander_.gear_length_m * (k / 8.0 - 0.5);
      most = std::max(most, Ground(heading_rad, x, side * lander_.gear_width_m / 2) - pitch * x);
    }
    return most;
  }

  /// The least mean support over a fine comb of pitches; where several are as low, both ends.
  void AddSkids(double heading_rad, BruteForce& worst) const {
    double least = HUGE_VAL, first = 0, last = 0;
    for (double pitch = -1.5; pitch <= 1.5; pitch += 1e-3) {
      const double mean = (Support(heading_rad, -1, pitch) + Support(heading_rad, 1, pitch)) / 2;
      if (mean < least - 1e-7) {
        first = pitch;
      }
      if (mean < least + 1e-7) {
        last = pitch;
        least = std::min(least, mean);
      }
    }
    const double pitch = std::abs(first) > std::abs(last) ? first : last;
    worst.tie = last - first > 5e-3 && std::abs(std::abs(first) - std::abs(last)) < 5e-3;
    const double left = Support(heading_rad, -1, pitch), right = Support(heading_rad, 1, pitch);
    AddPlane(heading_rad, pitch, (right - left) / lander_.gear_width_m, (left + right) / 2, worst);
  }

  /// Every three pads; no plane to rest on leaves the fourth below the ground.
  void AddPads(double heading_rad, BruteForce& worst) const {
    const double x = lander_.gear_length_m / 2, y = lander_.gear_width_m / 2;
    const Eigen::Vector2d corner[] = {{x, y}, {x, -y}, {-x, -y}, {-x, y}};
    for (int out = 0; out < 4; ++out) {
      Eigen::Matrix3d at;
      Eigen::Vector3d z;
      int used = 0;
      for (int k = 0; k < 4; ++k) {
        if (k != out) {
          at.row(used) = Eigen::RowVector3d(1, corner[k].x(), corner[k].y());
          z[used++] = Ground(heading_rad, corner[k].x(), corner[k].y());
        }
      }
      const Eigen::Vector3d plane = at.fullPivLu().solve(z);
      const double under = plane.dot(Eigen::Vector3d(1, corner[out].x(), corner[out].y()));
      if (Ground(heading_rad, corner[out].x(), corner[out].y()) <= under + 1e-9) {
        AddPlane(heading_rad, plane[1], plane[2], plane[0], worst);
      }
    }
  }

  const GridF& height_m_;
  Lander lander_;
  Cell middle_;
};

GridF RandomHeights(std::uint64_t seed, double low_m, double high_m) {
  RandomStream random(seed, "gear ground");
  GridF height(21, 21, 0.0F);
  const double north = random.Uniform(-0.2, 0.2), east = random.Uniform(-0.2, 0.2);
  for (int r = 0; r < 21; ++r) {
    for (int c = 0; c < 21; ++c) {
      height.at(r, c) = float(random.Uniform(low_m, high_m) + kCell_m * (north * r + east * c));
    }
  }
  return height;
}

TEST(Touchdown, RestsAsTheBruteForceGearDoes) {
  for (const LandingGear kind : {LandingGear::kSkids, LandingGear::kPads}) {
    const Lander lander = Gear(kind);
    int ties = 0;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
      const GridF height = RandomHeights(seed, 0, 0.3);
      const GearOverMap gear(height, kCell_m, lander);
      const Cell middle{10, 10};
      for (int h = 0; h < gear.headings(); h += 3) {
        const GearRest rest = gear.At(middle, h);
        const BruteForce slow = BruteGear(height, lander, middle).At(gear.heading_rad(h));
        if (slow.tie) {
          ++ties;  // the comb cannot tell which end is steeper
          continue;
        }
        // The comb of pitches is 1e-3 wide; the roll follows the pitch.
        ASSERT_NEAR(double(rest.tilt_rad), slow.tilt_rad, kind == LandingGear::kSkids ? 3e-3 : 1e-5)
            << "seed " << seed << " heading " << h;
        ASSERT_NEAR(double(rest.rise_m), slow.rise_m, kind == LandingGear::kSkids ? 2e-3 : 1e-5)
            << "seed " << seed << " heading " << h;
      }
    }
    EXPECT_LE(ties, 10);
  }
}

TEST(Touchdown, WorstOfARowIsTheWorstOfItsHeadings) {
  for (const LandingGear kind : {LandingGear::kSkids, LandingGear::kPads}) {
    const GridF height = RandomHeights(7, 0, 0.2);
    const GearOverMap gear(height, kCell_m, Gear(kind));
    std::vector<float> tilt(21), rise(21);
    gear.WorstOfRow(10, tilt.data(), rise.data());
    for (int c = 0; c < 21; ++c) {
      GearRest worst{0, -1e30F};
      for (int h = 0; h < gear.headings(); ++h) {
        const GearRest rest = gear.At({10, c}, h);
        worst.tilt_rad = std::max(worst.tilt_rad, rest.tilt_rad);
        worst.rise_m = std::max(worst.rise_m, rest.rise_m);
      }
      const bool known = c >= 6 && c < 15;  // the gear reaches 5 cells, one more between cells
      ASSERT_EQ(std::isnan(tilt[std::size_t(c)]), !known) << c;
      if (known) {
        ASSERT_EQ(tilt[std::size_t(c)], worst.tilt_rad);
        ASSERT_EQ(rise[std::size_t(c)], worst.rise_m);
      }
    }
  }
}

TEST(Touchdown, OnAPlaneTheGearTiltsAsThePlaneAtEveryHeading) {
  for (const LandingGear kind : {LandingGear::kSkids, LandingGear::kPads}) {
    for (const double slope_deg : {0.0, 3.0, 10.0, 25.0}) {
      const GearOverMap gear(Heights(Slope(Rad(slope_deg), 0.7)), kCell_m, Gear(kind));
      for (int h = 0; h < gear.headings(); ++h) {
        EXPECT_NEAR(Deg(double(gear.At({10, 10}, h).tilt_rad)), slope_deg, 0.02) << h;
        EXPECT_NEAR(double(gear.At({10, 10}, h).rise_m), 0, 1e-4);
      }
    }
  }
}

TEST(Touchdown, OneSkidOnACurbRollsByItsHeightOverTheWidth) {
  // Ground 0.12 m higher east of the middle: heading north, the right skid stands on it.
  const auto curb = [](double, double east) { return east > 0.05 ? 0.12 : 0.0; };
  const GearOverMap gear(Heights(curb), kCell_m, Gear(LandingGear::kSkids));
  EXPECT_NEAR(double(gear.At({10, 10}, 0).tilt_rad), std::atan(0.12 / 0.9), 1e-4);
}

TEST(Touchdown, ARockBetweenTheSkidsReachesForTheBelly) {
  const GearOverMap gear(Heights(WithBox(Flat(), 0, 0, 0.2, 0.4)), kCell_m,
                         Gear(LandingGear::kSkids));
  EXPECT_NEAR(double(gear.At({10, 10}, 0).tilt_rad), 0, 1e-6);
  EXPECT_NEAR(double(gear.At({10, 10}, 0).rise_m), 0.4, 1e-5);
}

TEST(Touchdown, ALongGearOnSmallCellsMissesNoPost) {
  Lander lander = Gear(LandingGear::kSkids);
  lander.gear_length_m = 6;
  lander.gear_width_m = 2;
  const int side = 61, post = 30 + 7;  // one cell, 1 m right of the middle
  for (int row = 12; row <= 48; ++row) {
    GridF height(side, side, 0.0F);
    height.at(row, post) = 0.5F;
    const GearOverMap gear(height, kCell_m, lander);
    EXPECT_GT(double(gear.At({30, 30}, 0).tilt_rad), 0.1) << row;
  }
}

TEST(Touchdown, UnknownGroundUnderTheGearIsNeverSafe) {
  ElevationMap map = MakeMap(60, 60, kCell_m, Flat());
  map.state.at(30, 30) = CellState::kUnknown;
  map.height_m.at(30, 30) = kUnknownValue;
  const HazardMaps hazards = EvaluateHazards(map, SladSettings{});
  EXPECT_EQ(hazards.safe_probability.at(30, 34), 0.0F);
  EXPECT_EQ(hazards.safe_probability.at(2, 30), 0.0F) << "the gear reaches beyond the map";
  EXPECT_GT(hazards.safe_probability.at(30, 42), 0.99F);
}

TEST(Touchdown, TiltBeyondNoiseStaysNearTheTrueTilt) {
  // Monte Carlo: the gear on denoised heights, against the gear on the ground itself.
  const SladSettings settings;
  const Height ground = WithBox(Slope(Rad(4), 1), 0.1, 0.5, 0.6, 0.2);
  const GearOverMap exact(MakeMap(41, 41, kCell_m, ground).height_m, kCell_m, settings.lander);
  double truth = 0;
  for (int h = 0; h < exact.headings(); ++h) {
    truth = std::max(truth, double(exact.At({20, 20}, h).tilt_rad));
  }
  double sum = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const ElevationMap map = MakeMap(41, 41, kCell_m, ground, 0.015, seed);
    const TerrainFigures figures = MeasureTerrain(map, settings);
    sum += double(figures.gear_tilt_rad.at(20, 20));
  }
  EXPECT_NEAR(Deg(sum / 60), Deg(truth), 1.0);
}

TEST(Touchdown, WorstAndBestHeadingOfASiteBesideACurb) {
  // A low curb along north: across it the gear rolls, along it a skid may stand on it.
  const auto curb = [](double, double east) { return 0.07 * (east > 0.3); };
  const ElevationMap map = MakeMap(60, 60, kCell_m, curb, 0.003, 4);
  SladSettings settings;
  settings.limits.max_slope_deg = 6;
  const HazardMaps hazards = EvaluateHazards(map, settings);
  LandingSite site;
  site.cell = {30, 30};
  site.p_WS = {map.geometry.NorthOfRow(30), map.geometry.EastOfCol(30), -0.02};
  const TouchdownOdds odds = OddsOfTouchdown(map, hazards, settings, site);
  EXPECT_EQ(odds.worst_probability, double(hazards.safe_probability.at(30, 30)));
  EXPECT_GE(odds.best_probability, odds.worst_probability);
  EXPECT_GE(odds.worst_heading_rad, 0);
  EXPECT_LT(odds.worst_heading_rad, 2 * M_PI);
  EXPECT_NE(odds.worst_heading_rad, odds.best_heading_rad);
  settings.mode = SladMode::kThesis;
  EXPECT_TRUE(std::isnan(OddsOfTouchdown(map, hazards, settings, site).worst_probability));
}

}  // namespace
}  // namespace palace
