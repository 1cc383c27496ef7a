#include "engine/slad/hazards/loops/slad_loops.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include <gtest/gtest.h>

#include "engine/core/random.h"
#include "engine/slad/hazards/touchdown.h"
#include "tests/support/processor.h"

namespace palace {
namespace {

using Floats = std::vector<float>;

Floats Random(RandomStream& random, std::size_t count, double low, double high) {
  Floats values(count);
  for (float& value : values) {
    value = float(random.Uniform(low, high));
  }
  return values;
}

/// What one run of the loops leaves behind, byte by byte.
Floats Results(const SladLoops& loops, std::uint64_t seed) {
  RandomStream random(seed, "loops");
  constexpr int kMargin = kNearestReach + kLaneSlack;
  const int count = 1 + random.Index(300);
  const std::size_t size = std::size_t(count + 2 * kMargin);
  Floats all;
  const auto keep = [&](const Floats& values) {
    all.insert(all.end(), values.begin(), values.begin() + count);
  };
  const Floats a = Random(random, size, -1, 1), b = Random(random, size, -1, 1);
  const Floats c = Random(random, size, 0, 0.3), d = Random(random, size, 1e-3, 0.2);
  const float up[] = {0.1F, -0.2F, -0.97F};
  Floats slope(size), cost(size), probability(size), distance(size), most(size, -1e20F);
  loops.slope(a.data(), b.data(), up, count, slope.data());
  keep(slope);
  std::vector<unsigned char> reasons(size), measured(size, 1);
  loops.modern_verdict(
      {0.3F, 0.1F, 0.15F, 0.99F, 0.05F, 0.35F, 0.9F, seed % 2 == 0 ? 1.0F : 0.0F},
      {slope.data(), d.data(), c.data(), c.data(), d.data(), c.data() + 3, slope.data() + 1,
       b.data(), c.data() + 1, c.data() + 2, d.data(), measured.data()},
      count, {probability.data(), cost.data(), reasons.data()});
  keep(probability);
  keep(cost);
  keep(Floats(reasons.begin(), reasons.end()));
  Floats square = c;
  for (float& value : square) {
    value = std::floor(value * 40) * std::floor(value * 40);
  }
  loops.nearest_in_row(square.data() + kMargin, seed % 2 == 0 ? 0.5F : 0.0F, count, 0.15,
                       distance.data());
  keep(distance);
  Floats gap = square;
  loops.column_gaps(measured.data(), c.data(), count, gap.data());  // hazards everywhere
  keep(gap);
  loops.column_gaps(reasons.data(), d.data(), count, square.data());
  loops.square_gaps(square.data(), 0.5F, count, gap.data());
  keep(gap);
  const int offset[] = {-1, 0, 1}, half[] = {2, 3, 2};
  const float* heights[] = {a.data() + kMargin, b.data() + kMargin, c.data() + kMargin};
  Floats denoised_off(size);
  loops.disc_deviation({3, 1, offset, half, heights, heights, heights}, b.data(), c.data(),
                       d.data(), count, most.data(), denoised_off.data());
  keep(most);
  keep(denoised_off);
  Floats at_cell(size);
  const float* noises[] = {d.data() + kMargin, c.data() + kMargin, d.data() + kMargin};
  loops.steps({{heights[0], heights[1], heights[2]},
               {noises[0], noises[1], noises[2]},
               {b.data() + kMargin, a.data() + kMargin, d.data() + kMargin},
               a.data() + kMargin,
               b.data() + kMargin},
              count, most.data(), at_cell.data());
  keep(most);
  keep(at_cell);
  const Floats ones(size, 1.0F);
  const float* known = ones.data() + kMargin;
  loops.denoise({{heights[0], heights[1], heights[2]},
                 {known, known, known},
                 b.data() + kMargin,
                 a.data() + kMargin,
                 d.data() + kMargin,
                 d.data() + kMargin},
                count, most.data());
  keep(most);
  const int reach = 1 + random.Index(20);
  const int pitch = (count + kSolveRun) / kSolveRun * kSolveRun + 2 * reach + kLaneSlack;
  std::vector<double> columns(std::size_t(kMoments * pitch)),
      work(std::size_t(kSolveRun + 2 * reach));
  Floats weight = Random(random, size, 0, 1);
  std::fill(weight.begin() + count, weight.end(), 0.0F);
  std::vector<MomentRow> rows;
  for (int row = 0; row < 4; ++row) {
    rows.push_back(
        {weight.data() + row, a.data() + row, c.data() + row, double(row), row == 3 ? -1.0 : 1.0});
  }
  loops.add_moments(rows.data(), 4, -count / 2, count, pitch, columns.data() + reach);
  Floats fit[6];
  for (Floats& layer : fit) {
    layer.assign(size, 0);
  }
  loops.solve_moments(
      columns.data() + reach, pitch, reach, -count / 2, 1, count, work.data(),
      {fit[0].data(), fit[1].data(), fit[2].data(), fit[3].data(), fit[4].data(), fit[5].data()});
  for (const Floats& layer : fit) {
    keep(layer);
  }
  Floats next = weight;
  next[2] = NAN;
  const bool changed = loops.reject_outliers(
      {weight.data(), a.data(), c.data(), b.data(), d.data()}, count, next.data());
  keep(next);
  keep(Floats(size, changed ? 1.0F : 0.0F));
  return all;
}

struct Built {
  const char* name;
  const SladLoops* (*loops)();
  bool (*processor_has)();
};

class FasterLoops : public ::testing::TestWithParam<Built> {
 protected:
  void SetUp() override {
    if (GetParam().loops() == nullptr) {
      ASSERT_FALSE(GetParam().processor_has()) << "the loops were not built for it";
      GTEST_SKIP() << "runs on a processor with " << GetParam().name;
    }
  }
};

INSTANTIATE_TEST_SUITE_P(Sets, FasterLoops,
                         ::testing::Values(Built{"AVX2", Avx2SladLoops, ProcessorHasAvx2},
                                           Built{"AVX512", Avx512SladLoops, ProcessorHasAvx512}),
                         [](const auto& set) { return set.param.name; });

TEST_P(FasterLoops, GiveTheSameBits) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const Floats plain = Results(PortableSladLoops(), seed),
                 fast = Results(*GetParam().loops(), seed);
    ASSERT_EQ(std::memcmp(plain.data(), fast.data(), plain.size() * sizeof(float)), 0)
        << "seed " << seed;
  }
}

TEST_P(FasterLoops, PutTheGearDownWithTheSameBits) {
  for (const LandingGear kind : {LandingGear::kSkids, LandingGear::kPads}) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      RandomStream random(seed, "gear");
      const int cols = 20 + random.Index(150);  // whole groups of lanes, and rests of one
      GridF height(40, cols);
      for (float& z : height.cells()) {
        z = float(random.Uniform(0, 0.3));
      }
      Lander lander;
      lander.gear = kind;
      lander.gear_length_m = random.Uniform(0.2, 2.4);
      Floats tilt[2], rise[2];
      for (int k = 0; k < 2; ++k) {
        tilt[k].resize(std::size_t(cols));
        rise[k].resize(std::size_t(cols));
        const GearOverMap gear(height, 0.15, lander,
                               k == 0 ? PortableSladLoops() : *GetParam().loops());
        gear.WorstOfRow(20, tilt[k].data(), rise[k].data());
      }
      ASSERT_EQ(std::memcmp(tilt[0].data(), tilt[1].data(), std::size_t(cols) * sizeof(float)), 0)
          << seed;
      ASSERT_EQ(std::memcmp(rise[0].data(), rise[1].data(), std::size_t(cols) * sizeof(float)), 0)
          << seed;
    }
  }
}

/// Largest squared step by the rule itself, cell by cell.
TEST(SladLoops, StepsAreTheLargestBetweenNeighbours) {
  RandomStream random(5, "steps");
  constexpr int kCount = 37, kWide = kCount + 2 + kLaneSlack;
  Floats height[3], noise2[3], plane[3];
  for (int r = 0; r < 3; ++r) {
    height[r] = Random(random, kWide, -0.3, 0.3);
    noise2[r] = Random(random, kWide, 0, 0.01);
    plane[r] = Random(random, kWide, -0.05, 0.05);
    for (float& value : noise2[r]) {
      value = random.Uniform() < 0.2 ? kBeyondHeights : value;
    }
  }
  const Floats east = Random(random, kWide, -0.1, 0.1), south = Random(random, kWide, -0.1, 0.1);
  Floats most(kWide), at_cell(kWide);
  FastestSladLoops().steps({{&height[0][1], &height[1][1], &height[2][1]},
                            {&noise2[0][1], &noise2[1][1], &noise2[2][1]},
                            {&plane[0][1], &plane[1][1], &plane[2][1]},
                            &east[1],
                            &south[1]},
                           kCount, most.data(), at_cell.data());
  for (int c = 0; c < kCount; ++c) {
    const std::size_t i = std::size_t(c) + 1;
    float want = -kBeyondHeights, want_at_cell = -kBeyondHeights;
    for (int dr = -1; dr <= 1; ++dr) {
      for (int dc = -1; dc <= 1; ++dc) {
        const std::size_t j = i + std::size_t(dc), r = std::size_t(1 + dr);
        if ((dr == 0 && dc == 0) || noise2[1][i] >= kBeyondHeights ||
            noise2[r][j] >= kBeyondHeights) {
          continue;
        }
        const float rise = height[r][j] - height[1][i] - east[i] * float(dc) - south[i] * float(dr);
        const float step2 = rise * rise - noise2[1][i] - noise2[r][j];
        want = std::max(want, step2);
        if (std::abs(height[1][i] - plane[1][i]) >= 0.9F * std::abs(height[r][j] - plane[r][j])) {
          want_at_cell = std::max(want_at_cell, step2);
        }
      }
    }
    ASSERT_EQ(most[std::size_t(c)], want) << c;
    ASSERT_EQ(at_cell[std::size_t(c)], want_at_cell) << c;
  }
}

TEST(SladLoops, SlopeIsTheAngleToTheUpVector) {
  RandomStream random(7, "slope");
  for (int k = 0; k < 2000; ++k) {
    const float north = float(5 * random.Normal()), east = float(5 * random.Normal());
    const double tilt = random.Uniform(0, 1.2), azimuth = random.Uniform(0, 6.28);
    const float up[] = {float(std::sin(tilt) * std::cos(azimuth)),
                        float(std::sin(tilt) * std::sin(azimuth)), float(-std::cos(tilt))};
    float slope = 0;
    FastestSladLoops().slope(&north, &east, up, 1, &slope);
    const double n = double(north), e = double(east);
    const double dot = -(n * double(up[0]) + e * double(up[1]) + double(up[2]));
    ASSERT_NEAR(double(slope), std::acos(std::fmin(1, dot / std::sqrt(1 + n * n + e * e))), 1e-6);
  }
}

/// Chance that a touchdown is safe by the loops, from one figure each.
struct Figures {
  float slope = 0, slope_sigma = 1e-4F, deviation = 0, step = 0, sigma = 0, denoised = 0, tilt = 0,
        rise = 0;
};
double SafeProbability(const Figures& f) {
  const float none = 0, small = 1e-6F;
  const unsigned char measured = 1;
  float probability = 0, cost = 0;
  unsigned char reasons = 0;
  FastestSladLoops().modern_verdict(
      {0.2F, 0.1F, 0.15F, 0.99F, 0.05F, 0.35F, 0.9F, 1.0F},
      {&f.slope, &f.slope_sigma, &f.deviation, &f.step, &f.sigma, &f.denoised, &f.tilt, &f.rise,
       &none, &none, &small, &measured},
      1, {&probability, &cost, &reasons});
  return double(probability);
}

TEST(SladLoops, ProbabilityFallsWithEveryFigureAndWithNoise) {
  EXPECT_GT(SafeProbability({}), 0.999);
  for (float Figures::*figure : {&Figures::slope, &Figures::step, &Figures::sigma,
                                 &Figures::denoised, &Figures::tilt, &Figures::rise}) {
    double last = 1;
    for (float value = 0; value < 0.6F; value += 0.002F) {
      Figures f;
      f.*figure = value;
      const double now = SafeProbability(f);
      ASSERT_LE(now, last + 1e-6) << value;
      last = now;
    }
    EXPECT_LT(last, 0.5);
  }
  Figures unknown;
  unknown.tilt = NAN;
  EXPECT_EQ(SafeProbability(unknown), 0) << "gear over unknown ground";
}

}  // namespace
}  // namespace palace
