// A channel that fell silent is shown as silent, whatever goes on without it; what this station is
// too slow to look at is not laid to the vehicle.
#include "engine/runtime/channel_monitor.h"

#include <algorithm>
#include <initializer_list>
#include <utility>

#include <gtest/gtest.h>

#include "engine/model/channel_age.h"

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
  } table[] = {{0.0, 20}, {0.2, 20}, {0.9, 20}, {1.5, 5}, {5, 0.2}, {40, 0.025}};
  for (const auto& row : table) {
    EXPECT_NEAR(Of(monitor, ChannelId::kLaserRange, 2.5 + row.silent_s).rate_hz, row.rate_hz, 1e-6)
        << row.silent_s;
  }
}

TEST(ChannelMonitor, TheRateIsOfTheLastTwoSeconds) {
  ChannelMonitor monitor;
  FrameBundle bundle;
  const auto send = [&](double from_s, double to_s, double rate_hz) {
    for (int i = 0; from_s + i / rate_hz < to_s - 1e-9; ++i) {
      bundle.imu.push_back({At(from_s + i / rate_hz), {}, {}});
    }
  };
  send(0, 4, 100);
  send(4, 5, 50);    // a second of half as many
  send(45, 46, 50);  // forty of none
  monitor.Add(bundle, true);
  EXPECT_NEAR(Of(monitor, ChannelId::kImu, 46).rate_hz, 25, 1);
}

/// Samples of every kind a station looks at, at the rates that it expects.
FrameBundle Samples(double from_s, double to_s) {
  FrameBundle bundle;
  bundle.time = At(to_s);
  const auto each = [&](double rate_hz, const auto& add) {
    for (double n = std::ceil(from_s * rate_hz - 1e-6); n / rate_hz < to_s - 1e-6; ++n) {
      add(At(n / rate_hz));
    }
  };
  each(50, [&](Timestamp t) { bundle.poses.emplace_back().time = t; });
  each(100, [&](Timestamp t) { bundle.imu.push_back({t, {}, {}}); });
  each(5, [&](Timestamp t) { bundle.gps.emplace_back().time = t; });
  each(20, [&](Timestamp t) { bundle.laser.push_back({t, 20.0}); });
  return bundle;
}

/// As the bus brings it: a pair and a status ten times a second.
FrameBundle Tenth(int number) {
  FrameBundle bundle = Samples(0.1 * number, 0.1 * (number + 1));
  auto stereo = std::make_shared<StereoFrame>();
  stereo->time = At(0.1 * number);
  stereo->left = stereo->right = ImageU8(2, 2);
  bundle.stereo = stereo;
  bundle.status.emplace().time = At(0.1 * number);
  return bundle;
}

constexpr ChannelId kFromVehicle[] = {
    ChannelId::kCameraLeft, ChannelId::kCameraRight, ChannelId::kVehiclePose,  ChannelId::kImu,
    ChannelId::kGps,        ChannelId::kLaserRange,  ChannelId::kVehicleStatus};

// A pass of the engine takes so many tenths of a second; what came meanwhile reaches it joined.
TEST(ChannelMonitor, ASlowStationIsNotLaidToTheVehicle) {
  for (const int tenths : {1, 2, 5}) {
    ChannelMonitor monitor;
    for (int number = 0; number < 100; number += tenths) {
      auto bundle = std::make_shared<const FrameBundle>(Tenth(number));
      for (int i = 1; i < tenths; ++i) {
        bundle = Join(*bundle, Tenth(number + i)).bundle;
      }
      monitor.Add(*bundle, true);
    }
    for (const ChannelId id : kFromVehicle) {
      SCOPED_TRACE(std::string(ChannelName(id)) + ", a pass takes tenths " +
                   std::to_string(tenths));
      const ChannelHealth health = Of(monitor, id, 10.0);
      EXPECT_NEAR(health.rate_hz, health.expected_hz, 0.01 * health.expected_hz);
      EXPECT_EQ(health.lost, 0u);
      EXPECT_LT(health.lost_share, 0.01);
      EXPECT_EQ(health.count, static_cast<std::uint64_t>(std::lround(10 * health.expected_hz)));
      for (const double silent_s : {0.0, 0.1, 0.22, 0.5}) {  // until the next pass is shown
        const ChannelHealth shown = After(health, silent_s);
        EXPECT_EQ(shown.rate_hz, health.rate_hz) << silent_s;
        EXPECT_EQ(shown.state, ChannelHealth::State::kFresh) << silent_s;
        EXPECT_EQ(shown.age_s, health.age_s + silent_s);
      }
      EXPECT_EQ(After(health, 2).state, ChannelHealth::State::kStale) << "then the screen is old";
      EXPECT_TRUE(std::isnan(After(health, 2).rate_hz));
    }
  }
}

TEST(ChannelMonitor, WhatWasLostOnTheWayIsLostBesideWhatWasOvertaken) {
  ChannelMonitor monitor;
  for (int number = 0; number < 100; number += 5) {
    FrameBundle none;  // of five pairs two are lost, two are overtaken
    auto bundle = Join(none, Tenth(number)).bundle;
    bundle = Join(*bundle, Tenth(number + 1)).bundle;
    bundle = Join(*bundle, Samples(0.1 * (number + 2), 0.1 * (number + 4))).bundle;
    monitor.Add(*Join(*bundle, Tenth(number + 4)).bundle, true);
  }
  const ChannelHealth left = Of(monitor, ChannelId::kCameraLeft, 10.0);
  EXPECT_EQ(left.count, 20u * 3);
  EXPECT_EQ(left.lost, 19u * 2);
  EXPECT_NEAR(left.rate_hz, 6, 0.2);
  EXPECT_EQ(Of(monitor, ChannelId::kImu, 10.0).lost, 0u);
}

// A link that was lost once for seconds, and one that goes on and off: the first is whole again.
TEST(ChannelMonitor, AnOutageThatIsOverIsNoLossAndOneThatComesBackIs) {
  const auto share = [](std::initializer_list<std::pair<int, int>> silences) {
    ChannelMonitor monitor;
    for (int number = 0; number < 160; ++number) {
      const bool silent = std::any_of(silences.begin(), silences.end(), [&](const auto& silence) {
        return number >= silence.first && number < silence.second;
      });
      if (!silent) {
        monitor.Add(Tenth(number), true);
      }
    }
    return Of(monitor, ChannelId::kVehicleStatus, 16.0).lost_share;
  };
  EXPECT_LT(share({}), 0.01);
  EXPECT_LT(share({{120, 150}}), 0.01);
  EXPECT_GT(share({{120, 132}, {140, 152}}), kMostLostShare);
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

TEST(ChannelMonitor, AfterAJumpItTellsWhatTheRecordHeardBefore) {
  ChannelMonitor monitor;
  std::array<std::optional<Timestamp>, kChannelCount> heard;
  heard[static_cast<std::size_t>(ChannelId::kCameraLeft)] = At(7);
  monitor.RestoreHeard(heard);
  const ChannelHealth left = Of(monitor, ChannelId::kCameraLeft, 10.2);
  EXPECT_EQ(left.state, ChannelHealth::State::kStale);
  EXPECT_NEAR(left.age_s, 3.2, 1e-6);
  EXPECT_EQ(Of(monitor, ChannelId::kGps, 10.2).state, ChannelHealth::State::kNever);
  FrameBundle bundle;
  bundle.arrival.left_alone = At(10.3);
  monitor.Add(bundle, true);
  const ChannelHealth again = Of(monitor, ChannelId::kCameraLeft, 10.3);
  EXPECT_EQ(again.state, ChannelHealth::State::kFresh);
  EXPECT_EQ(again.lost, 0U) << "what was not seen here is not counted as lost here";
  monitor.Reset();
  EXPECT_EQ(Of(monitor, ChannelId::kCameraLeft, 10.4).state, ChannelHealth::State::kNever);
}

}  // namespace
}  // namespace palace
