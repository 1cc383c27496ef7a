// Turns over 4 s by rates and attitude: told of a sound vehicle, and never made of a fault of one.
#include "engine/navigation/rate_attitude.h"

#include <algorithm>
#include <deque>
#include <functional>
#include <string>

#include <gtest/gtest.h>

#include "tests/navigation/flight.h"

namespace palace {
namespace {

constexpr double kOver_s = 4;
constexpr double kFrom_s = 10;
constexpr double kRate_hz = 50;

/// What is wrong t seconds after kFrom_s.
struct Wrong {
  const char* name = "nothing";
  std::function<double(double)> roll_deg = [](double) { return 0.0; };  ///< of the attitude
  double rate_deg_s = 0;                                                ///< of the rate of roll
  double heading_deg = 0;                                               ///< of the attitude
};

struct Told {
  double worst_deg = 0;  ///< any turn within 4 s that was told, against the true one
  int before = 0, soon = 0,
      late = 0;  ///< poses at which it was told: before, 0 to 20, 40 to 50 s after
};

Told Fly(const Wrong& wrong, std::uint64_t seed = 1) {
  struct Turn {
    double t;
    Eigen::Matrix3d told, truth;
  };
  RandomStream random(seed, "attitude");
  const Flight flight;
  RateAttitude attitude;
  std::deque<Turn> turns;
  Told told;
  for (int k = 0; k < 60 * kRate_hz; ++k) {
    const double t = k / kRate_hz, after_s = t - kFrom_s;
    VehiclePose pose = flight.Pose(t);
    const Eigen::Matrix3d truth = pose.X_WB.R;
    const Eigen::Vector3d noise = NormalVector(random, Rad(0.1));
    pose.X_WB.R = truth * RotationFromEuler({noise.x(), noise.y(), noise.z()});
    if (after_s >= 0) {
      pose.X_WB.R = RotationFromEuler({0, 0, Rad(wrong.heading_deg)}) * pose.X_WB.R *
                    RotationFromEuler({Rad(wrong.roll_deg(after_s)), 0, 0});
      pose.angular_rate_B.x() += Rad(wrong.rate_deg_s);
    }
    attitude.Add(pose);
    const auto R_WB = attitude.At(pose.time, kOver_s);
    if (!R_WB) {
      continue;
    }
    told.before += after_s < 0 ? 1 : 0;
    told.soon += after_s >= 0 && after_s < 20 ? 1 : 0;
    told.late += after_s >= 40 ? 1 : 0;
    while (!turns.empty() && t - turns.front().t > kOver_s) {
      turns.pop_front();
    }
    for (const Turn& then : turns) {
      const Eigen::Matrix3d turned = then.told.transpose() * *R_WB;
      const Eigen::Matrix3d true_turn = then.truth.transpose() * truth;
      const double off = Eigen::AngleAxisd(Eigen::Matrix3d(turned * true_turn.transpose())).angle();
      told.worst_deg = std::max(told.worst_deg, Deg(off));
    }
    turns.push_back({t, *R_WB, truth});
  }
  return told;
}

TEST(RateAttitude, TellsTheTurnsOfASoundVehicleNearlyAllTheTime) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Told told = Fly({}, seed);
    EXPECT_LT(told.worst_deg, 0.1) << "less than the attitude's own noise";
    EXPECT_GT(told.before, 0.98 * (kFrom_s - kOver_s) * kRate_hz);
    EXPECT_GT(told.soon, 0.98 * 20 * kRate_hz);
  }
}

// A picture must have shifted by 12 px (0.9 deg) before one that stays is called a repeat.
TEST(RateAttitude, NoFaultOfAttitudeOrRatesAloneIsTakenForATurn) {
  const auto step = [](double deg) { return [=](double) { return deg; }; };
  const auto ramp = [](double deg_s) { return [=](double t) { return deg_s * t; }; };
  for (const Wrong& wrong :
       {Wrong{"a step of 0.4 deg", step(0.4)}, Wrong{"a step of 3 deg", step(3)},
        Wrong{"a step of -30 deg", step(-30)}, Wrong{"a drift of 0.02 deg/s", ramp(0.02)},
        Wrong{"a drift of 0.5 deg/s", ramp(0.5)},
        Wrong{"3 deg for 2 s", [](double t) { return t < 2 ? 3.0 : 0.0; }},
        Wrong{"3 deg now and then", [](double t) { return std::fmod(t, 1) < 0.5 ? 3.0 : 0.0; }},
        Wrong{"rates off by 0.02 deg/s", step(0), 0.02},
        Wrong{"rates off by 0.2 deg/s", step(0), 0.2}, Wrong{"rates off by 2 deg/s", step(0), 2}}) {
    EXPECT_LT(Fly(wrong).worst_deg, 0.7) << wrong.name;
  }
}

// A bias that stays is what the attitude is from then on.
TEST(RateAttitude, IsToldAgainWhenItHasComeToTheAttitude) {
  const Told told = Fly({.heading_deg = 3});
  EXPECT_EQ(told.soon, 0);
  EXPECT_GT(told.late, 0.9 * 10 * kRate_hz);
}

TEST(RateAttitude, AGapStartsItAnew) {
  RateAttitude attitude;
  const Flight flight;
  const auto add = [&](double from_s, double to_s) {
    for (int k = 0; from_s + k / kRate_hz < to_s; ++k) {
      attitude.Add(flight.Pose(from_s + k / kRate_hz));
    }
    return attitude.At(AddSeconds({}, to_s), kOver_s).has_value();
  };
  EXPECT_FALSE(add(0, 3.9));
  EXPECT_TRUE(add(3.9, 6));
  EXPECT_TRUE(add(6.2, 7)) << "one message in ten";
  EXPECT_FALSE(add(7.5, 11.4));
  EXPECT_TRUE(add(11.4, 11.6));
}

TEST(RateAttitude, WhatIsNoNumberAndWhatIsOlderChangesNothing) {
  RateAttitude attitude;
  const Flight flight;
  EXPECT_FALSE(attitude.At({}, 0));
  attitude.Add(flight.Pose(1));
  const Eigen::Matrix3d before = *attitude.At(AddSeconds({}, 1), 0);
  VehiclePose bad = flight.Pose(1.02);
  bad.angular_rate_B.x() = NAN;
  attitude.Add(bad);
  attitude.Add(flight.Pose(0.5));
  EXPECT_EQ(*attitude.At(AddSeconds({}, 1), 0), before);
}

}  // namespace
}  // namespace palace
