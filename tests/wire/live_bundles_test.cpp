// Bundles of a live vehicle: what steps, stalls, silence, loss and forgery do to their time.
#include "engine/wire/live_bundles.h"

#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "engine/wire/lcm_source.h"
#include "tests/wire/wire_samples.h"

namespace palace {
namespace {

constexpr std::int64_t kVehicle_us = 7'000'000'000;

/// A vehicle of somebody else's: poses at 50 Hz, status and pairs at 10 Hz, a rig once.
class Vehicle {
 public:
  Vehicle() {
    RandomStream random(8);
    rig_ = std::make_shared<const StereoRig>(RandomRig(random));
  }
  std::int64_t offset_us = kVehicle_us;
  std::uint64_t boot_id = 5;
  bool left = true, right = true, numbers = true;

  std::vector<WireMessage> Send(int tick) {  // 20 ms a tick
    FrameBundle bundle;
    const Timestamp now{offset_us + tick * 20'000};
    VehiclePose pose;
    pose.time = now;
    pose.v_WB.x() = numbers ? 0 : NAN;
    bundle.poses = {pose};
    if (tick % 5 == 0) {
      VehicleStatus status;
      status.time = now;
      status.boot_id = boot_id;
      bundle.status = status;
      bundle.stereo = std::make_shared<StereoFrame>(
          StereoFrame{now, ImageU8(4, 3, std::uint8_t{1}), ImageU8(4, 3, std::uint8_t{2})});
      bundle.rig = rig_;
    }
    bundle.time = now;
    std::vector<WireMessage> sent;
    for (WireMessage& message : EncodeBundle(bundle, {})) {
      const bool of_left = message.channel == ChannelNames{}.camera_left;
      const bool of_right = message.channel == ChannelNames{}.camera_right;
      if (message.channel == ChannelNames{}.camera_rig) {
        message.payload[16] = 0;  // bundle_end: not a sender of ours
        if (tick != 0) {
          continue;
        }
      }
      if ((of_left && !left) || (of_right && !right)) {
        continue;
      }
      sent.push_back(std::move(message));
    }
    return sent;
  }

 private:
  std::shared_ptr<const StereoRig> rig_;
};

/// The station: a bundle whenever one is ready, or after 0.2 s of none.
struct Station {
  LiveBundles bundles{{}, true};
  double now_s = 100;
  double delivered_s = 100;
  std::vector<std::shared_ptr<const FrameBundle>> got;

  void Take(const std::vector<WireMessage>& messages) {
    for (const WireMessage& message : messages) {
      bundles.Take(message, now_s);
    }
  }
  void Turn() {
    if (bundles.ready() || now_s - delivered_s >= 0.2) {
      got.push_back(bundles.HandOn(now_s));
      delivered_s = now_s;
    }
  }
};

void Fly(Station& station, Vehicle& vehicle, int from, int to) {
  for (int tick = from; tick < to; ++tick) {
    station.now_s = 100 + 0.02 * tick;
    station.Take(vehicle.Send(tick));
    station.Turn();
  }
}

TEST(LiveBundles, TimeIsTheVehiclesOnTheClockOfTheStation) {
  Station station;
  Vehicle vehicle;
  Fly(station, vehicle, 0, 100);
  ASSERT_GE(station.got.size(), 19u);
  for (const auto& bundle : station.got) {
    ASSERT_TRUE(bundle->arrival.clock);
    EXPECT_EQ(bundle->time.us,
              kVehicle_us + std::llround(1e6 * (bundle->arrival.clock->station_s - 100)));
    EXPECT_EQ(bundle->arrival.clock->stepped_s, 0);
    EXPECT_FALSE(bundle->discontinuity);
  }
  EXPECT_FALSE(station.got.back()->arrival.clock->estimating);
  // Silence: time runs on without any message.
  station.now_s += 3;
  station.Turn();
  EXPECT_NEAR(SecondsBetween(Timestamp{kVehicle_us}, station.got.back()->time), 100 * 0.02 + 3,
              0.03);
  EXPECT_EQ(station.got.back()->stereo, nullptr);
}

TEST(LiveBundles, AStepOfTheVehiclesClockPartsTheTimes) {
  for (const std::int64_t step_us : {5'000'000LL, -5'000'000LL, 86'400'000'000LL}) {
    SCOPED_TRACE(step_us);
    Station station;
    Vehicle vehicle;
    Fly(station, vehicle, 0, 200);
    vehicle.offset_us += step_us;
    Fly(station, vehicle, 200, 300);
    double told_s = 0, told_after_s = 0;
    int jumps = 0;
    for (const auto& bundle : station.got) {
      told_s += bundle->arrival.clock->stepped_s;
      if (bundle->discontinuity) {
        ++jumps;
        told_after_s = bundle->arrival.clock->station_s - 104;
        EXPECT_NE(bundle->arrival.clock->stepped_s, 0);
      }
    }
    EXPECT_EQ(jumps, 1);
    EXPECT_LT(told_after_s, 0.3);
    EXPECT_NEAR(told_s, 1e-6 * static_cast<double>(step_us), 0.02);
    const auto& last = station.got.back();
    EXPECT_NEAR(SecondsBetween(last->poses.back().time, last->time), 0, 0.02);
  }
}

// Our own machine stood still: all that queued is read at once, nothing is a step, and the bundle
// that follows is as new as the data.
TEST(LiveBundles, AStallOfThisMachineIsNoStep) {
  Station station;
  Vehicle vehicle;
  Fly(station, vehicle, 0, 200);
  const std::size_t before = station.got.size();
  station.now_s = 100 + 0.02 * 240;  // 0.8 s later
  station.bundles.Stalled(0.8, station.now_s);
  for (int tick = 200; tick <= 240; ++tick) {
    station.Take(vehicle.Send(tick));
  }
  station.Turn();
  ASSERT_EQ(station.got.size(), before + 1);
  const FrameBundle& first = *station.got.back();
  EXPECT_EQ(first.arrival.clock->stepped_s, 0);
  EXPECT_EQ(first.arrival.clock->stalled_s, 0.8);
  EXPECT_FALSE(first.discontinuity);
  EXPECT_EQ(first.poses.back().time, first.time);
  EXPECT_EQ(first.stereo->time, first.time);
  EXPECT_GE(first.poses.size(), 41u);
  Fly(station, vehicle, 241, 260);
  EXPECT_EQ(station.got.back()->arrival.clock->stalled_s, 0);
  EXPECT_EQ(station.bundles.Count().stamps_refused_messages(), 0u);
}

// One forged stamp neither blinds its channel nor moves time: found-by-attack, defect 11.
TEST(LiveBundles, ForgedStampsBlindNothing) {
  using Range = std::numeric_limits<std::int64_t>;
  for (const std::int64_t forged_us :
       {std::int64_t{1}, kVehicle_us + 4'000'000 + 9'900'000, Range::min(), Range::max()}) {
    SCOPED_TRACE(forged_us);
    Station station;
    Vehicle vehicle;
    Fly(station, vehicle, 0, 200);
    Vehicle forger;
    forger.offset_us = forged_us;
    for (int i = 0; i < 3; ++i) {
      station.Take(forger.Send(0));  // pose, status, both pictures
    }
    const std::size_t before = station.got.size();
    Fly(station, vehicle, 200, 250);
    int poses = 0, pairs = 0;
    for (std::size_t i = before; i < station.got.size(); ++i) {
      EXPECT_FALSE(station.got[i]->discontinuity);
      poses += static_cast<int>(station.got[i]->poses.size());
      pairs += station.got[i]->stereo != nullptr;
    }
    EXPECT_GE(poses, 45);
    EXPECT_GE(pairs, 9);
    EXPECT_GE(station.bundles.Count().stamps_refused_messages(), 9u);
    EXPECT_EQ(station.bundles.Count().stamps_refused.count("VEHICLE_POSE"), 1u);
  }
}

// However many pairs come before one is asked for, only the newest is held.
TEST(LiveBundles, OfPairsThatWaitOnlyTheNewestIsHeld) {
  LiveBundles bundles({}, true);
  Vehicle vehicle;
  for (int tick = 0; tick < 200; ++tick) {
    for (const WireMessage& message : vehicle.Send(tick)) {
      bundles.Take(message, 100 + 0.02 * tick);
    }
  }
  EXPECT_EQ(bundles.Count().pairs_replaced, 39u) << "let go as they came";
  const auto bundle = bundles.HandOn(104);
  EXPECT_EQ(bundle->stereo->time.us, kVehicle_us + 195 * 20'000);
  EXPECT_EQ(bundle->arrival.overtaken[0], 39) << "left";
  EXPECT_EQ(bundle->arrival.overtaken[1], 39) << "right";
  EXPECT_GE(bundle->poses.size(), 195u);
  EXPECT_FALSE(bundles.ready());
}

// What the receiver's queues had no room for came whole: it is told once, and none of it is lost.
TEST(LiveBundles, WhatWaitedInTheReceiverTooLongIsOvertaken) {
  LiveBundles bundles({}, true);
  BusTraffic traffic;
  traffic.channels = {{.channel = "CAMERA_LEFT", .overflowed = 7},
                      {.channel = "CAMERA_RIGHT", .overflowed = 6},
                      {.channel = "IMU", .overflowed = 40},
                      {.channel = "COMMAND", .overflowed = 9}};
  bundles.NoteOverflow(traffic);
  const ArrivalNotes first = bundles.HandOn(100)->arrival;
  EXPECT_EQ(first.overtaken, (std::array{7, 6, 0, 40, 0, 0, 0, 0}));
  traffic.channels[2].overflowed = 41;
  bundles.NoteOverflow(traffic);
  EXPECT_EQ(bundles.HandOn(100.1)->arrival.overtaken, (std::array{0, 0, 0, 1, 0, 0, 0, 0}));
  EXPECT_EQ(bundles.Count().pairs_replaced, 7u) << "a pair is counted once";
  EXPECT_EQ(bundles.Count().samples_overflowed, 41u);
}

TEST(LiveBundles, ReasonsOfAnswersArePlainAndBounded) {
  LiveBundles bundles({}, true);
  bundles.Take(EncodeAck({{5}, 1, AckResult::kRefused, "no\n\x1b[2J" + std::string(3000, 'x')}, {}),
               100);
  const auto bundle = bundles.HandOn(100);
  ASSERT_EQ(bundle->acks.size(), 1u);
  EXPECT_EQ(bundle->acks[0].reason.substr(0, 8), "no??[2Jx");
  EXPECT_EQ(bundle->acks[0].reason.size(), 200u);
}

TEST(LiveBundles, OneLostCameraIsToldByTheOther) {
  Station station;
  Vehicle vehicle;
  Fly(station, vehicle, 0, 100);
  vehicle.right = false;
  Fly(station, vehicle, 100, 150);
  const FrameBundle& last = *station.got.back();
  EXPECT_EQ(last.stereo, nullptr);
  ASSERT_TRUE(last.arrival.left_alone);
  EXPECT_LT(SecondsBetween(*last.arrival.left_alone, last.time), 0.35);
  EXPECT_FALSE(last.arrival.right_alone);
}

TEST(LiveBundles, APoseWhoseNumbersAreNoneIsCounted) {
  Station station;
  Vehicle vehicle;
  Fly(station, vehicle, 0, 50);
  vehicle.numbers = false;
  Fly(station, vehicle, 50, 61);
  EXPECT_TRUE(station.got.back()->poses.empty());
  EXPECT_GE(station.got.back()->arrival.poses_invalid, 4);
}

/// A source whose clock runs on by a millisecond each time that it is asked.
struct BusySource {
  std::shared_ptr<Bus> bus = *Bus::Open("memq://");
  double now_s = 100;
  std::unique_ptr<LcmSource> source =
      *LcmSource::Create(bus, {}, {.now_s = [this] { return now_s += 0.001; }});
};

// A flood must not keep what is ready from the reader.
TEST(LcmSource, GivesABundleOnInAFlood) {
  BusySource busy;
  Vehicle vehicle;
  for (int tick = 0; tick < 1500; ++tick) {
    for (const WireMessage& message : vehicle.Send(tick)) {
      ASSERT_TRUE(busy.bus->Publish(message).ok());
    }
  }
  ASSERT_TRUE(busy.source->Next({}).ok());
  EXPECT_LT(busy.now_s, 100.3) << "not all of it was read";
}

TEST(LcmSource, StopsInTheMidstOfAFlood) {
  BusySource busy;
  Vehicle vehicle;
  std::stop_source stop;
  const std::string channel = ChannelNames{}.vehicle_pose;
  int heard = 0;
  ASSERT_TRUE(busy.bus
                  ->Subscribe(channel,
                              [&](const WireMessage&) {
                                if (++heard == 5) {
                                  stop.request_stop();
                                }
                              },
                              {})
                  .ok());
  for (int tick = 0; tick < 1000; ++tick) {
    for (const WireMessage& message : vehicle.Send(tick)) {
      if (message.channel == channel) {
        ASSERT_TRUE(busy.bus->Publish(message).ok());
      }
    }
  }
  (void)busy.source->Next(stop.get_token());
  EXPECT_EQ(heard, 5);
}

// The source on a bus in memory, with times of our own: a stall of its loop is named, and what
// waited meanwhile is read before silence is told.
TEST(LcmSource, NamesAStallOfItsOwnLoop) {
  const auto bus = Bus::Open("memq://");
  ASSERT_TRUE(bus.ok());
  double now_s = 100;
  auto source = LcmSource::Create(*bus, {}, {.now_s = [&] { return now_s; }});
  ASSERT_TRUE(source.ok());
  Vehicle vehicle;
  int tick = 0;
  const auto send = [&](int ticks) {
    for (const int end = tick + ticks; tick < end; ++tick) {
      for (const WireMessage& message : vehicle.Send(tick)) {
        ASSERT_TRUE((*bus)->Publish(message).ok());
      }
    }
  };
  for (int i = 0; i < 30; ++i) {
    send(5);
    now_s = 100 + 0.02 * (tick - 1);
    const auto got = (*source)->Next({});
    ASSERT_TRUE(got.ok());
    EXPECT_EQ((*got)->arrival.clock->stalled_s, 0) << i;
  }
  send(40);  // 0.8 s in which our thread is not run
  now_s = 100 + 0.02 * (tick - 1);
  const auto got = (*source)->Next({});
  ASSERT_TRUE(got.ok());
  EXPECT_NEAR((*got)->arrival.clock->stalled_s, 0.8, 1e-6);
  EXPECT_EQ((*got)->arrival.clock->stepped_s, 0);
  EXPECT_FALSE((*got)->discontinuity);
  EXPECT_LE(SecondsBetween((*got)->poses.back().time, (*got)->time), 0.1);
}

// A process is stopped most often while it waits for a message: the first that it reads then comes
// before the loop turns, and all that queued is seconds late.
TEST(LcmSource, AStallWhileItWaitsIsNoStepOfTheVehiclesClock) {
  for (const double stall_s : {1.0, 3.0, 6.0}) {
    SCOPED_TRACE(stall_s);
    const auto bus = Bus::Open("memq://");
    ASSERT_TRUE(bus.ok());
    double now_s = 100, before_s = 0;
    bool stops = false;
    const auto clock = [&] { return std::exchange(stops, false) ? before_s : now_s; };
    auto source = LcmSource::Create(*bus, {}, {.now_s = clock});
    ASSERT_TRUE(source.ok());
    Vehicle vehicle;
    int tick = 0;
    double stalled_s = 0, stepped_s = 0;
    const auto fly = [&](int ticks, bool queued) {
      for (const int end = tick + ticks; tick < end; ++tick) {
        // Of what comes meanwhile the receiver keeps the oldest third.
        for (const WireMessage& message : vehicle.Send(tick)) {
          if (!queued || end - tick > 2 * ticks / 3) {
            ASSERT_TRUE((*bus)->Publish(message).ok());
          }
        }
      }
      before_s = std::exchange(now_s, 100 + 0.02 * (tick - 1));
      stops = queued;
      const auto got = (*source)->Next({});
      ASSERT_TRUE(got.ok());
      stalled_s += (*got)->arrival.clock->stalled_s;
      stepped_s += std::abs((*got)->arrival.clock->stepped_s);
      EXPECT_FALSE((*got)->discontinuity && tick > 20);
    };
    for (int i = 0; i < 60; ++i) {
      fly(5, false);
    }
    fly(static_cast<int>(stall_s / 0.02), true);
    for (int i = 0; i < 60; ++i) {
      fly(5, false);
    }
    EXPECT_NEAR(stalled_s, stall_s, 0.15);
    EXPECT_EQ(stepped_s, 0);
  }
}

}  // namespace
}  // namespace palace
