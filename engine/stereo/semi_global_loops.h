// Loops of semi-global matching on lanes of bytes.
// Included by one source file for each instruction set, so it stays clear of every inline function
// of other headers: the linker could keep the copy that the processor at hand cannot run.
#pragma once

#include <cstdint>

#include "engine/core/lanes/byte_lanes.h"
#include "engine/stereo/stereo_loops.h"

namespace palace {
namespace {

using Byte = std::uint8_t;
static_assert(kDisparityBlock % ByteLanes::kCount == 0);

// ---- census ----

inline void CompareOpposite(const Byte* a, const Byte* b, int width, Byte bit, Byte* plane) {
  for (int x = 0; x < width; ++x) {
    plane[x] = static_cast<Byte>(plane[x] | (a[x] > b[x] ? bit : 0));
  }
}

void CensusRow(const Byte* const* rows, int width, Byte* const* planes) {
  for (int p = 0; p < kCensusPlanes; ++p) {
    for (int x = 0; x < width; ++x) {
      planes[p][x] = 0;
    }
  }
  constexpr int side = 2 * kCensusHalf_px + 1;
  for (int pair = 0; pair < 8 * kCensusPlanes; ++pair) {
    const int v = pair / side, u = pair % side;  // from the top left; the other by reflection
    CompareOpposite(rows[v] + u, rows[side - 1 - v] + side - 1 - u, width,
                    static_cast<Byte>(1 << (pair % 8)), planes[pair / 8]);
  }
}

// ---- matching cost ----

/// Bits set in three bytes. A full adder first joins them to twos and ones, so that only two bytes
/// have to be counted (bits, pairs, nibbles).
inline ByteLanes CountBits(ByteLanes a, ByteLanes b, ByteLanes c) {
  const ByteLanes odd = Fill(0x55), pairs = Fill(0x33), nibbles = Fill(0x0F);
  const ByteLanes half = a ^ b;
  const ByteLanes ones = half ^ c;
  const ByteLanes twos = (a & b) | (half & c);
  const ByteLanes ones2 = ones - (ShiftRight<1>(ones) & odd);
  const ByteLanes twos2 = twos - (ShiftRight<1>(twos) & odd);
  const ByteLanes ones4 = (ones2 & pairs) + (ShiftRight<2>(ones2) & pairs);
  const ByteLanes twos4 = (twos2 & pairs) + (ShiftRight<2>(twos2) & pairs);
  const ByteLanes all = ones4 + twos4 + twos4;  // at most 12 in each nibble
  return (all & nibbles) + (ShiftRight<4>(all) & nibbles);
}

void MatchRow(const Byte* const* left, const Byte* const* right_reversed, int columns, int blocks,
              Byte* cost) {
  const int wide = blocks * kDisparityBlock;
  for (int x = 0; x < columns; ++x) {
    const ByteLanes a = Fill(left[0][x]), b = Fill(left[1][x]), c = Fill(left[2][x]);
    const Byte* ra = right_reversed[0] + (columns - 1 - x);
    const Byte* rb = right_reversed[1] + (columns - 1 - x);
    const Byte* rc = right_reversed[2] + (columns - 1 - x);
    for (int d = 0; d < wide; d += ByteLanes::kCount) {
      Store(cost + d, CountBits(a ^ Load(ra + d), b ^ Load(rb + d), c ^ Load(rc + d)));
    }
    cost += wide;
  }
}

// ---- paths: L(p,d) = C(p,d) + min(L(q,d), L(q,d+-1) + P1, min L(q) + P2) - min L(q) ----

struct Jumps {
  Byte small;
  Byte large;
};

/// Least cost of the new pixel. `before`: path costs at the pixel before, guards around them.
template <bool kFirstInSum>
inline Byte StepPath(const Byte* cost, const Byte* before, Byte before_least, int wide, Jumps jumps,
                     Byte* after, Byte* sum) {
  const ByteLanes small = Fill(jumps.small);
  const ByteLanes jump = Fill(static_cast<Byte>(before_least + jumps.large));
  const ByteLanes base = Fill(before_least);
  ByteLanes lowest = Fill(255);
  for (int d = 0; d < wide; d += ByteLanes::kCount) {
    const ByteLanes side = Min(Load(before + d - 1), Load(before + d + 1)) + small;
    const ByteLanes stay = Min(Min(Load(before + d), side), jump);
    const ByteLanes now = Load(cost + d) + (stay - base);
    Store(after + d, now);
    Store(sum + d, kFirstInSum ? now : Load(sum + d) + now);
    lowest = Min(lowest, now);
  }
  return LeastLane(lowest);
}

void AggregateDown(const Byte* cost, int columns, int blocks, int small_jump, int large_jump,
                   const Byte* above, const Byte* above_least, Byte* path, Byte* least, Byte* sum) {
  const Jumps jumps{static_cast<Byte>(small_jump), static_cast<Byte>(large_jump)};
  const int wide = blocks * kDisparityBlock;
  for (int x = 0; x < columns; ++x) {
    least[x] = StepPath<true>(cost, above, above_least[x], wide, jumps, path, sum);
    cost += wide;
    sum += wide;
    above += wide + kPathGuard;
    path += wide + kPathGuard;
  }
}

/// One path on its way along a row: two buffers in turn.
struct Chain {
  Byte buffer[2][kPathGuard + 256 + kPathGuard];
  int now;
  Byte least;
};

inline void StartChain(Chain& chain, int wide) {
  chain.now = 0;
  chain.least = 0;
  for (auto& buffer : chain.buffer) {
    for (Byte& cost : buffer) {
      cost = kPathGuardCost;
    }
  }
  for (int k = 0; k < wide; ++k) {
    chain.buffer[0][kPathGuard + k] = 0;
  }
}

inline void StepChain(Chain& chain, const Byte* cost, Byte* sum, int wide, Jumps jumps) {
  const Byte* before = chain.buffer[chain.now] + kPathGuard;
  Byte* after = chain.buffer[1 - chain.now] + kPathGuard;
  chain.least = StepPath<false>(cost, before, chain.least, wide, jumps, after, sum);
  chain.now = 1 - chain.now;
}

// A path cannot begin a pixel before it has finished the last one. Four paths in turn (two rows,
// both ways) keep the processor busy meanwhile.
void AggregateAlong(const Byte* const* cost, int columns, int blocks, int small_jump,
                    int large_jump, Byte* const* sum) {
  const Jumps jumps{static_cast<Byte>(small_jump), static_cast<Byte>(large_jump)};
  const int wide = blocks * kDisparityBlock;
  Chain chains[2 * kRowsTogether];
  for (Chain& chain : chains) {
    StartChain(chain, wide);
  }
  for (int x = 0; x < columns; ++x) {
    const long forth = static_cast<long>(x) * wide;
    const long back = static_cast<long>(columns - 1 - x) * wide;
    for (int row = 0; row < kRowsTogether; ++row) {
      StepChain(chains[2 * row], cost[row] + forth, sum[row] + forth, wide, jumps);
      StepChain(chains[2 * row + 1], cost[row] + back, sum[row] + back, wide, jumps);
    }
  }
}

// ---- choice ----

struct Winner {
  Byte cost;
  Byte index;
};

/// The first of the least costs. `names`: 0, 1, 2, ..
inline Winner FindLeast(const Byte* sum, int wide, const Byte* names) {
  ByteLanes low = Load(sum);
  for (int d = ByteLanes::kCount; d < wide; d += ByteLanes::kCount) {
    low = Min(low, Load(sum + d));
  }
  const Byte least = LeastLane(low);
  const ByteLanes wanted = Fill(least);
  ByteLanes missed = Fill(255);
  for (int d = 0; d < wide; d += ByteLanes::kCount) {
    // 255 - name where the cost is the least: the greatest of them belongs to the first.
    const ByteLanes hit = Equal(Load(sum + d), wanted) & (Fill(255) - Load(names + d));
    missed = Min(missed, Fill(255) - hit);
  }
  return {least, LeastLane(missed)};
}

/// True when no disparity but the winner and its neighbours costs `limit` or less.
inline bool StandsAlone(const Byte* sum, int wide, Byte index, Byte limit, const Byte* names) {
  const ByteLanes dear = Fill(limit);
  const ByteLanes first = Fill(static_cast<Byte>(index > 0 ? index - 1 : 0));
  const ByteLanes reach = Fill(index > 0 && index < 255 ? 2 : 1);
  ByteLanes rivals = Fill(0);
  for (int d = 0; d < wide; d += ByteLanes::kCount) {
    const ByteLanes beside = AtMost(Load(names + d) - first, reach);
    rivals = rivals | (AtMost(Load(sum + d), dear) & (beside ^ Fill(255)));
  }
  return !Any(rivals);
}

void ChooseRow(const Byte* sum, int columns, int blocks, double uniqueness_percent,
               const RowChoice& choice) {
  const int wide = blocks * kDisparityBlock;
  Byte limits[256];
  for (int cost = 0; cost < 256; ++cost) {
    const double limit = cost * 100.0 / (100.0 - uniqueness_percent);
    limits[cost] = static_cast<Byte>(limit < 255 ? limit : 255);
  }
  Byte names[256];
  for (int k = 0; k < 256; ++k) {
    names[k] = static_cast<Byte>(k);
  }
  for (int x = 0; x < columns; ++x) {
    const Byte* s = sum + static_cast<long>(x) * wide;
    const Winner winner = FindLeast(s, wide, names);
    choice.best[x] = winner.index;
    choice.cost[x] = winner.cost;
    choice.below[x] = winner.index > 0 ? s[winner.index - 1] : winner.cost;
    choice.above[x] = winner.index < wide - 1 ? s[winner.index + 1] : winner.cost;
    choice.unique[x] = StandsAlone(s, wide, winner.index, limits[winner.cost], names) ? 1 : 0;
  }
}

}  // namespace
}  // namespace palace
