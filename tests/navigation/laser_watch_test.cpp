#include "engine/navigation/laser_watch.h"

#include <gtest/gtest.h>

#include "engine/core/random.h"

namespace palace {
namespace {

using State = LaserHealth::State;

/// A hover or a descent over level ground, with a laser at 20 Hz and stereo at 10 Hz.
struct Case {
  double climb_mps = 0;
  double noise_m = 0.045;
  double quantum_m = 0.01;
  double sway_m = 0.05;
  double laser_factor = 1;   ///< after the fault
  double stereo_factor = 1;  ///< all the time
  bool stuck = false, silent = false;
  double spike_share = 0;
  bool sees_stereo = true;
  double step_m = 0;  ///< the ground under both steps by so much
  double from_s = 5;
};

struct Told {
  State state = State::kNever;
  double after_s = NAN;  ///< first word of a fault, from the fault on
  LaserHealth last;
  int faults_before = 0;
};

Told Fly(const Case& c, std::uint64_t seed = 1, double seconds = 10) {
  RandomStream random(seed, "laser");
  LaserWatch watch;
  Told told;
  constexpr double kDown = 0.7071;
  double stuck_m = NAN;
  for (int n = 1; n <= static_cast<int>(20 * seconds); ++n) {
    const double t = 0.05 * n;
    const bool fault = t >= c.from_s;
    const double height_m = 15 + c.climb_mps * t + c.sway_m * std::sin(1.3 * t);
    const double ground_m = fault ? c.step_m : 0;
    const BeamPose beam{height_m, kDown};
    const double true_m = (height_m - ground_m) / kDown;
    double range_m = true_m + c.noise_m * random.Normal();
    range_m = std::round(range_m / c.quantum_m) * c.quantum_m;
    range_m *= fault ? c.laser_factor : 1;
    range_m += random.Uniform() < c.spike_share && fault ? 20 : 0;
    if (c.stuck && fault) {
      stuck_m = std::isnan(stuck_m) ? range_m : stuck_m;
      range_m = stuck_m;
    }
    if (!(c.silent && fault)) {
      watch.AddRange({AddSeconds({}, t), range_m}, beam);
    }
    watch.Update(AddSeconds({}, t));
    if (n % 2 == 0 && c.sees_stereo) {
      watch.AddStereo(AddSeconds({}, t), c.stereo_factor * true_m * (1 + 0.005 * random.Normal()),
                      beam);
    }
    const bool bad = watch.status().state != State::kFine;
    told.faults_before += bad && !fault ? 1 : 0;
    if (bad && fault && std::isnan(told.after_s)) {
      told.after_s = t - c.from_s;
      told.state = watch.status().state;
    }
  }
  told.last = watch.status();
  return told;
}

struct Row {
  const char* name;
  Case flight;
  State state;  ///< kFine: never a word
  double within_s;
};

class Lasers : public testing::TestWithParam<Row> {};

TEST_P(Lasers, AreToldRightlyAndInTime) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Told told = Fly(GetParam().flight, seed);
    EXPECT_EQ(told.faults_before, 0) << seed;
    if (GetParam().state == State::kFine) {
      EXPECT_TRUE(std::isnan(told.after_s)) << seed << ", state " << int(told.state);
      continue;
    }
    EXPECT_EQ(told.state, GetParam().state) << seed;
    EXPECT_LE(told.after_s, GetParam().within_s) << seed;
    EXPECT_EQ(told.last.state, GetParam().state) << "it stands, seed " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Table, Lasers,
    testing::Values(
        Row{"Hover", {}, State::kFine, 0}, Row{"Descent", {.climb_mps = -1}, State::kFine, 0},
        Row{"Lost", {.silent = true}, State::kLost, 0.61},
        Row{"StuckInHover", {.stuck = true}, State::kStuck, 1},
        Row{"StuckInDescent", {.climb_mps = -1, .stuck = true}, State::kStuck, 1},
        Row{"CoarseButAlive", {.noise_m = 0.01, .quantum_m = 0.5, .sway_m = 0.1}, State::kFine, 0},
        Row{"CoarseAndStuck",
            {.climb_mps = -1, .noise_m = 0.01, .quantum_m = 0.1, .stuck = true},
            State::kStuck,
            1.2},
        Row{"Halved", {.laser_factor = 0.5}, State::kWrong, 0.4},
        Row{"Doubled", {.laser_factor = 2}, State::kWrong, 0.4},
        Row{"HalvedInDescent", {.climb_mps = -1, .laser_factor = 0.5}, State::kWrong, 0.4},
        Row{"HalvedFromTheStart",
            {.climb_mps = -1, .laser_factor = 0.5, .from_s = 0},
            State::kWrong,
            3},
        Row{"Spikes", {.spike_share = 0.05}, State::kFine, 0},
        Row{"AnEdgeThatStereoSeesToo", {.step_m = 4}, State::kFine, 0},
        Row{"AnEdgeWithoutStereo", {.sees_stereo = false, .step_m = 4}, State::kFine, 0},
        Row{"StereoWrong", {.climb_mps = -1, .stereo_factor = 1.12}, State::kFine, 0}),
    [](const auto& row) { return std::string(row.param.name); });

TEST(LaserWatch, TellsTheRatioAndForgivesWhatAgreesAgain) {
  EXPECT_NEAR(Fly({.laser_factor = 0.5}).last.ratio, 0.5, 0.05);
  LaserWatch watch;
  const BeamPose beam{15, 1};
  for (int n = 0; n < 200; ++n) {
    const double t = 0.05 * n;
    const bool halved = t > 4 && t < 6;
    watch.AddRange({AddSeconds({}, t), (halved ? 7.5 : 15) + 0.01 * (n % 3)}, beam);
    watch.Update(AddSeconds({}, t));
    watch.AddStereo(AddSeconds({}, t), 15, beam);
    EXPECT_EQ(watch.usable(), t <= 4 || t > 6.3 || watch.usable()) << t;
  }
  EXPECT_EQ(watch.status().state, State::kFine);
}

TEST(LaserWatch, WithoutAReturnThereIsNothingToLose) {
  LaserWatch watch;
  watch.AddRange({{100}, NAN}, {15, 1});
  watch.Update({9'000'000});
  EXPECT_EQ(watch.status().state, State::kNever);
}

}  // namespace
}  // namespace palace
