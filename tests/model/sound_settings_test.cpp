// Settings that do not go together, and those that nobody usually takes.
#include "engine/model/settings/sound_settings.h"

#include <gtest/gtest.h>

namespace palace {
namespace {

TEST(SoundSettings, ABaseHoldsItsGearAndAClearRadiusIsOneThatVehiclesTake) {
  struct Row {
    double base_m, length_m, width_m, nav_m;
    const char* why;
  };
  for (const Row& row :
       {Row{3.6, 1.2, 0.9, 0.5, ""}, Row{1.5, 1.2, 0.9, 0.5, ""}, Row{0.5, 0.3, 0.4, 0.25, ""},
        Row{0.2, 1.2, 0.9, 0.5, "Base size 0.20 m, min 1.50 m: its circle holds the gear"},
        Row{0.5, 0.3, 0.4, 0.24, "Required clear radius 0.49 m, vehicles take 0.5 to 25 m"},
        Row{20, 1.2, 0.9, 15.1, "Required clear radius 25.10 m, vehicles take 0.5 to 25 m"}}) {
    Lander lander;
    lander.base_size_m = row.base_m;
    lander.gear_length_m = row.length_m;
    lander.gear_width_m = row.width_m;
    lander.nav_error_m = row.nav_m;
    EXPECT_EQ(WhyNotLandable(lander), row.why);
  }
}

TEST(SoundSettings, WhatIsOutsideTheUsualRangeIsNamedWithIt) {
  Settings settings;
  EXPECT_EQ(OutsideUsual(settings), "");
  settings.slad.limits.max_slope_deg = 15;
  EXPECT_EQ(OutsideUsual(settings), "") << "a limit may be as loose as that";
  settings.slad.limits.max_slope_deg = 15.1;
  EXPECT_EQ(OutsideUsual(settings), "Max slope 15.1° (usually 2.0° to 15.0°)");
  settings.slad.limits.max_deviation_m = 1;
  settings.slad.limits.max_step_m = 2;
  settings.slad.limits.min_safe_probability = 0;
  settings.slad.lander.nav_error_m = 0;
  EXPECT_EQ(OutsideUsual(settings),
            "Max slope 15.1° (usually 2.0° to 15.0°), Max roughness 100.0 cm (usually 2.0 cm to "
            "30.0 cm), Max step 200.0 cm (usually 5.0 cm to 40.0 cm) and 2 more");
}

}  // namespace
}  // namespace palace
