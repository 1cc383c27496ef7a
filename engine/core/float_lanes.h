// Floats side by side: 16 where the file is compiled for AVX-512, 8 for AVX2, 4 for every other
// x86-64, and the same by plain loops elsewhere. Each lane rounds as a lone float does, so all give
// the same bits.
#pragma once

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace palace {
namespace {  // each instruction set has its own

#if defined(__AVX512F__)

struct FloatLanes {
  static constexpr int kCount = 16;
  __m512 v;
};
struct LaneMask {
  __mmask16 v;
};

inline FloatLanes Load(const float* p) { return {_mm512_loadu_ps(p)}; }
inline void Store(float* p, FloatLanes a) { _mm512_storeu_ps(p, a.v); }
inline FloatLanes Fill(float value) { return {_mm512_set1_ps(value)}; }
inline FloatLanes operator+(FloatLanes a, FloatLanes b) { return {_mm512_add_ps(a.v, b.v)}; }
inline FloatLanes operator-(FloatLanes a, FloatLanes b) { return {_mm512_sub_ps(a.v, b.v)}; }
inline FloatLanes operator*(FloatLanes a, FloatLanes b) { return {_mm512_mul_ps(a.v, b.v)}; }
inline FloatLanes operator/(FloatLanes a, FloatLanes b) { return {_mm512_div_ps(a.v, b.v)}; }
/// The second where either is NaN.
inline FloatLanes Min(FloatLanes a, FloatLanes b) { return {_mm512_min_ps(a.v, b.v)}; }
inline FloatLanes Max(FloatLanes a, FloatLanes b) { return {_mm512_max_ps(a.v, b.v)}; }
inline FloatLanes Abs(FloatLanes a) { return {_mm512_abs_ps(a.v)}; }
inline LaneMask Less(FloatLanes a, FloatLanes b) {
  return {_mm512_cmp_ps_mask(a.v, b.v, _CMP_LT_OQ)};
}
inline LaneMask IsNan(FloatLanes a) { return {_mm512_cmp_ps_mask(a.v, a.v, _CMP_UNORD_Q)}; }
inline FloatLanes Select(LaneMask mask, FloatLanes yes, FloatLanes no) {
  return {_mm512_mask_blend_ps(mask.v, no.v, yes.v)};
}
inline bool Any(LaneMask mask) { return mask.v != 0; }

#elif defined(__AVX2__)

struct FloatLanes {
  static constexpr int kCount = 8;
  __m256 v;
};
using LaneMask = FloatLanes;

inline FloatLanes Load(const float* p) { return {_mm256_loadu_ps(p)}; }
inline void Store(float* p, FloatLanes a) { _mm256_storeu_ps(p, a.v); }
inline FloatLanes Fill(float value) { return {_mm256_set1_ps(value)}; }
inline FloatLanes operator+(FloatLanes a, FloatLanes b) { return {_mm256_add_ps(a.v, b.v)}; }
inline FloatLanes operator-(FloatLanes a, FloatLanes b) { return {_mm256_sub_ps(a.v, b.v)}; }
inline FloatLanes operator*(FloatLanes a, FloatLanes b) { return {_mm256_mul_ps(a.v, b.v)}; }
inline FloatLanes operator/(FloatLanes a, FloatLanes b) { return {_mm256_div_ps(a.v, b.v)}; }
inline FloatLanes Min(FloatLanes a, FloatLanes b) { return {_mm256_min_ps(a.v, b.v)}; }
inline FloatLanes Max(FloatLanes a, FloatLanes b) { return {_mm256_max_ps(a.v, b.v)}; }
inline FloatLanes Abs(FloatLanes a) { return {_mm256_andnot_ps(_mm256_set1_ps(-0.0F), a.v)}; }
inline LaneMask Less(FloatLanes a, FloatLanes b) { return {_mm256_cmp_ps(a.v, b.v, _CMP_LT_OQ)}; }
inline LaneMask IsNan(FloatLanes a) { return {_mm256_cmp_ps(a.v, a.v, _CMP_UNORD_Q)}; }
inline FloatLanes Select(LaneMask mask, FloatLanes yes, FloatLanes no) {
  return {_mm256_blendv_ps(no.v, yes.v, mask.v)};
}
inline bool Any(LaneMask mask) { return _mm256_movemask_ps(mask.v) != 0; }

#elif defined(__SSE2__)

struct FloatLanes {
  static constexpr int kCount = 4;
  __m128 v;
};
using LaneMask = FloatLanes;

inline FloatLanes Load(const float* p) { return {_mm_loadu_ps(p)}; }
inline void Store(float* p, FloatLanes a) { _mm_storeu_ps(p, a.v); }
inline FloatLanes Fill(float value) { return {_mm_set1_ps(value)}; }
inline FloatLanes operator+(FloatLanes a, FloatLanes b) { return {_mm_add_ps(a.v, b.v)}; }
inline FloatLanes operator-(FloatLanes a, FloatLanes b) { return {_mm_sub_ps(a.v, b.v)}; }
inline FloatLanes operator*(FloatLanes a, FloatLanes b) { return {_mm_mul_ps(a.v, b.v)}; }
inline FloatLanes operator/(FloatLanes a, FloatLanes b) { return {_mm_div_ps(a.v, b.v)}; }
inline FloatLanes Min(FloatLanes a, FloatLanes b) { return {_mm_min_ps(a.v, b.v)}; }
inline FloatLanes Max(FloatLanes a, FloatLanes b) { return {_mm_max_ps(a.v, b.v)}; }
inline FloatLanes Abs(FloatLanes a) { return {_mm_andnot_ps(_mm_set1_ps(-0.0F), a.v)}; }
inline LaneMask Less(FloatLanes a, FloatLanes b) { return {_mm_cmplt_ps(a.v, b.v)}; }
inline LaneMask IsNan(FloatLanes a) { return {_mm_cmpunord_ps(a.v, a.v)}; }
inline FloatLanes Select(LaneMask mask, FloatLanes yes, FloatLanes no) {
  return {_mm_or_ps(_mm_and_ps(mask.v, yes.v), _mm_andnot_ps(mask.v, no.v))};
}
inline bool Any(LaneMask mask) { return _mm_movemask_ps(mask.v) != 0; }

#else

struct FloatLanes {
  static constexpr int kCount = 4;
  float v[kCount];
};
struct LaneMask {
  bool v[FloatLanes::kCount];
};

template <typename Out, typename Rule>
inline Out EachLane(Rule rule) {
  Out out;
  for (int k = 0; k < FloatLanes::kCount; ++k) {
    out.v[k] = rule(k);
  }
  return out;
}
inline FloatLanes Load(const float* p) {
  return EachLane<FloatLanes>([=](int k) { return p[k]; });
}
inline void Store(float* p, FloatLanes a) {
  for (int k = 0; k < FloatLanes::kCount; ++k) {
    p[k] = a.v[k];
  }
}
inline FloatLanes Fill(float value) {
  return EachLane<FloatLanes>([=](int) { return value; });
}
inline FloatLanes operator+(FloatLanes a, FloatLanes b) {
  return EachLane<FloatLanes>([&](int k) { return a.v[k] + b.v[k]; });
}
inline FloatLanes operator-(FloatLanes a, FloatLanes b) {
  return EachLane<FloatLanes>([&](int k) { return a.v[k] - b.v[k]; });
}
inline FloatLanes operator*(FloatLanes a, FloatLanes b) {
  return EachLane<FloatLanes>([&](int k) { return a.v[k] * b.v[k]; });
}
inline FloatLanes operator/(FloatLanes a, FloatLanes b) {
  return EachLane<FloatLanes>([&](int k) { return a.v[k] / b.v[k]; });
}
inline FloatLanes Min(FloatLanes a, FloatLanes b) {
  return EachLane<FloatLanes>([&](int k) { return a.v[k] < b.v[k] ? a.v[k] : b.v[k]; });
}
inline FloatLanes Max(FloatLanes a, FloatLanes b) {
  return EachLane<FloatLanes>([&](int k) { return a.v[k] > b.v[k] ? a.v[k] : b.v[k]; });
}
inline FloatLanes Abs(FloatLanes a) {
  return EachLane<FloatLanes>([&](int k) { return a.v[k] < 0 ? -a.v[k] : a.v[k]; });
}
inline LaneMask Less(FloatLanes a, FloatLanes b) {
  return EachLane<LaneMask>([&](int k) { return a.v[k] < b.v[k]; });
}
inline LaneMask IsNan(FloatLanes a) {
  return EachLane<LaneMask>([&](int k) { return a.v[k] != a.v[k]; });
}
inline FloatLanes Select(LaneMask mask, FloatLanes yes, FloatLanes no) {
  return EachLane<FloatLanes>([&](int k) { return mask.v[k] ? yes.v[k] : no.v[k]; });
}
inline bool Any(LaneMask mask) {
  bool any = false;
  for (const bool lane : mask.v) {
    any = any || lane;
  }
  return any;
}

#endif

}  // namespace
}  // namespace palace
