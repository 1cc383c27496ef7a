// The vehicle's clock from one-way messages: what is believed, what is refused, what is a step.
#include "engine/core/vehicle_clock.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "engine/core/random.h"

namespace palace {
namespace {

using Heard = VehicleClock::Heard;

/// A sender whose clock reads offset + (1 + drift) t, and a link that delays.
struct Link {
  double offset_s = 1000;
  double drift = 0;
  double delay_s = 0.003;
  double jitter_s = 0;  ///< mean of an exponential
  double loss = 0;

  Timestamp Stamp(double sent_s) const { return AddSeconds({}, offset_s + sent_s * (1 + drift)); }
};

struct Message {
  double arrival_s;
  Timestamp stamp;
};

/// Poses at 50 Hz, in order of arrival.
std::vector<Message> Send(const Link& link, RandomStream& random, double from_s, double to_s) {
  std::vector<Message> messages;
  for (double t = from_s; t < to_s; t += 0.02) {
    const double delay_s = link.delay_s - link.jitter_s * std::log(1 - random.Uniform());
    if (random.Uniform() >= link.loss) {
      messages.push_back({t + delay_s, link.Stamp(t)});
    }
  }
  std::sort(messages.begin(), messages.end(),
            [](const Message& a, const Message& b) { return a.arrival_s < b.arrival_s; });
  return messages;
}

/// How many were refused; checks that none is taken for a step.
int Feed(VehicleClock& clock, const std::vector<Message>& messages) {
  int refused = 0;
  for (const Message& m : messages) {
    const Heard heard = clock.Hear(m.stamp, m.arrival_s, true);
    EXPECT_NE(heard, Heard::kStepped) << "at " << m.arrival_s;
    refused += heard == Heard::kFits ? 0 : 1;
  }
  return refused;
}

double ErrorAt(const VehicleClock& clock, const Link& link, double station_s) {
  return SecondsBetween(link.Stamp(station_s), clock.At(station_s));
}

TEST(VehicleClock, FollowsTheLeastDelayOfALink) {
  struct Row {
    const char* name;
    Link link;
    double error_s;  ///< beyond the least delay
  };
  for (const Row& row :
       {Row{"quiet", {}, 0.001}, Row{"gains 100 ppm", {.drift = 100e-6}, 0.001},
        Row{"loses 100 ppm", {.drift = -100e-6}, 0.001},
        Row{"jitter of 20 ms", {.jitter_s = 0.02}, 0.004},
        Row{"jitter of 100 ms", {.jitter_s = 0.1}, 0.02},
        Row{"half is lost", {.jitter_s = 0.02, .loss = 0.5}, 0.006},
        Row{"all of it", {.drift = -100e-6, .jitter_s = 0.05, .loss = 0.3}, 0.02}}) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      SCOPED_TRACE(std::string(row.name) + ", seed " + std::to_string(seed));
      RandomStream random(seed);
      VehicleClock clock;
      EXPECT_TRUE(clock.estimating());
      EXPECT_EQ(Feed(clock, Send(row.link, random, 0, 120)), 0);
      EXPECT_FALSE(clock.estimating());
      // Never ahead of the vehicle's clock: a message takes time.
      const double error_s = ErrorAt(clock, row.link, 120);
      EXPECT_LE(error_s, 0);
      EXPECT_GE(error_s, -row.link.delay_s - row.error_s);
      if (row.link.jitter_s < 0.1) {
        EXPECT_NEAR(clock.drift_ppm(), 1e6 * row.link.drift, 400 * row.error_s * 100);
      }
    }
  }
}

TEST(VehicleClock, AStepIsToldWithItsSizeAndFollowed) {
  for (const double step_s : {5.0, -5.0, 0.6, -0.6, 86400.0, -86400.0, -1e6}) {
    SCOPED_TRACE(step_s);
    RandomStream random(7);
    Link link{.jitter_s = 0.01};
    VehicleClock clock;
    EXPECT_EQ(Feed(clock, Send(link, random, 0, 10)), 0);
    link.offset_s += step_s;
    int steps = 0;
    double told_s = 0;
    for (const Message& m : Send(link, random, 10.2, 15)) {
      if (clock.Hear(m.stamp, m.arrival_s, true) == Heard::kStepped) {
        ++steps;
        told_s = m.arrival_s - 10.2;
        EXPECT_TRUE(clock.estimating());
      }
    }
    EXPECT_EQ(steps, 1);
    EXPECT_LT(told_s, 0.4);
    EXPECT_NEAR(clock.step_s(), step_s, 0.05);
    EXPECT_NEAR(ErrorAt(clock, link, 15), 0, 0.02);
  }
}

// A restart: the sender's clock begins again at some small number.
TEST(VehicleClock, StampsAtTheEndsOfTheRangeAreRefused) {
  using Range = std::numeric_limits<std::int64_t>;
  RandomStream random(8);
  const Link link;
  VehicleClock clock;
  Feed(clock, Send(link, random, 0, 5));
  for (const std::int64_t us : {Range::min(), std::int64_t{-1}, std::int64_t{0}, std::int64_t{1},
                                std::int64_t{1} << 62, Range::max()}) {
    EXPECT_NE(clock.Hear({us}, 5.0, true), Heard::kFits) << us;
  }
  EXPECT_EQ(Feed(clock, Send(link, random, 5.01, 6)), 0);
  EXPECT_NEAR(ErrorAt(clock, link, 6), 0, 0.01);
}

// Forged messages among true ones: the true ones are believed throughout, however many are forged.
TEST(VehicleClock, ForgedStampsAmongTrueOnesMoveNothing) {
  for (const double ahead_s : {0.06, 0.3, 9.9, 3600.0, -11.0, -3600.0}) {
    SCOPED_TRACE(ahead_s);
    RandomStream random(9);
    const Link link{.jitter_s = 0.002};
    VehicleClock clock;
    Feed(clock, Send(link, random, 0, 10));
    int refused = 0, forged = 0;
    for (const Message& m : Send(link, random, 10, 20)) {
      for (int i = 0; i < 5; ++i, ++forged) {
        const Timestamp stamp = AddSeconds(link.Stamp(m.arrival_s), ahead_s);
        refused += clock.Hear(stamp, m.arrival_s, true) == Heard::kFits ? 0 : 1;
      }
      EXPECT_EQ(clock.Hear(m.stamp, m.arrival_s, true), Heard::kFits);
    }
    EXPECT_EQ(refused, forged);
    EXPECT_NEAR(ErrorAt(clock, link, 20), 0, 0.01);
  }
}

// A channel that does not vote moves nothing while the others fit.
TEST(VehicleClock, OnlyPoseAndStatusMoveTheClock) {
  RandomStream random(10);
  const Link link;
  VehicleClock clock;
  Feed(clock, Send(link, random, 0, 5));
  for (const Message& m : Send(link, random, 5, 30)) {
    EXPECT_EQ(clock.Hear(m.stamp, m.arrival_s, true), Heard::kFits);
    EXPECT_EQ(clock.Hear(AddSeconds(m.stamp, 7), m.arrival_s, false), Heard::kAhead);
  }
}

// A stamp just inside of the limit fits. Followed, the next one may be as far ahead of it, and so
// on.
TEST(VehicleClock, StampsThatFitDoNotWalkTheClock) {
  for (const bool simulated : {false, true}) {
    SCOPED_TRACE(simulated);
    RandomStream random(13);
    const Link link;
    VehicleClock clock;
    clock.FollowSimulation(simulated);
    Feed(clock, Send(link, random, 0, 5));
    const double ahead_s = simulated ? 0.49 : 0.049;
    for (const Message& m : Send(link, random, 5, 30)) {
      EXPECT_EQ(clock.Hear(m.stamp, m.arrival_s, true), Heard::kFits);
      for (int i = 0; i < 3; ++i) {
        const Timestamp walked = AddSeconds(clock.At(m.arrival_s), ahead_s);
        EXPECT_EQ(clock.Hear(walked, m.arrival_s, false), Heard::kFits);
        EXPECT_TRUE(clock.CanBe(walked, m.arrival_s));
      }
    }
    EXPECT_NEAR(ErrorAt(clock, link, 30), 0, 0.01);
  }
}

// Whoever spoke first may have said anything: the first vote decides.
TEST(VehicleClock, TheFirstVoteBeginsAnew) {
  for (const double ahead_s : {0.2, 0.45, -0.2, -5.0, 3600.0}) {
    SCOPED_TRACE(ahead_s);
    RandomStream random(14);
    const Link link;
    VehicleClock clock;
    clock.Hear(AddSeconds(link.Stamp(0), ahead_s), 0, false);
    int steps = 0;
    for (const Message& m : Send(link, random, 0, 2)) {
      steps += clock.Hear(m.stamp, m.arrival_s, true) == Heard::kStepped ? 1 : 0;
    }
    EXPECT_EQ(steps, std::abs(ahead_s) > 0.25 ? 1 : 0);
    EXPECT_NEAR(ErrorAt(clock, link, 2), 0, 0.01);
  }
}

// What queued while this machine stood still comes in one burst: late, and nothing else.
TEST(VehicleClock, ABurstAfterAStallIsNoStep) {
  for (const double stall_s : {0.4, 0.8, 3.0, 9.0}) {
    SCOPED_TRACE(stall_s);
    RandomStream random(11);
    const Link link{.jitter_s = 0.005};
    VehicleClock clock;
    StallWatch watch;
    double stalled_s = 0;
    for (const Message& m : Send(link, random, 0, 60)) {
      const bool queued = m.arrival_s > 30 && m.arrival_s < 30 + stall_s;
      const double taken_s = queued ? 30 + stall_s : m.arrival_s;
      stalled_s += watch.Turn(taken_s);
      EXPECT_EQ(clock.Hear(m.stamp, taken_s, true), Heard::kFits) << taken_s;
    }
    EXPECT_NEAR(stalled_s, stall_s, 0.1);
    EXPECT_NEAR(ErrorAt(clock, link, 60), 0, 0.01);
  }
}

// Of a queue that is too short the newest is lost, and a simulation's clock may fall behind: still
// nothing stepped.
TEST(VehicleClock, AShortQueueAfterAStallIsNoStepEvenOfASimulation) {
  for (const double stall_s : {0.4, 1.0, 3.0, 9.0}) {
    SCOPED_TRACE(stall_s);
    RandomStream random(13);
    const Link link{.jitter_s = 0.005};
    VehicleClock clock;
    clock.FollowSimulation(true);
    bool stood = false;
    for (const Message& m : Send(link, random, 0, 60)) {
      const bool during = m.arrival_s > 30 && m.arrival_s < 30 + stall_s;
      if (during && m.arrival_s > 30 + 0.4 * stall_s) {
        continue;
      }
      if (during && !std::exchange(stood, true)) {
        clock.Stalled(stall_s, 30 + stall_s);
      }
      EXPECT_NE(clock.Hear(m.stamp, during ? 30 + stall_s : m.arrival_s, true), Heard::kStepped)
          << m.arrival_s;
    }
    EXPECT_NEAR(ErrorAt(clock, link, 60), 0, 0.1);
  }
}

// A link that slows down shows as age: the estimate does not follow it. What stays for ten seconds
// cannot be told from a clock that stood still, and is named.
TEST(VehicleClock, ADelayIsAgeUntilItStays) {
  RandomStream random(12);
  Link link{.jitter_s = 0.005};
  VehicleClock clock;
  Feed(clock, Send(link, random, 0, 20));
  link.delay_s += 0.5;
  int steps = 0;
  for (const Message& m : Send(link, random, 20, 40)) {
    const Heard heard = clock.Hear(m.stamp, m.arrival_s, true);
    EXPECT_TRUE(heard == Heard::kFits || heard == Heard::kStepped);
    if (m.arrival_s < 29) {
      EXPECT_NEAR(SecondsBetween(m.stamp, clock.At(m.arrival_s)), 0.5, 0.06);
    }
    steps += heard == Heard::kStepped ? 1 : 0;
  }
  EXPECT_EQ(steps, 1);
  EXPECT_NEAR(clock.step_s(), -0.5, 0.03);
  EXPECT_NEAR(ErrorAt(clock, link, 40), -0.5, 0.03);
}

// A simulation on a busy computer runs slow: its clock is followed at any pace, and stalls of it
// are no steps; a real step is.
TEST(VehicleClock, TheClockOfASimulationKeepsThePaceOfItsComputer) {
  for (const double pace : {0.3, 0.6, 1.0}) {
    SCOPED_TRACE(pace);
    VehicleClock clock;
    clock.FollowSimulation(true);
    double station_s = 50, simulated_s = 0;
    for (int i = 0; i < 400; ++i) {
      simulated_s += 0.1;
      station_s += 0.1 / pace + (i % 50 == 49 ? 0.7 : 0);
      EXPECT_EQ(clock.Hear(AddSeconds({}, simulated_s), station_s, true), Heard::kFits);
      EXPECT_LT(std::abs(SecondsBetween(AddSeconds({}, simulated_s), clock.At(station_s))), 0.25);
    }
    int steps = 0;
    for (int i = 0; i < 10; ++i) {
      simulated_s += 0.1;
      station_s += 0.1 / pace;
      steps += clock.Hear(AddSeconds({}, simulated_s + 5), station_s, true) == Heard::kStepped;
    }
    EXPECT_EQ(steps, 1);
    EXPECT_NEAR(clock.step_s(), 5, 0.3);
  }
}

// A busy computer runs the simulation slow and this station in bursts: both at once are no step.
TEST(VehicleClock, ASlowSimulationIsFollowedThroughStallsAgainAndAgain) {
  for (const double pace : {0.3, 0.5}) {
    SCOPED_TRACE(pace);
    VehicleClock clock;
    clock.FollowSimulation(true);
    StallWatch watch;
    double sent = 0;
    for (double turn_s = 50; turn_s < 150; turn_s += 0.5) {  // each of them is a stall
      if (const double stall_s = watch.Turn(turn_s); stall_s > 0) {
        clock.Stalled(stall_s, turn_s);
      }
      for (; 50 + sent / pace <= turn_s; sent += 0.02) {
        ASSERT_EQ(clock.Hear(AddSeconds({}, 1000 + sent), turn_s, true), Heard::kFits) << turn_s;
      }
      EXPECT_LT(SecondsBetween(AddSeconds({}, 1000 + sent), clock.At(turn_s)), 1) << turn_s;
    }
  }
}

TEST(StallWatch, TellsGapsOfTheLoopThatIsNeverLong) {
  StallWatch watch;
  EXPECT_EQ(watch.Turn(100), 0);
  EXPECT_EQ(watch.Turn(100.02), 0);
  EXPECT_EQ(watch.Turn(100.25), 0);
  EXPECT_NEAR(watch.Turn(101.05), 0.8, 1e-9);
  EXPECT_EQ(watch.Turn(101.07), 0);
}

}  // namespace
}  // namespace palace
