// The sun by date and place, against published and listed cases.
#include "engine/world/sun_position.h"

#include <gtest/gtest.h>

#include "engine/core/units.h"
#include "engine/world/world_file.h"

namespace palace {
namespace {

struct Listed {
  const char* utc;
  double latitude_deg, longitude_deg;
  double azimuth_deg, elevation_deg;
};

// The first is NREL's case for SPA (Reda and Andreas 2008), its elevation with refraction; the
// others were computed apart, without.
TEST(SunPosition, IsWithinTwoHundredthsOfADegreeOfTheListedCases) {
  for (const Listed& listed : {Listed{"2003-10-17 19:30:30", 39.7425, -105.1786, 194.3402, 39.8884},
                               Listed{"2004-06-21 19:09:00", 37.415, -122.048, 132.54, 70.85},
                               Listed{"2004-12-21 23:30:00", 37.415, -122.048, 226.79, 12.63}}) {
    SCOPED_TRACE(listed.utc);
    const SunDirection sun =
        SunAt(ParseUtc(listed.utc).value(), Rad(listed.latitude_deg), Rad(listed.longitude_deg));
    EXPECT_NEAR(Deg(sun.azimuth_rad), listed.azimuth_deg, 0.02);
    EXPECT_NEAR(Deg(sun.elevation_rad), listed.elevation_deg, 0.02);
  }
}

// The equinox of March 2000 was on the 20th, 07:35 UTC: declination 0, so that at the equator the
// sun is overhead at local solar noon and rises in the east.
TEST(SunPosition, EquinoxAtTheEquator) {
  const SunDirection noon = SunAt({2000, 3, 20, 12, 7, 26}, 0, 0);
  EXPECT_GT(Deg(noon.elevation_rad), 89.8);
  const SunDirection rise = SunAt({2000, 3, 20, 6, 7, 30}, 0, 0);
  EXPECT_NEAR(Deg(rise.elevation_rad), 0, 0.1);
  EXPECT_NEAR(Deg(rise.azimuth_rad), 90, 0.1);
}

TEST(SunPosition, ReadsMomentsAndRefusesWhatIsNone) {
  EXPECT_TRUE(ParseUtc("2024-02-29 00:00:00"));
  for (const char* none : {"", "2023-02-29 00:00:00", "2024-13-01 00:00:00", "2024-01-01",
                           "2024-01-01 24:00:00", "2024-01-01 00:60:00", "1900-01-01 00:00:00",
                           "2024-01-01 00:00:00 UTC", "-024-01-01 00:00:00"}) {
    EXPECT_FALSE(ParseUtc(none)) << none;
  }
}

TEST(SunPosition, AWorldFileGivesTheSunEitherWay) {
  const std::string place = "latitude_deg = 37.415\nlongitude_deg = -122.048\n";
  const auto by_date = ParseWorld("[sun]\nutc = \"2004-06-21 19:09:00\"\n" + place, "yard.toml");
  ASSERT_TRUE(by_date) << by_date.error().message;
  EXPECT_NEAR(Deg(by_date->sun.azimuth_rad), 132.54, 0.02);
  EXPECT_NEAR(Deg(by_date->sun.elevation_rad), 70.85, 0.02);
  const auto by_angle = ParseWorld("[sun]\nazimuth_deg = 90\nelevation_deg = 30\n", "yard.toml");
  ASSERT_TRUE(by_angle) << by_angle.error().message;
  EXPECT_NEAR(Deg(by_angle->sun.elevation_rad), 30, 1e-9);
  const auto message = [](const std::string& text) {
    return ParseWorld(text, "yard.toml").error().message;
  };
  EXPECT_EQ(message("[sun]\nutc = \"midsummer\"\n" + place),
            "yard.toml:2: sun.utc = \"midsummer\"; write a moment of 1901 to 2099 as \"2004-06-21 "
            "19:09:00\"");
  EXPECT_EQ(message("[sun]\nutc = \"2004-06-21 08:00:00\"\n" + place),
            "yard.toml:2: sun.utc = \"2004-06-21 08:00:00\": the sun stands 29.1 degrees below the "
            "horizon there, the limit is 10");
  EXPECT_EQ(message("[sun]\nutc = \"2004-06-21 19:09:00\"\nelevation_deg = 3\n" + place),
            "yard.toml:3: sun.elevation_deg contradicts sun.utc; give one of them");
  EXPECT_EQ(message("[sun]\nutc = \"2004-06-21 19:09:00\"\nlatitude_deg = 91\n"),
            "yard.toml:3: sun.latitude_deg = 91 is outside -90 .. 90; degrees, north positive");
}

}  // namespace
}  // namespace palace
