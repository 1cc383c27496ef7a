// Bytes side by side: 32 where the file is compiled for AVX2, 16 elsewhere. Sums wrap, as they do
// in a byte; masks are 255 or 0 in each lane. The scheme: instruction_sets.h.
#pragma once

#include <cstdint>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace palace {
namespace {  // each instruction set has its own

#if defined(__AVX2__)
constexpr int kByteLaneBytes = 32;
#else
constexpr int kByteLaneBytes = 16;
#endif

struct ByteLanes {
  using Vector = std::uint8_t __attribute__((vector_size(kByteLaneBytes)));
  static constexpr int kCount = kByteLaneBytes;
  Vector v;
};

inline ByteLanes Load(const std::uint8_t* p) {
  ByteLanes a;
  __builtin_memcpy(&a.v, p, sizeof a.v);
  return a;
}
inline void Store(std::uint8_t* p, ByteLanes a) { __builtin_memcpy(p, &a.v, sizeof a.v); }
inline ByteLanes Fill(std::uint8_t value) { return {ByteLanes::Vector{} + value}; }
inline ByteLanes Min(ByteLanes a, ByteLanes b) { return {a.v < b.v ? a.v : b.v}; }
inline ByteLanes operator+(ByteLanes a, ByteLanes b) { return {a.v + b.v}; }
inline ByteLanes operator-(ByteLanes a, ByteLanes b) { return {a.v - b.v}; }
inline ByteLanes operator&(ByteLanes a, ByteLanes b) { return {a.v & b.v}; }
inline ByteLanes operator|(ByteLanes a, ByteLanes b) { return {a.v | b.v}; }
inline ByteLanes operator^(ByteLanes a, ByteLanes b) { return {a.v ^ b.v}; }
inline ByteLanes Equal(ByteLanes a, ByteLanes b) {
  return {reinterpret_cast<ByteLanes::Vector>(a.v == b.v)};
}
/// 255 where a <= b.
inline ByteLanes AtMost(ByteLanes a, ByteLanes b) { return Equal(Min(a, b), a); }
template <int kBits>
inline ByteLanes ShiftRight(ByteLanes a) {
  return {a.v >> kBits};
}
inline bool Any(ByteLanes mask) {
#if defined(__AVX2__)
  return _mm256_movemask_epi8(reinterpret_cast<__m256i>(mask.v)) != 0;
#elif defined(__SSE2__)
  return _mm_movemask_epi8(reinterpret_cast<__m128i>(mask.v)) != 0;
#else
  std::uint8_t any = 0;
  for (int k = 0; k < ByteLanes::kCount; ++k) {
    any = static_cast<std::uint8_t>(any | mask.v[k]);
  }
  return any != 0;
#endif
}
inline std::uint8_t LeastLane(ByteLanes a) {
#if defined(__AVX2__)
  const auto all = reinterpret_cast<__m256i>(a.v);
  const __m128i half = _mm_min_epu8(_mm256_castsi256_si128(all), _mm256_extracti128_si256(all, 1));
  const __m128i pairs = _mm_min_epu8(half, _mm_srli_epi16(half, 8));   // upper bytes become 0 ..
  const __m128i words = _mm_and_si128(pairs, _mm_set1_epi16(0x00FF));  // .. and play no part
  return static_cast<std::uint8_t>(_mm_cvtsi128_si32(_mm_minpos_epu16(words)));
#elif defined(__SSE2__)
  auto least = reinterpret_cast<__m128i>(a.v);
  least = _mm_min_epu8(least, _mm_srli_si128(least, 8));
  least = _mm_min_epu8(least, _mm_srli_si128(least, 4));
  least = _mm_min_epu8(least, _mm_srli_si128(least, 2));
  least = _mm_min_epu8(least, _mm_srli_si128(least, 1));
  return static_cast<std::uint8_t>(_mm_cvtsi128_si32(least));
#else
  std::uint8_t least = 255;
  for (int k = 0; k < ByteLanes::kCount; ++k) {
    least = a.v[k] < least ? a.v[k] : least;
  }
  return least;
#endif
}

}  // namespace
}  // namespace palace
