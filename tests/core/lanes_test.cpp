// Each lane does what a lone number does, to the bit: NaN, infinity, both zeros, wrapping bytes.
// It holds for the instruction set of this file only; slad_loops_test and the tests of the matcher
// compare the sets.
#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "engine/core/lanes/byte_lanes.h"
#include "engine/core/lanes/float_lanes.h"
#include "engine/core/random.h"

namespace palace {
namespace {

std::uint32_t Bits(float value) { return std::bit_cast<std::uint32_t>(value); }

std::vector<float> Awkward() {
  const float inf = std::numeric_limits<float>::infinity();
  std::vector<float> values = {0.0F, -0.0F, 1.0F, -1.0F, inf, -inf, NAN, 1e-45F, 3.4e38F, 0.1F};
  RandomStream random(8, "lanes");
  while (values.size() % 16 != 0) {
    values.push_back(static_cast<float>(random.Uniform(-3, 3)));
  }
  return values;
}

/// Lane by lane over all pairs; a NaN may have any bits.
template <typename Lanewise, typename Lone>
void ExpectSame(const char* name, Lanewise lanewise, Lone lone) {
  const std::vector<float> a = Awkward();
  for (std::size_t shift = 0; shift < a.size(); ++shift) {
    std::vector<float> b = a, out(a.size());
    std::rotate(b.begin(), b.begin() + static_cast<std::ptrdiff_t>(shift), b.end());
    for (std::size_t i = 0; i < a.size(); i += FloatLanes::kCount) {
      Store(&out[i], lanewise(Load(&a[i]), Load(&b[i])));
    }
    for (std::size_t i = 0; i < a.size(); ++i) {
      const float want = lone(a[i], b[i]);
      EXPECT_TRUE(Bits(out[i]) == Bits(want) || (std::isnan(out[i]) && std::isnan(want)))
          << name << " of " << a[i] << " and " << b[i] << ": " << out[i] << ", not " << want;
    }
  }
}

TEST(FloatLanes, DoWhatLoneFloatsDo) {
  using F = FloatLanes;
  ExpectSame(
      "+", [](F a, F b) { return a + b; }, [](float a, float b) { return a + b; });
  ExpectSame(
      "-", [](F a, F b) { return a - b; }, [](float a, float b) { return a - b; });
  ExpectSame(
      "*", [](F a, F b) { return a * b; }, [](float a, float b) { return a * b; });
  ExpectSame(
      "/", [](F a, F b) { return a / b; }, [](float a, float b) { return a / b; });
  ExpectSame(
      "Min", [](F a, F b) { return Min(a, b); }, [](float a, float b) { return a < b ? a : b; });
  ExpectSame(
      "Max", [](F a, F b) { return Max(a, b); }, [](float a, float b) { return a > b ? a : b; });
  ExpectSame(
      "Abs", [](F a, F) { return Abs(a); }, [](float a, float) { return std::fabs(a); });
  ExpectSame(
      "Less", [](F a, F b) { return Select(Less(a, b), a, b); },
      [](float a, float b) { return a < b ? a : b; });
  ExpectSame(
      "IsNan", [](F a, F b) { return Select(IsNan(a), b, a); },
      [](float a, float b) { return std::isnan(a) ? b : a; });
}

TEST(FloatLanes, FillKeepsTheSignOfZeroAndAnySeesOneLane) {
  std::vector<float> out(FloatLanes::kCount);
  Store(out.data(), Fill(-0.0F));
  EXPECT_EQ(Bits(out.back()), Bits(-0.0F));
  EXPECT_FALSE(Any(IsNan(Load(out.data()))));
  for (float& lane : out) {
    lane = NAN;
    EXPECT_TRUE(Any(IsNan(Load(out.data()))));
    lane = 0;
  }
}

TEST(ByteLanes, DoWhatLoneBytesDo) {
  using Byte = std::uint8_t;
  constexpr int kCount = ByteLanes::kCount;
  RandomStream random(9, "lanes");
  std::vector<Byte> a(kCount), b(kCount), out(kCount);
  for (int trial = 0; trial < 200; ++trial) {
    for (int k = 0; k < kCount; ++k) {
      a[static_cast<std::size_t>(k)] = static_cast<Byte>(random.Index(256));
      b[static_cast<std::size_t>(k)] = random.Index(3) == 0 ? a[static_cast<std::size_t>(k)]
                                                            : static_cast<Byte>(random.Index(256));
    }
    const ByteLanes x = Load(a.data()), y = Load(b.data());
    const auto expect = [&](const char* name, ByteLanes got, auto lone) {
      Store(out.data(), got);
      for (std::size_t k = 0; k < out.size(); ++k) {
        ASSERT_EQ(out[k], static_cast<Byte>(lone(a[k], b[k]))) << name << " lane " << k;
      }
    };
    expect("+", x + y, [](int p, int q) { return p + q; });
    expect("-", x - y, [](int p, int q) { return p - q; });
    expect("&", x & y, [](int p, int q) { return p & q; });
    expect("|", x | y, [](int p, int q) { return p | q; });
    expect("^", x ^ y, [](int p, int q) { return p ^ q; });
    expect("Min", Min(x, y), [](int p, int q) { return std::min(p, q); });
    expect("Equal", Equal(x, y), [](int p, int q) { return p == q ? 255 : 0; });
    expect("AtMost", AtMost(x, y), [](int p, int q) { return p <= q ? 255 : 0; });
    const Byte all = 0xFF >> 2;
    expect("ShiftRight", ShiftRight<2>(x) & Fill(all), [](int p, int) { return p >> 2; });
    EXPECT_EQ(LeastLane(x), *std::min_element(a.begin(), a.end()));
    EXPECT_EQ(Any(Equal(x, y)),
              std::mismatch(a.begin(), a.end(), b.begin(), std::not_equal_to<>()).first != a.end());
  }
}

}  // namespace
}  // namespace palace
