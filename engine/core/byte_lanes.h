// Bytes side by side: 32 where the file is compiled for AVX2, 16 for every other x86-64, and the
// same by plain loops elsewhere. Sums wrap, as they do in a byte; masks are 255 or 0 in each lane.
#pragma once

#include <cstdint>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace palace {
namespace {  // each instruction set has its own

#if defined(__AVX2__)

struct Lanes {
  static constexpr int kCount = 32;
  __m256i v;
};

inline Lanes Load(const std::uint8_t* p) {
  return {_mm256_loadu_si256(reinterpret_cast<const __m256i*>(p))};
}
inline void Store(std::uint8_t* p, Lanes a) {
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), a.v);
}
inline Lanes Fill(std::uint8_t value) { return {_mm256_set1_epi8(static_cast<char>(value))}; }
inline Lanes Min(Lanes a, Lanes b) { return {_mm256_min_epu8(a.v, b.v)}; }
inline Lanes operator+(Lanes a, Lanes b) { return {_mm256_add_epi8(a.v, b.v)}; }
inline Lanes operator-(Lanes a, Lanes b) { return {_mm256_sub_epi8(a.v, b.v)}; }
inline Lanes operator&(Lanes a, Lanes b) { return {_mm256_and_si256(a.v, b.v)}; }
inline Lanes operator|(Lanes a, Lanes b) { return {_mm256_or_si256(a.v, b.v)}; }
inline Lanes operator^(Lanes a, Lanes b) { return {_mm256_xor_si256(a.v, b.v)}; }
inline Lanes Equal(Lanes a, Lanes b) { return {_mm256_cmpeq_epi8(a.v, b.v)}; }
/// Bits slide in from the byte beside: mask them off.
template <int kBits>
inline Lanes ShiftRight(Lanes a) {
  return {_mm256_srli_epi16(a.v, kBits)};
}
inline bool Any(Lanes mask) { return _mm256_movemask_epi8(mask.v) != 0; }
inline std::uint8_t LeastLane(Lanes a) {
  const __m128i half = _mm_min_epu8(_mm256_castsi256_si128(a.v), _mm256_extracti128_si256(a.v, 1));
  const __m128i pairs = _mm_min_epu8(half, _mm_srli_epi16(half, 8));   // upper bytes become 0 ..
  const __m128i words = _mm_and_si128(pairs, _mm_set1_epi16(0x00FF));  // .. and play no part
  return static_cast<std::uint8_t>(_mm_cvtsi128_si32(_mm_minpos_epu16(words)));
}

#elif defined(__SSE2__)

struct Lanes {
  static constexpr int kCount = 16;
  __m128i v;
};

inline Lanes Load(const std::uint8_t* p) {
  return {_mm_loadu_si128(reinterpret_cast<const __m128i*>(p))};
}
inline void Store(std::uint8_t* p, Lanes a) {
  _mm_storeu_si128(reinterpret_cast<__m128i*>(p), a.v);
}
inline Lanes Fill(std::uint8_t value) { return {_mm_set1_epi8(static_cast<char>(value))}; }
inline Lanes Min(Lanes a, Lanes b) { return {_mm_min_epu8(a.v, b.v)}; }
inline Lanes operator+(Lanes a, Lanes b) { return {_mm_add_epi8(a.v, b.v)}; }
inline Lanes operator-(Lanes a, Lanes b) { return {_mm_sub_epi8(a.v, b.v)}; }
inline Lanes operator&(Lanes a, Lanes b) { return {_mm_and_si128(a.v, b.v)}; }
inline Lanes operator|(Lanes a, Lanes b) { return {_mm_or_si128(a.v, b.v)}; }
inline Lanes operator^(Lanes a, Lanes b) { return {_mm_xor_si128(a.v, b.v)}; }
inline Lanes Equal(Lanes a, Lanes b) { return {_mm_cmpeq_epi8(a.v, b.v)}; }
template <int kBits>
inline Lanes ShiftRight(Lanes a) {
  return {_mm_srli_epi16(a.v, kBits)};
}
inline bool Any(Lanes mask) { return _mm_movemask_epi8(mask.v) != 0; }
inline std::uint8_t LeastLane(Lanes a) {
  __m128i least = _mm_min_epu8(a.v, _mm_srli_si128(a.v, 8));
  least = _mm_min_epu8(least, _mm_srli_si128(least, 4));
  least = _mm_min_epu8(least, _mm_srli_si128(least, 2));
  least = _mm_min_epu8(least, _mm_srli_si128(least, 1));
  return static_cast<std::uint8_t>(_mm_cvtsi128_si32(least));
}

#else

struct Lanes {
  static constexpr int kCount = 16;
  std::uint8_t v[kCount];
};

template <typename Rule>
inline Lanes EachLane(Rule rule) {
  Lanes out;
  for (int k = 0; k < Lanes::kCount; ++k) {
    out.v[k] = static_cast<std::uint8_t>(rule(k));
  }
  return out;
}
inline Lanes Load(const std::uint8_t* p) {
  return EachLane([=](int k) { return p[k]; });
}
inline void Store(std::uint8_t* p, Lanes a) {
  for (int k = 0; k < Lanes::kCount; ++k) {
    p[k] = a.v[k];
  }
}
inline Lanes Fill(std::uint8_t value) {
  return EachLane([=](int) { return value; });
}
inline Lanes Min(Lanes a, Lanes b) {
  return EachLane([&](int k) { return a.v[k] < b.v[k] ? a.v[k] : b.v[k]; });
}
inline Lanes operator+(Lanes a, Lanes b) {
  return EachLane([&](int k) { return a.v[k] + b.v[k]; });
}
inline Lanes operator-(Lanes a, Lanes b) {
  return EachLane([&](int k) { return a.v[k] - b.v[k]; });
}
inline Lanes operator&(Lanes a, Lanes b) {
  return EachLane([&](int k) { return a.v[k] & b.v[k]; });
}
inline Lanes operator|(Lanes a, Lanes b) {
  return EachLane([&](int k) { return a.v[k] | b.v[k]; });
}
inline Lanes operator^(Lanes a, Lanes b) {
  return EachLane([&](int k) { return a.v[k] ^ b.v[k]; });
}
inline Lanes Equal(Lanes a, Lanes b) {
  return EachLane([&](int k) { return a.v[k] == b.v[k] ? 255 : 0; });
}
template <int kBits>
inline Lanes ShiftRight(Lanes a) {
  return EachLane([&](int k) { return a.v[k] >> kBits; });
}
inline bool Any(Lanes mask) {
  std::uint8_t any = 0;
  for (const std::uint8_t lane : mask.v) {
    any = static_cast<std::uint8_t>(any | lane);
  }
  return any != 0;
}
inline std::uint8_t LeastLane(Lanes a) {
  std::uint8_t least = 255;
  for (const std::uint8_t lane : a.v) {
    least = lane < least ? lane : least;
  }
  return least;
}

#endif

/// 255 where a <= b.
inline Lanes AtMost(Lanes a, Lanes b) { return Equal(Min(a, b), a); }

}  // namespace
}  // namespace palace
