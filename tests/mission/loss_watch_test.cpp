// Losses that matter raise an alarm, and only while they go on.
#include "engine/mission/watch/loss_watch.h"

#include <gtest/gtest.h>

#include "engine/mission/alarms/alarms.h"

namespace palace {
namespace {

/// Whether the alarm's row finds its condition in what the watch says.
bool Present(const LossWatch& watch, AlarmId id, bool vehicle = true) {
  AlarmFacts facts;
  facts.has_vehicle = vehicle;
  facts.losses = watch.recent();
  facts.refused_hz = facts.losses.refused_hz;
  facts.bus_load = facts.losses.bus_load;
  facts.looked_at_hz = facts.losses.replaced_hz > 0 ? facts.losses.pairs_hz : NAN;
  return EvaluateAlarms(facts)[static_cast<std::size_t>(id)].present;
}

/// Ten seconds of bundles at 10 Hz; of each ten `looked_at` bring pictures, the rest were replaced.
void FlyFor10s(LossWatch& watch, Losses& losses, Timestamp& now, int looked_at) {
  for (int i = 0; i < 100; ++i) {
    now = AddSeconds(now, 0.1);
    const bool pair = i % 10 < looked_at;
    losses.pairs_replaced += pair ? 0 : 1;
    watch.Update(losses, pair, now);
  }
}

TEST(LossWatch, ReplacedPicturesMatterWhenTooFewAreLeft) {
  struct Case {
    int looked_at;
    bool alarm;
  };
  for (const Case& c :
       {Case{10, false}, Case{8, false}, Case{6, false}, Case{4, true}, Case{1, true}}) {
    SCOPED_TRACE(c.looked_at);
    LossWatch watch;
    Losses losses;
    Timestamp now{5'000'000};
    FlyFor10s(watch, losses, now, c.looked_at);
    EXPECT_EQ(Present(watch, AlarmId::kPicturesReplaced), c.alarm);
    EXPECT_FALSE(Present(watch, AlarmId::kPicturesReplaced, /*vehicle=*/false));
    FlyFor10s(watch, losses, now, 10);
    EXPECT_FALSE(Present(watch, AlarmId::kPicturesReplaced)) << "it is over";
  }
}

TEST(LossWatch, CamerasThatAreMerelySilentAreNotThis) {
  LossWatch watch;
  Losses losses;
  Timestamp now{5'000'000};
  for (int i = 0; i < 100; ++i) {
    now = AddSeconds(now, 0.1);
    watch.Update(losses, false, now);
  }
  EXPECT_FALSE(Present(watch, AlarmId::kPicturesReplaced));
}

TEST(LossWatch, EachLossIsAnAlarmForTenSeconds) {
  struct Case {
    AlarmId id;
    void (*lose)(Losses&);
  };
  for (const Case& c :
       {Case{AlarmId::kUndecodable, [](Losses& l) { ++l.undecodable["VEHICLE_POSE"]; }},
        Case{AlarmId::kOtherVersion,
             [](Losses& l) {
               ++l.undecodable["GPS"];
               ++l.other_version["GPS"];
             }},
        Case{AlarmId::kDatagramsRefused, [](Losses& l) { ++l.datagrams_refused; }},
        Case{AlarmId::kRefusedOften, [](Losses& l) { l.datagrams_refused += 200; }},
        Case{AlarmId::kBusOverrun, [](Losses& l) { ++l.bus.overrun; }},
        Case{AlarmId::kRecordsDropped, [](Losses& l) { ++l.records_dropped; }},
        Case{AlarmId::kMessagesUnsent, [](Losses& l) { ++l.messages_unsent; }}}) {
    SCOPED_TRACE(AlarmName(c.id));
    LossWatch watch;
    Losses losses;
    Timestamp now{5'000'000};
    EXPECT_FALSE(Present(watch, c.id));
    FlyFor10s(watch, losses, now, 10);
    EXPECT_FALSE(Present(watch, c.id));
    c.lose(losses);
    now = AddSeconds(now, 0.1);
    watch.Update(losses, true, now);
    EXPECT_TRUE(Present(watch, c.id));
    now = AddSeconds(now, 9.8);
    watch.Update(losses, true, now);
    EXPECT_TRUE(Present(watch, c.id));
    now = AddSeconds(now, 0.3);
    watch.Update(losses, true, now);
    EXPECT_FALSE(Present(watch, c.id));
  }
}

TEST(LossWatch, WhatWasLostBeforeTheFirstBundleCounts) {
  LossWatch watch;
  Losses losses;
  losses.undecodable["CAMERA_LEFT"] = 4;
  watch.Update(losses, false, {5'000'000});
  EXPECT_TRUE(Present(watch, AlarmId::kUndecodable));
  EXPECT_EQ(watch.recent().channels, "CAMERA_LEFT 4");
}

TEST(LossWatch, AJumpInTimeStartsAnew) {
  LossWatch watch;
  Losses losses;
  Timestamp now{500'000'000};
  FlyFor10s(watch, losses, now, 1);
  losses.records_dropped = 7;
  watch.Update(losses, true, AddSeconds(now, 0.1));
  ASSERT_TRUE(Present(watch, AlarmId::kRecordsDropped));
  watch.Update(losses, true, {1'000'000});
  EXPECT_FALSE(Present(watch, AlarmId::kRecordsDropped));
  EXPECT_FALSE(Present(watch, AlarmId::kPicturesReplaced));
}

TEST(LossWatch, ARefusedDatagramIsAnAdvisoryUntilThereIsMoreThanOneASecond) {
  LossWatch watch;
  Losses losses;
  Timestamp now{5'000'000};
  FlyFor10s(watch, losses, now, 10);
  losses.datagrams_refused = 9;
  watch.Update(losses, true, AddSeconds(now, 0.1));
  EXPECT_TRUE(Present(watch, AlarmId::kDatagramsRefused));
  EXPECT_FALSE(Present(watch, AlarmId::kRefusedOften));
  losses.datagrams_refused = 11;
  watch.Update(losses, true, AddSeconds(now, 0.2));
  EXPECT_FALSE(Present(watch, AlarmId::kDatagramsRefused));
  EXPECT_TRUE(Present(watch, AlarmId::kRefusedOften));
}

TEST(LossWatch, AnotherVersionIsNotSaidTwice) {
  LossWatch watch;
  Losses losses;
  losses.undecodable["GPS"] = losses.other_version["GPS"] = 4;
  watch.Update(losses, true, {5'000'000});
  EXPECT_TRUE(Present(watch, AlarmId::kOtherVersion));
  EXPECT_FALSE(Present(watch, AlarmId::kUndecodable));
  EXPECT_EQ(watch.recent().other_version, "GPS 4");
}

TEST(LossWatch, TheBusiestChannelIsHeldAgainstWhatItNeeds) {
  LossWatch watch;
  Losses losses;
  losses.bus.channels = {{.channel = "IMU", .rate_hz = 3000, .most_hz = 400},
                         {.channel = "GPS", .rate_hz = 99, .most_hz = 10}};
  losses.bus.rate_hz = 4000;
  losses.bus.most_hz = 410;
  watch.Update(losses, true, {5'000'000});
  EXPECT_EQ(watch.recent().busiest, "GPS");
  EXPECT_DOUBLE_EQ(watch.recent().bus_load, 9.9);
  EXPECT_FALSE(Present(watch, AlarmId::kBusOverload));
  losses.bus.channels[1].rate_hz = 101;
  watch.Update(losses, true, {5'100'000});
  EXPECT_TRUE(Present(watch, AlarmId::kBusOverload));
}

TEST(LossWatch, ASecondSenderIsNamedWithItsAddress) {
  LossWatch watch;
  Losses losses;
  losses.bus.channels = {{.channel = "GPS", .sender = "10.0.0.2:1"},
                         {.channel = "IMU", .sender = "10.0.0.2:1", .second_sender = "10.0.0.9:2"}};
  watch.Update(losses, true, {5'000'000});
  EXPECT_TRUE(Present(watch, AlarmId::kSecondSender));
  EXPECT_EQ(watch.recent().second_sender, "IMU from 10.0.0.9:2");
}

TEST(LossWatch, ShareLostIsOfTheLastTenSeconds) {
  LossWatch watch;
  Losses losses;
  Timestamp now{5'000'000};
  const auto fly = [&](std::uint64_t received, std::uint64_t lost) {
    for (int i = 0; i < 100; ++i) {
      now = AddSeconds(now, 0.1);
      losses.bus.received_of_used += received;
      losses.bus.lost_of_used += lost;
      watch.Update(losses, true, now);
    }
  };
  watch.Update(losses, true, now);
  EXPECT_TRUE(std::isnan(watch.recent().lost_share));
  fly(7, 3);
  EXPECT_DOUBLE_EQ(watch.recent().lost_share, 0.3);
  fly(10, 0);
  EXPECT_DOUBLE_EQ(watch.recent().lost_share, 0);
  losses.bus.lost_of_used -= 5;  // gaps that closed
  watch.Update(losses, true, AddSeconds(now, 0.1));
  EXPECT_DOUBLE_EQ(watch.recent().lost_share, 0);
}

}  // namespace
}  // namespace palace
