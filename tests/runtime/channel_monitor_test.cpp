// A channel that fell silent is shown as silent, whatever goes on without it.
#include "engine/runtime/channel_monitor.h"

#include <gtest/gtest.h>

namespace palace {
namespace {

Timestamp At(double s) { return AddSeconds(Timestamp{1'000'000'000'000}, s); }

const ChannelHealth Of(const ChannelMonitor& monitor, ChannelId id, double now_s) {
  return *FindChannel(monitor.Health(At(now_s)), id);
}

TEST(ChannelMonitor, TheRateFallsWithTheSilence) {
  ChannelMonitor monitor;
  for (int i = 0; i <= 50; ++i) {
    FrameBundle bundle;
    bundle.laser.push_back({At(0.05 * i), 20.0});
    monitor.Add(bundle, true);
  }
  const struct {
    double silent_s, rate_hz;
  } table[] = {{0.0, 20}, {0.06, 20}, {0.5, 2}, {5, 0.2}, {40, 0.025}};
  for (const auto& row : table) {
    EXPECT_NEAR(Of(monitor, ChannelId::kLaserRange, 2.5 + row.silent_s).rate_hz, row.rate_hz, 1e-6)
        << row.silent_s;
  }
}

TEST(ChannelMonitor, AnEstimateIsAsOldAsWhatItTookInLast) {
  ChannelMonitor monitor;
  double now_s = 0;
  const auto run = [&](double until_s, bool fixes) {
    for (; now_s < until_s; now_s += 0.1) {
      const double fix_s = fixes ? 0.2 * std::floor(now_s / 0.2 + 1e-9) : 4.8;
      monitor.AddEstimate(At(fix_s), EstimateSource::kGps);
    }
  };
  run(4.95, true);  // GPS at 5 Hz is all that it rests on
  ChannelHealth health = Of(monitor, ChannelId::kPositionEstimate, 5.0);
  EXPECT_EQ(health.state, ChannelHealth::State::kFresh);
  EXPECT_NEAR(health.rate_hz, 5, 0.1);
  EXPECT_EQ(health.lost, 0U);
  run(14.95, false);
  health = Of(monitor, ChannelId::kPositionEstimate, 14.8);
  EXPECT_EQ(health.state, ChannelHealth::State::kStale);
  EXPECT_NEAR(health.age_s, 10, 1e-6);
  EXPECT_NEAR(health.rate_hz, 0.1, 1e-3);
}

}  // namespace
}  // namespace palace
