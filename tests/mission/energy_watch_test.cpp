// What the vehicle still has to fly with: a rate is told once it is known, and no sooner.
#include "engine/mission/watch/energy_watch.h"

#include <cmath>

#include <gtest/gtest.h>

#include "engine/core/random.h"

namespace palace {
namespace {

Timestamp At(double seconds) { return AddSeconds(Timestamp{}, seconds); }

/// Ten words a second of a vehicle that flies `endurance_s` on what it holds.
struct Flight {
  EnergyWatch watch;
  double flown_s = 0;
  double endurance_s = 1800;
  double share = 1;

  void FlyFor(double seconds, const auto& gauge) {
    for (const double until_s = flown_s + seconds; flown_s < until_s; flown_s += 0.1) {
      share -= 0.1 / endurance_s;
      watch.Update(gauge(share), At(1000 + flown_s));
    }
  }
  double true_left_s() const { return share * endurance_s; }
};

const auto kExact = [](double share) { return share; };

TEST(EnergyWatch, TellsTheRateOnceTheGaugeHasFallenByTwoPercent) {
  Flight flight;
  flight.FlyFor(35, kExact);
  EXPECT_TRUE(std::isnan(flight.watch.Left().lasts_s));
  EXPECT_NEAR(flight.watch.Left().share, 1 - 35 / 1800.0, 1e-3);
  flight.FlyFor(3, kExact);
  EXPECT_NEAR(flight.watch.Left().lasts_s, flight.true_left_s(), 2);
  flight.FlyFor(900, kExact);
  EXPECT_NEAR(flight.watch.Left().lasts_s, flight.true_left_s(), 2);
}

TEST(EnergyWatch, AGaugeOfWholePercentsOrWithNoiseSaysNearlyTheSame) {
  RandomStream random(1);
  const auto percents = [](double share) { return std::floor(100 * share) / 100; };
  const auto noisy = [&](double share) { return share + 0.01 * random.Normal(); };
  const auto tells = [](const auto& gauge, double tolerance) {
    Flight flight;
    flight.FlyFor(300, gauge);
    for (int minute = 0; minute < 20; ++minute) {
      flight.FlyFor(60, gauge);
      const double off_s = flight.watch.Left().lasts_s - flight.true_left_s();
      EXPECT_LT(std::abs(off_s), tolerance * flight.true_left_s() + 25) << minute;
    }
  };
  tells(percents, 0.05);
  tells(noisy, 0.05);
}

TEST(EnergyWatch, ThatItNeverFallsIsNoRate) {
  EnergyWatch watch;
  RandomStream random(2);
  for (int i = 0; i < 4000; ++i) {
    watch.Update(0.5 + 0.002 * random.Normal(), At(i));
    ASSERT_TRUE(std::isnan(watch.Left().lasts_s)) << i;
  }
}

TEST(EnergyWatch, FollowsAFasterFallWithinItsWindow) {
  Flight flight;
  flight.FlyFor(300, kExact);
  flight.endurance_s = 900;  // twice the power from here on
  flight.FlyFor(EnergyWatch::kWindow_s, kExact);
  EXPECT_NEAR(flight.watch.Left().lasts_s, flight.true_left_s(), 3);
}

TEST(EnergyWatch, AFallAtOnceIsNoRate) {
  Flight flight;
  flight.FlyFor(20, kExact);
  flight.share = 0.09;
  flight.FlyFor(30, kExact);
  EXPECT_TRUE(std::isnan(flight.watch.Left().lasts_s));
  EXPECT_NEAR(flight.watch.Left().share, 0.075, 0.01);
}

TEST(EnergyWatch, BeginsAnewWhenItIsFilledOrTimeGoesBack) {
  Flight flight;
  flight.FlyFor(300, kExact);
  flight.share = 1;
  flight.FlyFor(1, kExact);
  EXPECT_TRUE(std::isnan(flight.watch.Left().lasts_s));
  flight.FlyFor(100, kExact);
  EXPECT_NEAR(flight.watch.Left().lasts_s, flight.true_left_s(), 2);
  flight.flown_s = 0;
  flight.FlyFor(1, kExact);
  EXPECT_TRUE(std::isnan(flight.watch.Left().lasts_s));
}

TEST(EnergyWatch, WhatIsNotToldIsUnknown) {
  Flight flight;
  flight.FlyFor(100, kExact);
  flight.watch.Update(NAN, At(1101));
  EXPECT_TRUE(std::isnan(flight.watch.Left().share));
  EXPECT_TRUE(std::isnan(flight.watch.Left().lasts_s));
  EXPECT_TRUE(std::isnan(EnergyWatch().Left().share));
}

TEST(EnergyWatch, AnEmptyTankLastsNoTime) {
  Flight flight;
  flight.share = 0.05;
  flight.FlyFor(90, kExact);  // as far as the gauge goes
  const auto empty = [](double) { return 0.0; };
  flight.FlyFor(60, empty);
  EXPECT_GE(flight.watch.Left().lasts_s, 0);
  EXPECT_LT(flight.watch.Left().lasts_s, 30);
}

}  // namespace
}  // namespace palace
