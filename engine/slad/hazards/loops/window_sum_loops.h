// Sums of neighbouring columns, the order of the additions given by the width alone. Included by
// moment_loops.h only.
#pragma once

#include <utility>

#include "engine/core/lanes/double_lanes.h"
#include "engine/slad/hazards/loops/slad_loops.h"

namespace palace {
namespace {

/// sums[c] = columns[c] + .. + columns[c + width - 1], from runs of 1, 2, 4 .. columns. Any odd
/// width.
inline void WindowSumsOfAny(const double* columns, int half, int count, double* __restrict__ work,
                            double* __restrict__ sums) {
  const int length = count + 2 * half, width = 2 * half + 1;
  for (int c = 0; c < count; ++c) {
    sums[c] = columns[c];
  }
  for (int k = 0; k + 2 <= length; ++k) {
    work[k] = columns[k] + columns[k + 1];
  }
  int offset = 1;
  for (int run = 2; run <= width; run *= 2) {
    if ((width & run) != 0) {
      for (int c = 0; c < count; ++c) {
        sums[c] += work[c + offset];
      }
      offset += run;
    }
    if (2 * run <= width) {
      for (int k = 0; k + 2 * run <= length; ++k) {
        work[k] += work[k + run];
      }
    }
  }
}

/// Lanes kFirst .. of two lanes side by side.
template <int kFirst, int... k>
inline DoubleLanes Shifted(DoubleLanes a, DoubleLanes b, std::integer_sequence<int, k...>) {
  return {__builtin_shufflevector(a.v, b.v, (kFirst + k)...)};
}

/// The same sums of kSolveRun columns, for one width: the runs stay in registers.
template <int kHalf>
void WindowSumsOf(const double* columns, double* sums) {
  constexpr int kLanes = DoubleLanes::kCount, kWidth = 2 * kHalf + 1;
  constexpr int kBlocks = 8, kRead = kBlocks + (2 * kHalf + kLanes - 1) / kLanes;
  using Lanes = std::make_integer_sequence<int, kLanes>;
  for (int c = 0; c < kSolveRun; c += kBlocks * kLanes) {
    DoubleLanes run[kRead], sum[kBlocks];
    for (int j = 0; j < kRead; ++j) {
      run[j] = Load(columns + c + j * kLanes);
    }
    for (int j = 0; j < kBlocks; ++j) {
      sum[j] = run[j];
    }
    const auto behind = [&]<int kOffset>(int j) __attribute__((always_inline)) {
      const int near = j + kOffset / kLanes;
      if constexpr (kOffset % kLanes == 0) {
        return run[near];
      } else {
        return Shifted<kOffset % kLanes>(run[near], run[near + 1 < kRead ? near + 1 : near],
                                         Lanes{});
      }
    };
    const auto add = [&]<int kRun, int kOffset>(auto& self) __attribute__((always_inline)) {
      if constexpr (kRun <= kWidth) {
        constexpr int kHalfRun = kRun / 2, kKept = kRead - kHalfRun / kLanes;
#pragma GCC unroll 32
        for (int j = 0; j < kKept; ++j) {
          run[j] = run[j] + behind.template operator()<kHalfRun>(j);
        }
        if constexpr ((kWidth & kRun) != 0) {
#pragma GCC unroll 8
          for (int j = 0; j < kBlocks; ++j) {
            sum[j] = sum[j] + behind.template operator()<kOffset>(j);
          }
        }
        self.template operator()<2 * kRun, kOffset + ((kWidth & kRun) != 0 ? kRun : 0)>(self);
      }
    };
    add.template operator()<2, 1>(add);
    for (int j = 0; j < kBlocks; ++j) {
      Store(sums + c + j * kLanes, sum[j]);
    }
  }
}

constexpr int kMostUnrolled = 12;

/// sums[c] = columns[c - half] + .. + columns[c + half] of kSolveRun columns. work: kSolveRun + 2
/// half.
inline void WindowSums(const double* columns, int half, double* work, double* sums) {
  if (half >= 1 && half <= kMostUnrolled) {
    [&]<int... of>(std::integer_sequence<int, of...>) {
      using Sums = void (*)(const double*, double*);
      static constexpr Sums by_half[] = {WindowSumsOf<of + 1>...};
      by_half[half - 1](columns - half, sums);
    }
    (std::make_integer_sequence<int, kMostUnrolled>{});
  } else {
    WindowSumsOfAny(columns - half, half, kSolveRun, work, sums);
  }
}

}  // namespace
}  // namespace palace
