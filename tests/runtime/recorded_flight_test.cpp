#include "engine/runtime/recorded_flight.h"

#include <gtest/gtest.h>

#include "engine/core/units.h"

namespace palace {
namespace {

TEST(RecordedFlight, TellsTheLimitsInForceAtATime) {
  auto record = std::make_shared<FlightRecord>();
  RecordedFlight flight;
  EXPECT_EQ(flight.SettingsAt({5}), nullptr);
  flight.Follow(record);
  EXPECT_EQ(flight.SettingsAt({5}), nullptr);
  for (const int degrees : {10, 6, 8}) {
    SettingsInForce entry{{static_cast<std::int64_t>(record->settings.size()) * 100 + 100}, {}};
    entry.settings.slad.limits.max_slope_deg = degrees;
    record->settings.push_back(entry);
  }
  struct Case {
    std::int64_t at_us;
    double slope_deg;
  };
  for (const Case& c :
       {Case{0, 10}, {100, 10}, {199, 10}, {200, 6}, {299, 6}, {300, 8}, {9999, 8}}) {
    const Settings* settings = flight.SettingsAt({c.at_us});
    ASSERT_NE(settings, nullptr);
    EXPECT_EQ(settings->slad.limits.max_slope_deg, c.slope_deg) << c.at_us;
  }
  // The site that was armed then stands under them, and nobody can select another.
  record->armed_sites.emplace_back();
  FlightRecordSample sample;
  sample.time = {250};
  sample.armed = 0;
  MissionStatus status;
  status.may_select = true;
  flight.Restore(sample, status);
  const LimitRow* slope = FindLimit(status.armed_limits, LimitId::kSlope);
  ASSERT_NE(slope, nullptr);
  EXPECT_NEAR(slope->limit, Rad(6), 1e-12);
  EXPECT_FALSE(status.may_select);
}

}  // namespace
}  // namespace palace
