#include "engine/faults/faulted_source.h"

#include <gtest/gtest.h>

#include "engine/simulation/session.h"
#include "tests/faults/fault_rig.h"

namespace palace {
namespace {

/// The simulator without pictures, for `bundles` bundles, under faults.
std::vector<std::shared_ptr<const FrameBundle>> Flown(const std::vector<Fault>& faults,
                                                      std::uint64_t seed, int bundles = 30) {
  const SimulatedSession session =
      OpenSimulatedSession({.seed = 4, .wind_mps = 4, .render = false}, nullptr).value();
  FaultedSource source(session.simulator, session.simulator, seed);
  for (const Fault& fault : faults) {
    EXPECT_TRUE(source.Add(fault));
  }
  std::vector<std::shared_ptr<const FrameBundle>> flown;
  for (int i = 0; i < bundles; ++i) {
    flown.push_back(source.Next({}).value());
  }
  return flown;
}

void ExpectSame(const FrameBundle& a, const FrameBundle& b) {
  EXPECT_EQ(a.time, b.time);
  EXPECT_EQ(a.sequence, b.sequence);
  EXPECT_EQ(a.discontinuity, b.discontinuity);
  ASSERT_EQ(a.poses.size(), b.poses.size());
  for (std::size_t i = 0; i < a.poses.size(); ++i) {
    EXPECT_EQ(a.poses[i].time, b.poses[i].time);
    EXPECT_EQ(a.poses[i].X_WB.R, b.poses[i].X_WB.R);
    EXPECT_EQ(a.poses[i].X_WB.p, b.poses[i].X_WB.p);
  }
  ASSERT_EQ(a.imu.size(), b.imu.size());
  for (std::size_t i = 0; i < a.imu.size(); ++i) {
    EXPECT_EQ(a.imu[i].specific_force_B, b.imu[i].specific_force_B);
  }
  ASSERT_EQ(a.gps.size(), b.gps.size());
  ASSERT_EQ(a.laser.size(), b.laser.size());
  ASSERT_EQ(a.pose_at_exposure.has_value(), b.pose_at_exposure.has_value());
  ASSERT_EQ(a.status.has_value(), b.status.has_value());
  ASSERT_EQ(a.stereo == nullptr, b.stereo == nullptr);
  if (a.stereo) {
    EXPECT_EQ(a.stereo->left.pixels(), b.stereo->left.pixels());
    EXPECT_EQ(a.stereo->right.pixels(), b.stereo->right.pixels());
  }
}

TEST(FaultedSource, WithoutFaultsGivesTheBundlesOfTheSourceToTheBit) {
  const SimulatedSession session =
      OpenSimulatedSession({.seed = 4, .wind_mps = 4, .render = false}, nullptr).value();
  const auto through = Flown({}, 1);
  for (const auto& bundle : through) {
    ExpectSame(*bundle, *session.simulator->Next({}).value());
  }
  FaultedSource pictures(std::make_shared<BundlesOfEverything>(5), nullptr, 1);
  for (int i = 0; i < 5; ++i) {
    ExpectSame(*pictures.Next({}).value(), BundleOfEverything(i));
  }
  EXPECT_EQ(pictures.Next({}).error().code, ErrorCode::kEnd);
}

TEST(FaultedSource, UntilAFaultIsAddedTheSourcesOwnBundlesComeOut) {
  struct Kept final : Source {
    BundlesOfEverything source{10};
    std::shared_ptr<const FrameBundle> newest;
    Result<std::shared_ptr<const FrameBundle>> Next(std::stop_token stop) override {
      auto next = source.Next(stop);
      newest = next ? *next : nullptr;
      return next;
    }
    bool IsLockstep() const override { return true; }
    ::palace::SourceStatus Status() const override { return {}; }
    void Control(const PlaybackControl&) override {}
  };
  const auto kept = std::make_shared<Kept>();
  FaultedSource source(kept, nullptr, 1);
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(source.Next({}).value(), kept->newest) << "not even a copy";
  }
  ASSERT_TRUE(source.Add({.kind = FaultKind::kGpsJump}));
  const auto struck = source.Next({}).value();
  EXPECT_EQ(struck->sequence, 6u);
  EXPECT_FALSE(struck->discontinuity);
  EXPECT_NEAR(struck->gps[0].p_WB.x(), BundleOfEverything(5).gps[0].p_WB.x() + 8, 1e-9);
}

TEST(FaultedSource, TellsWhatActsFromItsFirstBundleToItsLast) {
  FaultedSource source(std::make_shared<BundlesOfEverything>(10), nullptr, 1);
  ASSERT_TRUE(source.Add({.kind = FaultKind::kGpsJump, .value = 3, .from_s = 0.25, .to_s = 0.55}));
  for (int i = 0; i < 10; ++i) {
    const auto acting = source.Next({}).value()->injected_faults;
    EXPECT_EQ(acting, i >= 3 && i <= 5 ? std::vector<std::string>{"GPS jump 3 m"}
                                       : std::vector<std::string>{})
        << i;
  }
}

TEST(FaultedSource, FaultsAreAddedFromNowAndEndedWhileItFlies) {
  FaultedSource source(std::make_shared<BundlesOfEverything>(20), nullptr, 1);
  for (int i = 0; i < 5; ++i) {
    ASSERT_TRUE(source.Next({}));
  }
  const int jump = source.faults().AddFromNow({.kind = FaultKind::kGpsJump, .value = 3}).value();
  const int later =
      source.faults().AddFromNow({.kind = FaultKind::kLaserStuck, .from_s = 60}).value();
  const auto jumped = source.Next({}).value();
  EXPECT_NEAR(jumped->gps[0].p_WB.x(), BundleOfEverything(5).gps[0].p_WB.x() + 3, 1e-9);
  EXPECT_EQ(jumped->injected_faults, std::vector<std::string>{"GPS jump 3 m"});
  EXPECT_TRUE(source.faults().Faults()[0].acts);
  EXPECT_NEAR(source.faults().Faults()[1].fault.from_s, 60.4, 1e-9);
  source.faults().End(jump);
  source.faults().End(later);
  source.faults().End(99);  // there is none
  const auto after = source.Next({}).value();
  EXPECT_EQ(after->gps[0].p_WB, BundleOfEverything(6).gps[0].p_WB);
  EXPECT_TRUE(after->injected_faults.empty());
  for (const InjectedFault& fault : source.faults().Faults()) {
    EXPECT_TRUE(fault.over) << fault.number;
  }
}

TEST(FaultedSource, OneSeedAndOneListOfFaultsAreOneFlight) {
  const std::vector<Fault> faults = {
      {.kind = FaultKind::kLost, .value = 30, .from_s = 0.5},
      {.kind = FaultKind::kCorrupted, .value = 5, .from_s = 1},
      {.kind = FaultKind::kLaserSpikes, .from_s = 1},
  };
  const auto a = Flown(faults, 8), b = Flown(faults, 8);
  for (std::size_t i = 0; i < a.size(); ++i) {
    ExpectSame(*a[i], *b[i]);
  }
}

TEST(FaultedSource, SilenceGivesBundlesWithoutAnythingWhoseTimeGoesOn) {
  const auto bundles = Flown({{.kind = FaultKind::kMissing, .from_s = 1}}, 1, 20);
  const FrameBundle& last = *bundles.back();
  EXPECT_FALSE(last.stereo);
  EXPECT_FALSE(last.status);
  EXPECT_TRUE(last.poses.empty());
  EXPECT_NEAR(SecondsBetween(bundles[bundles.size() - 2]->time, last.time), 0.2, 1e-6);
}

TEST(FaultedSource, AMissingCameraLeavesABundleWithoutAPairAndCountsTheOther) {
  FaultedSource source(std::make_shared<BundlesOfEverything>(10), nullptr, 1);
  ASSERT_TRUE(source.Add({.kind = FaultKind::kMissing, .channel = ChannelId::kCameraRight}));
  for (int i = 0; i < 10; ++i) {
    EXPECT_FALSE(source.Next({}).value()->stereo);
  }
  EXPECT_EQ(source.Lost().pictures_unpaired, 10u);
}

TEST(FaultedSource, WhatCannotBeReadIsCounted) {
  FaultedSource source(std::make_shared<BundlesOfEverything>(10), nullptr, 1);
  ASSERT_TRUE(source.Add({.kind = FaultKind::kAttitudeNan}));
  for (int i = 0; i < 10; ++i) {
    EXPECT_TRUE(source.Next({}).value()->poses.empty());
  }
  EXPECT_EQ(source.Lost().undecodable.at("VEHICLE_POSE"), 50u);
}

TEST(FaultedSource, RefusesWhatCheckFaultRefuses) {
  FaultedSource source(std::make_shared<BundlesOfEverything>(1), nullptr, 1);
  EXPECT_FALSE(source.Add({.kind = FaultKind::kLost, .value = 200}));
}

struct Kept final : VehicleLink {
  std::vector<VehicleMessage> sent;
  bool Send(const VehicleMessage& message) override {
    sent.push_back(message);
    return true;
  }
};

TEST(FaultedSource, SendsEstimatesOnTheVehiclesOwnClock) {
  const auto link = std::make_shared<Kept>();
  FaultedSource source(std::make_shared<BundlesOfEverything>(5), link, 1);
  ASSERT_TRUE(source.Add({.kind = FaultKind::kClockStep, .value = 5}));
  const auto bundle = source.Next({}).value();
  PositionEstimate estimate;
  estimate.time = bundle->time;
  source.Send(estimate);
  source.Send(HoldRequest{3, "test"});
  ASSERT_EQ(link->sent.size(), 2u);
  EXPECT_EQ(std::get<PositionEstimate>(link->sent[0]).time, BundleOfEverything(0).time);
  EXPECT_EQ(std::get<HoldRequest>(link->sent[1]).command_id, 3u);
}

}  // namespace
}  // namespace palace
