// Doubles side by side: 8 where the file is compiled for AVX-512, 4 for AVX2, 2 elsewhere. The
// scheme: instruction_sets.h.
#pragma once

#include <cstdint>

namespace palace {
namespace {  // each instruction set has its own

#if defined(__AVX512F__)
constexpr int kDoubleLaneBytes = 64;
#elif defined(__AVX2__)
constexpr int kDoubleLaneBytes = 32;
#else
constexpr int kDoubleLaneBytes = 16;
#endif

struct DoubleLanes {
  using Vector = double __attribute__((vector_size(kDoubleLaneBytes)));
  static constexpr int kCount = kDoubleLaneBytes / static_cast<int>(sizeof(double));
  Vector v;
};

inline DoubleLanes Load(const double* p) {
  DoubleLanes a;
  __builtin_memcpy(&a.v, p, sizeof a.v);
  return a;
}
inline void Store(double* p, DoubleLanes a) { __builtin_memcpy(p, &a.v, sizeof a.v); }
/// As many floats, exactly.
inline DoubleLanes Widened(const float* p) {
  using Floats = float __attribute__((vector_size(kDoubleLaneBytes / 2)));
  Floats a;
  __builtin_memcpy(&a, p, sizeof a);
  return {__builtin_convertvector(a, DoubleLanes::Vector)};
}
inline DoubleLanes FillDoubles(double value) {
  return {value - DoubleLanes::Vector{}};
}  // keeps -0
inline DoubleLanes operator+(DoubleLanes a, DoubleLanes b) { return {a.v + b.v}; }
inline DoubleLanes operator-(DoubleLanes a, DoubleLanes b) { return {a.v - b.v}; }
inline DoubleLanes operator*(DoubleLanes a, DoubleLanes b) { return {a.v * b.v}; }
/// Of the lanes where `a` is above 0; 0 elsewhere, also where it is NaN.
inline DoubleLanes WherePositive(DoubleLanes a, DoubleLanes value) {
  return {a.v > DoubleLanes::Vector{} ? value.v : DoubleLanes::Vector{}};
}

}  // namespace
}  // namespace palace
