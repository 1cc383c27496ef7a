// Pairing by time: a table of small cases, then rules applied in random order against invariants,
// and a slow search over all pictures. It does not prove that stamps are those of the exposure.
#include "engine/capture/frame_pairing.h"

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "engine/core/random.h"

namespace palace {
namespace {

using Side = FramePairing::Side;
constexpr Side kLeft = FramePairing::kLeft;
constexpr Side kRight = FramePairing::kRight;

TimedPicture At(double ms) { return {{static_cast<std::int64_t>(ms * 1000)}, ImageU8(1, 1)}; }

/// "L3" is a picture of the left camera at 3 ms. Gives the pairs as "3-5 8-7".
std::string Pairs(FramePairing& pairing, const std::string& arrivals) {
  std::string pairs;
  for (std::size_t at = 0; at < arrivals.size(); at = arrivals.find_first_of("LR", at + 1)) {
    const Side side = arrivals[at] == 'L' ? kLeft : kRight;
    if (const auto pair = pairing.Add(side, At(std::atof(arrivals.c_str() + at + 1)))) {
      pairs += (pairs.empty() ? "" : " ") + std::to_string(pair->left.time.us / 1000) + "-" +
               std::to_string(pair->right.time.us / 1000);
    }
  }
  return pairs;
}

struct PairingCase {
  const char* what;
  const char* arrivals;
  const char* pairs;
  std::uint64_t left_dropped;
  std::uint64_t right_dropped;
};

TEST(FramePairing, Cases) {
  constexpr double kTolerance_s = 0.010;
  const PairingCase cases[] = {
      {"together", "L0 R0 L30 R30", "0-0 30-30", 0, 0},
      {"right a little later", "L0 R4 L30 R34", "0-4 30-34", 0, 0},
      {"right first", "R2 L0 R32 L30", "0-2 30-32", 0, 0},
      {"at the tolerance", "L0 R10", "0-10", 0, 0},
      {"beyond the tolerance", "L0 R11", "", 1, 0},
      {"left misses one", "L0 R0 R30 L60 R60", "0-0 60-60", 0, 1},
      {"right misses one", "L0 R0 L30 L60 R60", "0-0 60-60", 1, 0},
      {"twice the rate", "L0 R0 L15 L30 R30 L45 L60 R60", "0-0 30-30 60-60", 2, 0},
      {"the nearer of two that wait", "L0 L8 R9", "8-9", 1, 0},
      {"a burst after a pause", "L0 L30 L60 R1 R31 R61", "0-1 30-31 60-61", 0, 0},
      {"a repeated picture", "L0 L0 R0 L30 R30", "0-0 30-30", 1, 0},
      {"time running back", "L30 L0 R30", "30-30", 1, 0},
      {"one camera only", "L0 L30 L60", "", 0, 0},
  };
  for (const PairingCase& row : cases) {
    SCOPED_TRACE(row.what);
    FramePairing pairing(kTolerance_s);
    EXPECT_EQ(Pairs(pairing, row.arrivals), row.pairs);
    EXPECT_EQ(pairing.unpaired(kLeft), row.left_dropped);
    EXPECT_EQ(pairing.unpaired(kRight), row.right_dropped);
  }
}

TEST(FramePairing, ACameraAloneFillsNoMemory) {
  FramePairing pairing(0.01, 4);
  for (int i = 0; i < 1000; ++i) {
    EXPECT_FALSE(pairing.Add(kLeft, At(30.0 * i)));
  }
  EXPECT_EQ(pairing.waiting(kLeft), 4u);
  EXPECT_EQ(pairing.unpaired(kLeft), 996u);
  EXPECT_EQ(Pairs(pairing, "R29971"), "29970-29971") << "the newest are kept";
}

TEST(FramePairing, RestartForgetsTimesAndKeepsCounts) {
  FramePairing pairing(0.01);
  EXPECT_EQ(Pairs(pairing, "L1000 R1020 L1040 R1040"), "1040-1040");
  pairing.Restart();
  EXPECT_EQ(Pairs(pairing, "L0 R0"), "0-0");
  EXPECT_EQ(pairing.unpaired(kLeft), 1u);
  EXPECT_EQ(pairing.unpaired(kRight), 1u);
}

/// Rules in random order. Each adds pictures; after each the invariants hold.
TEST(FramePairing, RulesInRandomOrder) {
  constexpr std::int64_t kPeriod_us = 33'333, kTolerance_us = 12'000;
  std::uint64_t pairs_of_all = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomStream random(seed, "pairing");
    FramePairing pairing(kTolerance_us * 1e-6);
    std::int64_t now_us[2] = {0, 0};
    std::uint64_t given[2] = {0, 0}, pairs = 0;
    Timestamp last_left{-1'000'000}, last_right = last_left;

    const auto add = [&](Side side, std::int64_t time_us) {
      ++given[side];
      const auto pair = pairing.Add(side, {{time_us}, ImageU8(1, 1)});
      if (!pair) {
        return;
      }
      ++pairs;
      EXPECT_LE(std::abs(pair->left.time.us - pair->right.time.us), kTolerance_us);
      EXPECT_GT(pair->left.time, last_left);
      EXPECT_GT(pair->right.time, last_right);
      last_left = pair->left.time;
      last_right = pair->right.time;
    };
    const auto next = [&](Side side) {
      now_us[side] += kPeriod_us + random.Index(8000) - 4000;
      add(side, now_us[side]);
    };
    const std::vector<std::pair<const char*, std::function<void()>>> rules = {
        {"left arrives", [&] { next(kLeft); }},
        {"right arrives", [&] { next(kRight); }},
        {"both arrive", [&] { next(kLeft), next(kRight); }},
        {"left repeats", [&] { add(kLeft, now_us[kLeft]); }},
        {"right runs back", [&] { add(kRight, now_us[kRight] - 5000); }},
        {"left is unplugged", [&] { now_us[kLeft] += 20 * kPeriod_us; }},
        {"right comes in a burst",
         [&] {
           for (int i = 0; i < 12; ++i) {
             next(kRight);
           }
         }},
        {"clocks meet", [&] { now_us[0] = now_us[1] = std::max(now_us[0], now_us[1]); }},
    };
    for (int step = 0; step < 300; ++step) {
      const auto& [what, rule] = rules[static_cast<std::size_t>(random.Index(8))];
      SCOPED_TRACE(what);
      rule();
      for (const Side side : {kLeft, kRight}) {
        ASSERT_EQ(given[side], pairs + pairing.unpaired(side) + pairing.waiting(side));
        ASSERT_LE(pairing.waiting(side), 8u);
      }
      ASSERT_TRUE(pairing.waiting(kLeft) == 0 || pairing.waiting(kRight) == 0);
    }
    pairs_of_all += pairs;
  }
  EXPECT_GT(pairs_of_all, 1000u) << "else the rules prove little";
}

/// Periods above twice the tolerance: exactly the pairs within the tolerance, in any order of
/// arrival between the sides. The reference looks at all of them.
TEST(FramePairing, EqualsASearchOverAllPictures) {
  constexpr std::int64_t kTolerance_us = 10'000;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomStream random(seed, "search");
    std::vector<std::int64_t> times[2];
    for (auto& side : times) {
      std::int64_t t = random.Index(30'000);
      for (int i = 0; i < 60; ++i) {
        t += 2 * kTolerance_us + 1 + random.Index(25'000);
        if (random.Uniform() < 0.9) {
          side.push_back(t);
        }
      }
    }
    std::vector<std::pair<std::int64_t, std::int64_t>> expected, found;
    for (const std::int64_t left : times[0]) {
      for (const std::int64_t right : times[1]) {
        if (std::abs(left - right) <= kTolerance_us) {
          expected.emplace_back(left, right);
        }
      }
    }
    FramePairing pairing(kTolerance_us * 1e-6, 200);
    std::size_t next[2] = {0, 0};
    while (next[0] < times[0].size() || next[1] < times[1].size()) {
      const bool left_over = next[1] >= times[1].size();
      const auto side =
          next[0] < times[0].size() && (left_over || random.Index(2) == 0) ? kLeft : kRight;
      if (const auto pair = pairing.Add(side, {{times[side][next[side]++]}, ImageU8(1, 1)})) {
        found.emplace_back(pair->left.time.us, pair->right.time.us);
      }
    }
    EXPECT_EQ(found, expected);
  }
}

TEST(FramePairing, ExchangedCamerasGiveTheSamePairs) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomStream random(seed, "mirror");
    FramePairing pairing(0.012), mirrored(0.012);
    std::int64_t now_us[2] = {0, 7000};
    for (int i = 0; i < 200; ++i) {
      const std::size_t side = static_cast<std::size_t>(random.Index(2));
      now_us[side] += 5000 + random.Index(40'000);
      const auto a = pairing.Add(side == 0 ? kLeft : kRight, {{now_us[side]}, {}});
      const auto b = mirrored.Add(side == 0 ? kRight : kLeft, {{now_us[side]}, {}});
      ASSERT_EQ(a.has_value(), b.has_value());
      if (a) {
        EXPECT_EQ(a->left.time, b->right.time);
        EXPECT_EQ(a->right.time, b->left.time);
      }
    }
  }
}

}  // namespace
}  // namespace palace
