// Polynomials of lens distortion: where they can be inverted, and their inverse.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

namespace palace {

namespace internal {

/// Bernstein coefficients on [0, end] of the polynomial c: b_j = sum_i C(j,i)/C(N-1,i) c_i end^i.
template <std::size_t N>
std::array<double, N> BernsteinOn(const std::array<double, N>& c, double end) {
  std::array<double, N> b{};
  double power = 1;
  double choose_n = 1;  // C(N-1, i)
  for (std::size_t i = 0; i < N; ++i) {
    double choose_j = 1;  // C(j, i)
    for (std::size_t j = i; j < N; ++j) {
      b[j] += choose_j / choose_n * c[i] * power;
      choose_j = choose_j * static_cast<double>(j + 1) / static_cast<double>(j + 1 - i);
    }
    power *= end;
    choose_n = choose_n * static_cast<double>(N - 1 - i) / static_cast<double>(i + 1);
  }
  return b;
}

/// De Casteljau at the middle: `b` becomes the left half, the answer is the right one.
template <std::size_t N>
std::array<double, N> SplitInHalves(std::array<double, N>& b) {
  std::array<double, N> right{};
  for (std::size_t k = 0; k < N; ++k) {
    right[N - 1 - k] = b[N - 1];
    for (std::size_t j = N - 1; j > k; --j) {
      b[j] = (b[j - 1] + b[j]) / 2;
    }
  }
  return right;
}

template <std::size_t N>
bool AllPositive(const std::array<double, N>& b) {
  return std::all_of(b.begin(), b.end(), [](double value) { return value > 0; });
}

template <std::size_t N>
bool BernsteinIsPositive(std::array<double, N> b, int halvings) {
  if (!(b[0] > 0) || !(b[N - 1] > 0)) {
    return false;  // values at the ends
  }
  if (AllPositive(b)) {
    return true;
  }
  if (halvings == 0) {
    return false;
  }
  const std::array<double, N> right = SplitInHalves(b);
  return BernsteinIsPositive(b, halvings - 1) && BernsteinIsPositive(right, halvings - 1);
}

}  // namespace internal

/// True when c[0] + c[1] s + ... + c[N-1] s^(N-1) > 0 for all s of [0, end]. Bernstein coefficients
/// that are all positive prove it, an end value that is not disproves it, and what neither decides
/// is halved: toward 0 as often as a large `end` asks for, each part away from it `halvings` times
/// at most (a zero that only touches counts as one; where high powers of a factor make the
/// polynomial flat, more halvings would only divide rounding). False for NaN.
template <std::size_t N>
bool PositiveOn(const std::array<double, N>& c, double end, int halvings = 20) {
  constexpr int kHalvingsToZero = 100;
  std::array<double, N> b = internal::BernsteinOn(c, end);
  for (int i = 0; i < kHalvingsToZero; ++i) {
    if (!(b[0] > 0) || !(b[N - 1] > 0)) {
      return false;
    }
    if (internal::AllPositive(b)) {
      return true;
    }
    const std::array<double, N> right = internal::SplitInHalves(b);
    if (!internal::BernsteinIsPositive(right, halvings)) {
      return false;
    }
  }
  return false;
}

/// r (c[0] + c[1] r^2 + c[2] r^4 + ...): the radial distortion of a lens.
template <std::size_t N>
double RadialValue(const std::array<double, N>& c, double r) {
  double value = 0;
  for (std::size_t i = N; i-- > 0;) {
    value = value * r * r + c[i];
  }
  return value * r;
}

/// Coefficients in s = r^2 of the derivative of RadialValue.
template <std::size_t N>
std::array<double, N> RadialSlope(std::array<double, N> c) {
  for (std::size_t i = 0; i < N; ++i) {
    c[i] *= static_cast<double>(2 * i + 1);
  }
  return c;
}

/// The r >= 0 whose RadialValue is `target` >= 0, on the branch that rises from 0; nothing where
/// that branch ends before it. Newton's method inside a bracket.
template <std::size_t N>
std::optional<double> InvertRadial(const std::array<double, N>& c, double target) {
  if (!(target >= 0) || !std::isfinite(target) || !(c[0] > 0)) {
    return std::nullopt;
  }
  const std::array<double, N> slope = RadialSlope(c);
  double low = 0;
  std::optional<double> high;
  double r = target / c[0];
  for (int i = 0; i < 200 && std::isfinite(r); ++i) {
    double next = 0;
    if (!PositiveOn(slope, r * r)) {
      high = r;  // beyond the fold: the root, if any, lies below
      next = (low + r) / 2;
    } else {
      const double error = RadialValue(c, r) - target;
      if (error < 0) {
        low = r;
      } else {
        high = r;
      }
      double derivative = 0;
      for (std::size_t k = N; k-- > 0;) {
        derivative = derivative * r * r + slope[k];
      }
      next = r - error / derivative;
      if (std::abs(next - r) <= 1e-10 * r) {
        return next;  // quadratic convergence: the error is below rounding now
      }
      if (next <= low || (high && next >= *high)) {
        next = high ? (low + *high) / 2 : 2 * r;
      }
    }
    if (high && std::abs(next - r) <= 1e-15 * *high) {
      break;  // the bracket closed on the fold
    }
    r = next;
  }
  return std::nullopt;
}

}  // namespace palace
