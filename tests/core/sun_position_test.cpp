// The sun against published and listed cases, and what must hold of it anywhere and at any time.
#include "engine/core/sun_position.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "engine/core/random.h"
#include "engine/core/units.h"

namespace palace {
namespace {

constexpr double kDay_s = 86400;
constexpr double kFrom1990_s = 631152000, kTo2051_s = 2556144000;

SunDirection At(double unix_s, double latitude_deg, double longitude_deg) {
  return SunAt(AddSeconds({}, unix_s), Rad(latitude_deg), Rad(longitude_deg));
}

/// Unit vector: north, east, up.
Eigen::Vector3d Direction(const SunDirection& sun) {
  return {std::cos(sun.elevation_rad) * std::cos(sun.azimuth_rad),
          std::cos(sun.elevation_rad) * std::sin(sun.azimuth_rad), std::sin(sun.elevation_rad)};
}

/// By the chord: the cosine of a small arc is 1 but for its rounding.
double ArcBetween_deg(const SunDirection& a, const SunDirection& b) {
  return Deg(2 * std::asin(std::min(1.0, (Direction(a) - Direction(b)).norm() / 2)));
}

struct Listed {
  const char* name;
  double unix_s;
  double latitude_deg, longitude_deg;
  double azimuth_deg, elevation_deg;
  double within_deg;
};

TEST(SunAt, ListedCases) {
  for (const Listed& listed : {
           // simulation.md 3.1, given to a hundredth of a degree.
           Listed{"2004-06-21 19:09:00", 1087844940, 37.415, -122.048, 132.54, 70.85, 0.01},
           Listed{"2004-12-21 23:30:00", 1103671800, 37.415, -122.048, 226.79, 12.63, 0.01},
           // VSOP87 as PyEphem 4.1.4 has it, without refraction and parallax.
           Listed{"1990-01-01 00:00:00", 631152000, -33.9, 18.4, 161.1533, -30.6520, 0.016},
           Listed{"1996-02-29 23:59:59", 825638399, 69.6, 18.9, 17.6449, -27.1144, 0.016},
           Listed{"2003-10-17 19:30:30", 1066419030, 39.7425, -105.1786, 194.3402, 39.8739, 0.016},
           Listed{"2010-07-04 05:12:40", 1278220360, 35.7, 139.7, 258.2429, 55.7058, 0.016},
           Listed{"2024-06-20 12:00:00", 1718884800, -3.1, -60.0, 62.1472, 25.5088, 0.016},
           Listed{"2026-12-21 09:30:00", 1797845400, 48.1, 11.6, 155.9629, 14.9190, 0.016},
           Listed{"2038-01-19 03:14:08", 2147483648, -77.8, 166.7, 324.1462, 30.4320, 0.016},
           Listed{"2050-12-31 18:45:00", 2556125100, 19.4, -99.1, 181.8655, 47.5460, 0.016},
       }) {
    SCOPED_TRACE(listed.name);
    const SunDirection sun = At(listed.unix_s, listed.latitude_deg, listed.longitude_deg);
    EXPECT_NEAR(Deg(sun.azimuth_rad), listed.azimuth_deg, listed.within_deg);
    EXPECT_NEAR(Deg(sun.elevation_rad), listed.elevation_deg, listed.within_deg);
  }
}

// NREL's case for SPA (Reda and Andreas 2008): azimuth 194.3402, zenith 50.1116 as it is seen
// through the air. The lift at 820 hPa and 11 degrees Celsius is Saemundsson's (Meeus 16.4).
TEST(SunAt, NrelsCaseThroughTheAir) {
  const SunDirection sun = At(1066419030, 39.7425, -105.1786);
  EXPECT_NEAR(Deg(sun.azimuth_rad), 194.3402, 0.003);
  const double elevation_deg = Deg(sun.elevation_rad);
  // NOAA's spreadsheet in simulation.md 3.1, without refraction.
  EXPECT_NEAR(Deg(sun.azimuth_rad), 194.3426, 0.0001);
  EXPECT_NEAR(90 - elevation_deg, 50.1279, 0.0001);
  const double lift_deg = 820.0 / 1010 * 283 / 284 * 1.02 / 60 /
                          std::tan(Rad(elevation_deg + 10.3 / (elevation_deg + 5.11)));
  EXPECT_NEAR(90 - elevation_deg - lift_deg, 50.1116, 0.003);
}

// At a pole the elevation is the declination. Moments of solstices and equinoxes to the minute,
// as almanacs print them.
TEST(SunAt, SolsticesAndEquinoxesAtThePoles) {
  for (const auto& [unix_s, declination_deg] :
       {std::pair{1087779420.0, 23.44}, {1584676200.0, 0.0}, {1734772800.0, -23.44}}) {
    EXPECT_NEAR(Deg(At(unix_s, 90, 0).elevation_rad), declination_deg, 0.01) << unix_s;
    EXPECT_NEAR(Deg(At(unix_s, -90, 0).elevation_rad), -declination_deg, 0.01) << unix_s;
    EXPECT_NEAR(At(unix_s, 90, 0).elevation_rad, At(unix_s, 90, 123).elevation_rad, 1e-9);
  }
}

TEST(SunAt, IsHighestInTheSouthOfTheNorthAndInTheNorthOfTheSouth) {
  constexpr std::uint64_t kSeed = 1998;
  RandomStream random(kSeed);
  for (int trial = 0; trial < 200; ++trial) {
    const double day = std::floor(random.Uniform(kFrom1990_s, kTo2051_s) / kDay_s);
    const bool in_north = trial % 2 == 0;
    const double latitude_deg = (in_north ? 1 : -1) * random.Uniform(30, 65);
    const double longitude_deg = random.Uniform(-180, 180);
    // From midnight there, or the edge of the next day's arc could stand higher than this noon.
    const double start_s = std::floor((day - longitude_deg / 360) * kDay_s);
    SunDirection highest{0, -2};
    for (double s = 0; s < kDay_s; s += 60) {
      const SunDirection sun = At(start_s + s, latitude_deg, longitude_deg);
      highest = sun.elevation_rad > highest.elevation_rad ? sun : highest;
    }
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", trial " << trial);
    // Half a minute is 0.125 degrees of hour angle, in azimuth eight times as much 6.5 degrees
    // beside the zenith; at equinoxes the highest point is up to half a minute off noon.
    ASSERT_LT(std::abs(std::sin(highest.azimuth_rad)), std::sin(Rad(2.5)));
    ASSERT_EQ(std::cos(highest.azimuth_rad) < 0, in_north);
    ASSERT_NEAR(Deg(highest.elevation_rad), 90 - std::abs(latitude_deg), 23.46);
  }
}

// In a second the sky turns by 15 arc seconds: no more, over no midnight, no end of a year.
TEST(SunAt, DoesNotJump) {
  constexpr std::uint64_t kSeed = 2050;
  RandomStream random(kSeed);
  for (int trial = 0; trial < 2000; ++trial) {
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", trial " << trial);
    const double any_s = std::floor(random.Uniform(kFrom1990_s, kTo2051_s));
    const double midnight_s = std::floor(any_s / kDay_s) * kDay_s;
    const double latitude_deg = random.Uniform(-90, 90);
    const double longitude_deg = random.Uniform(-180, 180);
    for (const double moment_s : {any_s, midnight_s}) {
      const SunDirection before = At(moment_s - 0.5, latitude_deg, longitude_deg);
      const SunDirection after = At(moment_s + 0.5, latitude_deg, longitude_deg);
      ASSERT_LT(ArcBetween_deg(before, after), 15.1 / 3600);
    }
  }
  for (const double new_year_s : {946684800.0, 1704067200.0, 0.0}) {
    EXPECT_LT(ArcBetween_deg(At(new_year_s - 0.5, 48, 11), At(new_year_s + 0.5, 48, 11)),
              15.1 / 3600);
  }
}

TEST(SunAt, IsAnAngleEverywhereFrom1990To2050) {
  for (double unix_s = kFrom1990_s; unix_s < kTo2051_s; unix_s += 5.3 * kDay_s) {
    for (const double latitude_deg : {-90.0, -66.6, 0.0, 23.4, 89.999, 90.0}) {
      for (const double longitude_deg : {-540.0, -180.0, 0.0, 77.0, 180.0}) {
        const SunDirection sun = At(unix_s, latitude_deg, longitude_deg);
        ASSERT_TRUE(sun.azimuth_rad >= 0 && sun.azimuth_rad < 2 * std::numbers::pi) << unix_s;
        ASSERT_LE(std::abs(sun.elevation_rad), std::numbers::pi / 2) << unix_s;
      }
    }
  }
  EXPECT_LT(ArcBetween_deg(At(1e9, 20, 200), At(1e9, 20, -160)), 1e-9);
}

TEST(SunAt, EveryStampGivesAnAngle) {
  using Range = std::numeric_limits<std::int64_t>;
  for (const std::int64_t us : {Range::min(), Range::max(), std::int64_t{-1}, std::int64_t{0}}) {
    const SunDirection sun = SunAt({us}, 0.8, 0.2);
    EXPECT_TRUE(std::isfinite(sun.azimuth_rad) && std::isfinite(sun.elevation_rad)) << us;
  }
}

TEST(SunAt, UnknownPlacesGiveNaN) {
  for (const auto& [latitude_deg, longitude_deg] : {std::pair{double{NAN}, 0.0},
                                                    {0.0, double{NAN}},
                                                    {double{INFINITY}, 0.0},
                                                    {0.0, double{INFINITY}},
                                                    {90.1, 0.0},
                                                    {-91.0, 0.0}}) {
    const SunDirection sun = At(1e9, latitude_deg, longitude_deg);
    EXPECT_TRUE(std::isnan(sun.azimuth_rad) && std::isnan(sun.elevation_rad))
        << latitude_deg << ", " << longitude_deg;
  }
}

}  // namespace
}  // namespace palace
