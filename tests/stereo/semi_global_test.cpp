// The fast semi-global matcher against the same matcher written as its equations stand.
#include "engine/stereo/semi_global.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "engine/core/random.h"
#include "engine/stereo/speckles.h"

namespace palace {
namespace {

constexpr int kBandRows = 120, kWarmUpRows = 24;  // as semi_global.h states

// ---- the plain version ----

std::uint32_t PlainCensus(const ImageU8& image, int x, int y, int first_column, int end_column) {
  const auto at = [&](int u, int v) {
    return image.at(std::clamp(u, first_column, end_column - 1),
                    std::clamp(v, 0, image.height() - 1));
  };
  std::uint32_t code = 0;
  int pair = 0;
  for (int v = -3; v <= 0; ++v) {
    for (int u = -3; u <= 3; ++u) {
      if (v < 0 || u < 0) {
        code |= at(x + u, y + v) > at(x - u, y - v) ? 1U << pair : 0U;
        ++pair;
      }
    }
  }
  return code;
}

using Volume = std::vector<std::vector<int>>;  // [column][disparity]

std::vector<int> PlainPath(const std::vector<int>& cost, const std::vector<int>* before,
                           const SemiGlobalOptions& options) {
  if (!before) {
    return cost;
  }
  const int least = *std::min_element(before->begin(), before->end());
  const int count = static_cast<int>(cost.size());
  std::vector<int> path(cost.size());
  for (int d = 0; d < count; ++d) {
    const auto k = static_cast<std::size_t>(d);
    int stay = std::min((*before)[k], least + options.large_jump_cost);
    if (d > 0) {
      stay = std::min(stay, (*before)[k - 1] + options.small_jump_cost);
    }
    if (d + 1 < count) {
      stay = std::min(stay, (*before)[k + 1] + options.small_jump_cost);
    }
    path[k] = cost[k] + stay - least;
  }
  return path;
}

void Add(const std::vector<int>& path, std::vector<int>& sum) {
  for (std::size_t k = 0; k < sum.size(); ++k) {
    sum[k] += path[k];
  }
}

void PlainChoice(const Volume& sum, const DisparityWindow& window, const SemiGlobalOptions& options,
                 float* disparity) {
  const int columns = static_cast<int>(sum.size());
  std::vector<int> best(sum.size());
  std::vector<int> seen(sum.size(), -1), seen_cost(sum.size(), 255);
  for (int x = 0; x < columns; ++x) {
    const auto& s = sum[static_cast<std::size_t>(x)];
    const int d = static_cast<int>(std::min_element(s.begin(), s.end()) - s.begin());
    best[static_cast<std::size_t>(x)] = d;
    const int cost = s[static_cast<std::size_t>(d)];
    if (x >= d && cost < seen_cost[static_cast<std::size_t>(x - d)]) {
      seen_cost[static_cast<std::size_t>(x - d)] = cost;
      seen[static_cast<std::size_t>(x - d)] = d;
    }
  }
  for (int x = 0; x < columns; ++x) {
    const auto& s = sum[static_cast<std::size_t>(x)];
    const int d = best[static_cast<std::size_t>(x)];
    const int cost = s[static_cast<std::size_t>(d)];
    bool known = x >= d && d < window.count;
    for (int k = 0; k < static_cast<int>(s.size()); ++k) {
      const double limit = std::floor(cost * 100.0 / (100 - options.uniqueness_percent));
      known &= std::abs(k - d) <= 1 || s[static_cast<std::size_t>(k)] > limit;
    }
    known = known && std::abs(seen[static_cast<std::size_t>(x - d)] - d) <=
                         std::lround(options.max_left_right_px);
    const auto near = [&](int k) {
      return k >= 0 && k < static_cast<int>(s.size()) ? s[static_cast<std::size_t>(k)] : cost;
    };
    const int below = near(d - 1), above = near(d + 1), steep = std::max(below, above) - cost;
    const float shift =
        steep > 0 ? static_cast<float>(below - above) / (2 * static_cast<float>(steep)) : 0.0F;
    disparity[window.min_px + x] = known ? static_cast<float>(window.min_px + d) + shift
                                         : std::numeric_limits<float>::quiet_NaN();
  }
}

ImageF PlainMatch(const ImageU8& left, const ImageU8& right, const DisparityWindow& window,
                  const SemiGlobalOptions& options) {
  const int columns = left.width() - window.min_px;
  const int wide = (window.count + 31) / 32 * 32;
  ImageF disparity(left.width(), left.height(), std::numeric_limits<float>::quiet_NaN());
  Volume above;
  for (int band = 0; band < left.height(); band += kBandRows) {
    above.clear();
    for (int y = std::max(0, band - kWarmUpRows); y < std::min(left.height(), band + kBandRows);
         ++y) {
      Volume cost(static_cast<std::size_t>(columns),
                  std::vector<int>(static_cast<std::size_t>(wide)));
      for (int x = 0; x < columns; ++x) {
        const std::uint32_t code =
            PlainCensus(left, window.min_px + x, y, window.min_px, left.width());
        for (int d = 0; d < wide; ++d) {
          const std::uint32_t other = PlainCensus(right, std::max(0, x - d), y, 0, columns);
          cost[static_cast<std::size_t>(x)][static_cast<std::size_t>(d)] =
              __builtin_popcount(code ^ other);
        }
      }
      Volume sum = cost;
      for (std::size_t x = 0; x < sum.size(); ++x) {
        sum[x] = PlainPath(cost[x], above.empty() ? nullptr : &above[x], options);
      }
      above = sum;
      std::vector<int> path;
      for (std::size_t x = 0; x < sum.size(); ++x) {
        path = PlainPath(cost[x], x == 0 ? nullptr : &path, options);
        Add(path, sum[x]);
      }
      for (std::size_t x = sum.size(); x-- > 0;) {
        path = PlainPath(cost[x], x + 1 == sum.size() ? nullptr : &path, options);
        Add(path, sum[x]);
      }
      if (y >= band) {
        PlainChoice(sum, window, options, disparity.row(y));
      }
    }
  }
  return disparity;
}

// ---- pictures ----

/// Texture that moves by a disparity which changes over the picture, with noise.
struct Pictures {
  ImageU8 left;
  ImageU8 right;
};

Pictures MakePictures(int width, int height, int disparity, std::uint64_t seed) {
  RandomStream random(seed, "pictures");
  Pictures pictures{ImageU8(width, height), ImageU8(width, height)};
  std::vector<int> line(static_cast<std::size_t>(2 * width + 512));
  for (int y = 0; y < height; ++y) {
    for (int& value : line) {
      value = random.Index(220);
    }
    const int shift = disparity + (y / 8) % 5;
    for (int x = 0; x < width; ++x) {
      pictures.left.at(x, y) =
          static_cast<std::uint8_t>(line[static_cast<std::size_t>(x)] + random.Index(30));
      pictures.right.at(x, y) =
          static_cast<std::uint8_t>(line[static_cast<std::size_t>(x + shift)] + random.Index(30));
    }
  }
  return pictures;
}

::testing::AssertionResult SameBits(const ImageF& a, const ImageF& b) {
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      const float p = a.at(x, y), q = b.at(x, y);
      if (!(p == q || (std::isnan(p) && std::isnan(q)))) {
        return ::testing::AssertionFailure() << "at " << x << ',' << y << ": " << p << " and " << q;
      }
    }
  }
  return ::testing::AssertionSuccess();
}

double Known(const ImageF& image) {
  double known = 0;
  for (const float value : image.pixels()) {
    known += std::isnan(value) ? 0 : 1;
  }
  return known / static_cast<double>(image.pixels().size());
}

struct SizeRow {
  const char* name;
  int width;
  int height;
  DisparityWindow window;
  int disparity;
};

class SemiGlobal : public testing::TestWithParam<SizeRow> {};

TEST_P(SemiGlobal, IsTheEquations) {
  const SizeRow& row = GetParam();
  const Pictures pictures = MakePictures(row.width, row.height, row.disparity, 3);
  for (const SemiGlobalOptions& options :
       {SemiGlobalOptions{}, SemiGlobalOptions{0, 0, 0, 1}, SemiGlobalOptions{3, 61, 15, 0}}) {
    const ImageF plain = PlainMatch(pictures.left, pictures.right, row.window, options);
    EXPECT_TRUE(SameBits(plain, MatchSemiGlobal(pictures.left, pictures.right, row.window, options,
                                                PortableLoops())));
    if (const StereoLoops* avx2 = Avx2Loops()) {
      EXPECT_TRUE(SameBits(
          plain, MatchSemiGlobal(pictures.left, pictures.right, row.window, options, *avx2)));
    }
  }
  EXPECT_GT(Known(PlainMatch(pictures.left, pictures.right, row.window, {})), 0.3);
}

INSTANTIATE_TEST_SUITE_P(Sizes, SemiGlobal,
                         testing::Values(SizeRow{"Even", 96, 40, {0, 32}, 9},
                                         SizeRow{"OddSize", 83, 29, {0, 48}, 17},
                                         SizeRow{"FarWindow", 150, 17, {60, 16}, 63},
                                         SizeRow{"TwoBands", 40, 131, {0, 16}, 4},
                                         SizeRow{"Widest", 300, 7, {0, 256}, 40},
                                         SizeRow{"OneRow", 70, 1, {0, 16}, 5},
                                         SizeRow{"Narrow", 17, 12, {0, 16}, 2}),
                         [](const auto& row) { return std::string(row.param.name); });

TEST(Speckles, AreRemovedByAreaAndStep) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  ImageF field(12, 6, 10.0F);
  for (int x = 3; x < 6; ++x) {  // a patch of six, far from its surroundings
    field.at(x, 1) = 20;
    field.at(x, 2) = 21.5F;
  }
  field.at(9, 4) = kNaN;
  ImageF kept = field;
  RemoveSpeckles(kept, 6, 2);
  EXPECT_TRUE(SameBits(field, kept)) << "six pixels are enough";
  ImageF removed = field;
  RemoveSpeckles(removed, 7, 2);
  for (int y = 0; y < 6; ++y) {
    for (int x = 0; x < 12; ++x) {
      const bool patch = x >= 3 && x < 6 && (y == 1 || y == 2);
      EXPECT_EQ(std::isnan(removed.at(x, y)), patch || (x == 9 && y == 4)) << x << ',' << y;
    }
  }
  RemoveSpeckles(field, 4, 1);  // now its two rows are patches of three
  EXPECT_TRUE(std::isnan(field.at(4, 1)) && std::isnan(field.at(4, 2)));
}

TEST(Speckles, AgreeWithAFloodFill) {
  RandomStream random(5);
  for (int round = 0; round < 40; ++round) {
    SCOPED_TRACE(round);
    const int width = 1 + random.Index(30), height = 1 + random.Index(20);
    ImageF field(width, height);
    for (float& value : field.pixels()) {
      value = random.Index(4) == 0 ? std::numeric_limits<float>::quiet_NaN()
                                   : static_cast<float>(random.Index(5));
    }
    ImageF plain = field;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        std::vector<std::pair<int, int>> patch{{x, y}};
        for (std::size_t k = 0; k < patch.size() && !std::isnan(field.at(x, y)); ++k) {
          const auto [u, v] = patch[k];
          for (const auto& next : {std::pair{u - 1, v}, {u + 1, v}, {u, v - 1}, {u, v + 1}}) {
            if (field.Contains(next.first, next.second) &&
                std::abs(field.at(next.first, next.second) - field.at(u, v)) <= 1 &&
                std::find(patch.begin(), patch.end(), next) == patch.end()) {
              patch.push_back(next);
            }
          }
        }
        if (patch.size() < 9) {
          plain.at(x, y) = std::numeric_limits<float>::quiet_NaN();
        }
      }
    }
    RemoveSpeckles(field, 9, 1);
    EXPECT_TRUE(SameBits(plain, field));
  }
}

}  // namespace
}  // namespace palace
