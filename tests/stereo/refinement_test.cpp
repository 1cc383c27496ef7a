// The fast correlation refinement against the same written pixel by pixel, and against itself on
// every instruction set.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "engine/core/random.h"
#include "engine/stereo/hidden.h"
#include "engine/stereo/subpixel.h"
#include "tests/support/processor.h"

namespace palace {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

struct Problem {
  ImageU8 left;
  ImageU8 right;
  ImageF coarse;
};

/// Smooth random texture seen at a disparity that changes over the picture, a step in the middle,
/// noise, and holes in the coarse map.
Problem MakeProblem(int width, int height, std::uint64_t seed) {
  RandomStream random(seed, "problem");
  std::vector<double> phase(24), wave(24), tilt(24);
  for (std::size_t k = 0; k < phase.size(); ++k) {
    phase[k] = random.Uniform(0, 6.28);
    wave[k] = random.Uniform(0.15, 1.6);
    tilt[k] = random.Uniform(-1.2, 1.2);
  }
  const auto grey = [&](double x, double y) {
    double sum = 120;
    for (std::size_t k = 0; k < phase.size(); ++k) {
      sum += 9 * std::sin(wave[k] * x + tilt[k] * y + phase[k]);
    }
    return sum;
  };
  const auto disparity = [&](int x, int y) {
    return 8 + 0.01 * x + 0.02 * y + (x > width / 2 ? 0.4 : 0);
  };
  Problem problem{ImageU8(width, height), ImageU8(width, height),
                  ImageF(width, height, static_cast<float>(kNaN))};
  const auto level = [&](double value) {
    return static_cast<std::uint8_t>(
        std::clamp(std::lround(value + 2 * random.Normal()), 0L, 255L));
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      problem.left.at(x, y) = level(grey(x, y));
      // The right picture's column x shows what the left shows at x + d.
      problem.right.at(x, y) = level(grey(x + disparity(x + 8, y), y));
      if (random.Index(12) != 0) {
        problem.coarse.at(x, y) = static_cast<float>(std::lround(disparity(x, y)));
      }
    }
  }
  return problem;
}

// ---- the plain version, in double ----

class Plain {
 public:
  Plain(const Problem& problem, const SubpixelOptions& options)
      : p_(problem),
        o_(options),
        half_(options.window_px / 2),
        width_(problem.left.width()),
        height_(problem.left.height()) {
    left_mean_ = Mean(p_.left);
    right_mean_ = Mean(p_.right);
    field_ = ImageF(width_, height_, static_cast<float>(kNaN));
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        if (Known(x, y)) {
          field_.at(x, y) = p_.coarse.at(x, y);
        }
      }
    }
  }

  SubpixelDisparity Run() {
    SubpixelDisparity out{ImageF(width_, height_, static_cast<float>(kNaN)),
                          ImageF(width_, height_, static_cast<float>(kNaN))};
    for (int step = 1; step <= o_.iterations; ++step) {
      const bool last = step == o_.iterations;
      Smooth(last ? 0.3 : 1.0);
      ImageF next = reference_;
      for (int y = 0; y < height_; ++y) {
        for (int x = 0; x < width_; ++x) {
          if (!Known(x, y)) {
            continue;
          }
          const Fit fit = FitAt(x, y);
          next.at(x, y) = static_cast<float>(static_cast<double>(reference_.at(x, y)) + fit.step);
          const double sigma = std::sqrt(fit.variance);
          const double shift = static_cast<double>(next.at(x, y) - p_.coarse.at(x, y));
          if (last && fit.good && sigma <= o_.max_sigma_px && std::abs(shift) <= o_.max_shift_px) {
            out.disparity_px.at(x, y) = next.at(x, y);
            out.sigma_px.at(x, y) = static_cast<float>(sigma);
          }
        }
      }
      field_ = next;
    }
    return out;
  }

 private:
  struct Fit {
    double step = 0;
    double variance = 0;
    bool good = false;
  };

  static double Mean(const ImageU8& image) {
    double sum = 0;
    for (const std::uint8_t value : image.pixels()) {
      sum += value;
    }
    return sum / static_cast<double>(image.pixels().size());
  }

  bool Known(int x, int y) const {
    const double match = x - static_cast<double>(p_.coarse.at(x, y));
    return x >= 2 && x < width_ - 2 && match >= 2 + o_.max_shift_px &&
           match <= width_ - 4 - o_.max_shift_px;
  }

  double MeanNear(const ImageF& in, int x, int y, int dx, int dy, double limit) const {
    const double centre = in.at(x, y);
    const auto at = [&](int k) {
      const int u = x + k * dx, v = y + k * dy;
      return in.Contains(u, v) ? static_cast<double>(in.at(u, v)) - centre : kNaN;
    };
    double sum = 0;
    int count = 1;
    for (int k = 1; k <= half_; ++k) {
      const double a = at(-k), b = at(k);
      const bool steep = std::abs(a + b) <= limit;
      for (const double difference : {a, b}) {
        if (std::abs(difference) <= limit || steep) {
          sum += difference;
          ++count;
        }
      }
    }
    return centre + sum / count;
  }

  void Smooth(double limit) {
    ImageF along(width_, height_);
    reference_ = ImageF(width_, height_);
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        along.at(x, y) = static_cast<float>(MeanNear(field_, x, y, 1, 0, limit));
      }
    }
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        const double start = p_.coarse.at(x, y);
        const double mean = MeanNear(along, x, y, 0, 1, limit);
        reference_.at(x, y) = static_cast<float>(
            std::isnan(mean) ? kNaN
                             : std::clamp(mean, start - o_.max_shift_px, start + o_.max_shift_px));
      }
    }
  }

  double Coefficient(int column, int y) const {
    const double pole = std::sqrt(3.0) - 2;
    double sum = 0;
    for (int k = -8; k <= 8; ++k) {
      int u = column + k;  // mirrored at the ends
      u = u < 0 ? -u : (u >= width_ ? 2 * (width_ - 1) - u : u);
      sum += std::sqrt(3.0) * std::pow(pole, std::abs(k)) * (p_.right.at(u, y) - right_mean_);
    }
    return sum;
  }

  double RightAt(double place, int y) const {
    const int whole = static_cast<int>(place);
    const double t = place - whole, u = 1 - t;
    return (u * u * u * Coefficient(whole - 1, y) +
            (4 - 6 * t * t + 3 * t * t * t) * Coefficient(whole, y) +
            (4 - 6 * u * u + 3 * u * u * u) * Coefficient(whole + 1, y) +
            t * t * t * Coefficient(whole + 2, y)) /
           6;
  }

  Fit FitAt(int x, int y) const {
    double n = 0, sl = 0, sg = 0, sr = 0, sll = 0, slg = 0, sgg = 0, srr = 0, slr = 0, srg = 0;
    for (int v = std::max(0, y - half_); v <= std::min(height_ - 1, y + half_); ++v) {
      for (int u = std::max(0, x - half_); u <= std::min(width_ - 1, x + half_); ++u) {
        if (!Known(u, v)) {
          continue;
        }
        const double l = p_.left.at(u, v) - left_mean_;
        const double g = (p_.left.at(u - 2, v) - p_.left.at(u + 2, v) +
                          8.0 * (p_.left.at(u + 1, v) - p_.left.at(u - 1, v))) /
                         12;
        const double r = RightAt(u - static_cast<double>(reference_.at(u, v)), v);
        n += 1, sl += l, sg += g, sr += r;
        sll += l * l, slg += l * g, sgg += g * g, srr += r * r, slr += l * r, srg += r * g;
      }
    }
    const double ll = sll - sl * sl / n, lg = slg - sl * sg / n, gg = sgg - sg * sg / n;
    const double rr = srr - sr * sr / n, lr = slr - sl * sr / n, rg = srg - sr * sg / n;
    Fit fit;
    const bool correlated = lr > 0 && rr > 0 && lr * lr > 0.16 * ll * rr;
    if (n < 0.4 * o_.window_px * o_.window_px || gg <= 0.2 * n || !correlated) {
      return fit;
    }
    const double gain = std::clamp(lr / rr, 0.5, 2.0);
    const double eg = lg - gain * rg;
    const double ee = ll - gain * (2 * lr - gain * rr);
    const double variance = std::max((ee - eg * eg / gg) / (n - 3), 0.2);
    const double energy = gg - 0.45 * n * variance;
    fit.step = std::clamp(-eg / std::max(energy, 0.4 * gg), -1.0, 1.0);
    fit.good = energy > 0.4 * gg;
    fit.variance = variance * gg / (energy * energy) + 0.018 * 0.018;
    return fit;
  }

  const Problem& p_;
  SubpixelOptions o_;
  int half_;
  int width_;
  int height_;
  double left_mean_ = 0;
  double right_mean_ = 0;
  ImageF field_;
  ImageF reference_;
};

struct SizeRow {
  const char* name;
  int width;
  int height;
  int window_px;
  int iterations;
};

class Refinement : public testing::TestWithParam<SizeRow> {};

TEST_P(Refinement, IsTheEquations) {
  const SizeRow& row = GetParam();
  const Problem problem = MakeProblem(row.width, row.height, 4);
  SubpixelOptions options;
  options.window_px = row.window_px;
  options.iterations = row.iterations;
  const SubpixelDisparity plain = Plain(problem, options).Run();
  const SubpixelDisparity fast =
      RefineDisparity(problem.left, problem.right, problem.coarse, options, PortableLoops());
  // Sums of floats: results near a limit may fall on either side of it.
  int both = 0, one = 0;
  for (std::size_t i = 0; i < plain.disparity_px.pixels().size(); ++i) {
    const float a = plain.disparity_px.pixels()[i], b = fast.disparity_px.pixels()[i];
    one += std::isnan(a) != std::isnan(b) ? 1 : 0;
    if (!std::isnan(a) && !std::isnan(b)) {
      ++both;
      EXPECT_NEAR(a, b, 2e-3) << i;
      EXPECT_NEAR(plain.sigma_px.pixels()[i], fast.sigma_px.pixels()[i], 2e-3) << i;
    }
  }
  EXPECT_GT(both, row.width * row.height / 4);
  EXPECT_LE(one, both / 200);
}

TEST_P(Refinement, GivesTheSameBitsWithAndWithoutAvx2) {
  const StereoLoops* avx2 = Avx2Loops();
  if (!avx2) {
    ASSERT_FALSE(ProcessorHasAvx2()) << "the loops were not built for AVX2";
    GTEST_SKIP() << "runs on a processor with AVX2";
  }
  const SizeRow& row = GetParam();
  const Problem problem = MakeProblem(row.width, row.height, 5);
  SubpixelOptions options;
  options.window_px = row.window_px;
  options.iterations = row.iterations;
  const auto a =
      RefineDisparity(problem.left, problem.right, problem.coarse, options, PortableLoops());
  const auto b = RefineDisparity(problem.left, problem.right, problem.coarse, options, *avx2);
  for (const auto& [p, q] :
       {std::pair{&a.disparity_px, &b.disparity_px}, {&a.sigma_px, &b.sigma_px}}) {
    for (std::size_t i = 0; i < p->pixels().size(); ++i) {
      const float x = p->pixels()[i], y = q->pixels()[i];
      ASSERT_TRUE(x == y || (std::isnan(x) && std::isnan(y))) << i << ": " << x << ' ' << y;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, Refinement,
                         testing::Values(SizeRow{"Usual", 120, 60, 9, 2},
                                         SizeRow{"OddSize", 83, 53, 5, 2},
                                         SizeRow{"WideWindow", 97, 50, 21, 3},
                                         SizeRow{"OneStep", 70, 49, 11, 1}),
                         [](const auto& row) { return std::string(row.param.name); });

TEST(Hidden, WhatTheRightCameraCannotSeeIsRefused) {
  // Ground at 10 px, an object at 14 px in columns 30..39. The right camera sees the object at
  // columns 16..25, where ground of the left columns 26..35 would lie: 26..29 are hidden.
  ImageF disparity(60, 1, 10.0F), sigma(60, 1, 0.1F);
  for (int x = 30; x < 40; ++x) {
    disparity.at(x, 0) = 14;
  }
  disparity.at(50, 0) = 10.4F;  // less than the limit
  RefuseHidden(0.5, disparity, sigma);
  for (int x = 0; x < 60; ++x) {
    EXPECT_EQ(std::isnan(disparity.at(x, 0)), x >= 26 && x < 30) << x;
    EXPECT_EQ(std::isnan(sigma.at(x, 0)), std::isnan(disparity.at(x, 0))) << x;
  }
}

}  // namespace
}  // namespace palace
