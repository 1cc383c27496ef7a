// Floats side by side: 16 where the file is compiled for AVX-512, 8 for AVX2, 4 elsewhere. The
// scheme: instruction_sets.h.
#pragma once

#include <cstdint>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace palace {
namespace {  // each instruction set has its own

#if defined(__AVX512F__)
constexpr int kFloatLaneBytes = 64;
#elif defined(__AVX2__)
constexpr int kFloatLaneBytes = 32;
#else
constexpr int kFloatLaneBytes = 16;
#endif

struct FloatLanes {
  using Vector = float __attribute__((vector_size(kFloatLaneBytes)));
  static constexpr int kCount = kFloatLaneBytes / static_cast<int>(sizeof(float));
  Vector v;
};
/// All bits of a lane, or none.
struct LaneMask {
  using Vector = std::int32_t __attribute__((vector_size(kFloatLaneBytes)));
  Vector v;
};

inline FloatLanes Load(const float* p) {
  FloatLanes a;
  __builtin_memcpy(&a.v, p, sizeof a.v);
  return a;
}
inline void Store(float* p, FloatLanes a) { __builtin_memcpy(p, &a.v, sizeof a.v); }
inline FloatLanes Fill(float value) { return {value - FloatLanes::Vector{}}; }  // keeps -0
inline FloatLanes operator+(FloatLanes a, FloatLanes b) { return {a.v + b.v}; }
inline FloatLanes operator-(FloatLanes a, FloatLanes b) { return {a.v - b.v}; }
inline FloatLanes operator*(FloatLanes a, FloatLanes b) { return {a.v * b.v}; }
inline FloatLanes operator/(FloatLanes a, FloatLanes b) { return {a.v / b.v}; }
/// a + b to the same bits, by the multiplier where it adds too: Min, Max and + share one pair of
/// units on AMD Zen (measured: 1 a cycle together, 2 with multiplications between).
inline FloatLanes AddFused(FloatLanes a, FloatLanes b) {
#if defined(__AVX512F__)
  return {_mm512_fmadd_ps(a.v, _mm512_set1_ps(1), b.v)};
#else
  return a + b;
#endif
}
/// a - b likewise.
inline FloatLanes SubtractFused(FloatLanes a, FloatLanes b) {
#if defined(__AVX512F__)
  return {_mm512_fmsub_ps(a.v, _mm512_set1_ps(1), b.v)};
#else
  return a - b;
#endif
}
/// The second where either is NaN: a < b ? a : b, which compilers do not always take for one
/// instruction.
inline FloatLanes Min(FloatLanes a, FloatLanes b) {
#if defined(__AVX512F__)
  return {_mm512_min_ps(a.v, b.v)};
#elif defined(__AVX2__)
  return {_mm256_min_ps(a.v, b.v)};
#elif defined(__SSE2__)
  return {_mm_min_ps(a.v, b.v)};
#else
  return {a.v < b.v ? a.v : b.v};
#endif
}
inline FloatLanes Max(FloatLanes a, FloatLanes b) {
#if defined(__AVX512F__)
  return {_mm512_max_ps(a.v, b.v)};
#elif defined(__AVX2__)
  return {_mm256_max_ps(a.v, b.v)};
#elif defined(__SSE2__)
  return {_mm_max_ps(a.v, b.v)};
#else
  return {a.v > b.v ? a.v : b.v};
#endif
}
inline FloatLanes Abs(FloatLanes a) {
  const LaneMask::Vector no_sign = LaneMask::Vector{} + 0x7FFFFFFF;
  return {reinterpret_cast<FloatLanes::Vector>(reinterpret_cast<LaneMask::Vector>(a.v) & no_sign)};
}
inline FloatLanes SquareRoot(FloatLanes a) {
#if defined(__AVX512F__)
  return {_mm512_sqrt_ps(a.v)};
#elif defined(__AVX2__)
  return {_mm256_sqrt_ps(a.v)};
#elif defined(__SSE2__)
  return {_mm_sqrt_ps(a.v)};
#else
  for (int k = 0; k < FloatLanes::kCount; ++k) {
    a.v[k] = __builtin_sqrtf(a.v[k]);
  }
  return a;
#endif
}
inline LaneMask Less(FloatLanes a, FloatLanes b) { return {a.v < b.v}; }
inline LaneMask Differ(FloatLanes a, FloatLanes b) { return {a.v != b.v}; }  // also of NaN
inline LaneMask IsNan(FloatLanes a) { return {a.v != a.v}; }
inline FloatLanes Select(LaneMask mask, FloatLanes yes, FloatLanes no) {
  return {mask.v ? yes.v : no.v};
}
inline bool Any(LaneMask mask) {
#if defined(__AVX512F__)
  const auto all = reinterpret_cast<__m512i>(mask.v);
  return _mm512_test_epi32_mask(all, all) != 0;
#elif defined(__AVX2__)
  return _mm256_movemask_ps(reinterpret_cast<__m256>(mask.v)) != 0;
#elif defined(__SSE2__)
  return _mm_movemask_ps(reinterpret_cast<__m128>(mask.v)) != 0;
#else
  std::int32_t any = 0;
  for (int k = 0; k < FloatLanes::kCount; ++k) {
    any |= mask.v[k];
  }
  return any != 0;
#endif
}

}  // namespace
}  // namespace palace
