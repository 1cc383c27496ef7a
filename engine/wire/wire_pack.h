// Small packing shared by the conversions. For .cpp files of this room only.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include <Eigen/Dense>

#include "engine/core/time.h"
#include "engine/wire/decode.h"
#include "engine/wire/wire_message.h"

namespace palace {

inline std::int64_t WireId(std::uint64_t id) { return std::bit_cast<std::int64_t>(id); }
inline std::uint64_t IdFromWire(std::int64_t id) { return std::bit_cast<std::uint64_t>(id); }

template <int N>
void Pack(const Eigen::Matrix<double, N, 1>& v, double (&out)[N]) {
  for (int i = 0; i < N; ++i) {
    out[i] = v[i];
  }
}
template <int N>
Eigen::Matrix<double, N, 1> Unpack(const double (&in)[N]) {
  return Eigen::Map<const Eigen::Matrix<double, N, 1>>(in);
}
template <std::size_t N>
void PackBytes(const std::array<std::uint8_t, N>& in, std::uint8_t (&out)[N]) {
  std::copy(in.begin(), in.end(), out);
}
template <std::size_t N>
std::array<std::uint8_t, N> UnpackBytes(const std::uint8_t (&in)[N]) {
  return std::to_array(in);
}
/// A boolean under a seal is 0 or 1: another byte of the same meaning would be another message.
inline bool IsBoolean(std::int8_t value) { return value == 0 || value == 1; }
/// Row by row.
inline void PackRotation(const Eigen::Matrix3d& R, double* out) {
  for (int i = 0; i < 9; ++i) {
    out[i] = R(i / 3, i % 3);
  }
}
inline Eigen::Matrix3d UnpackRotation(const double* in) {
  Eigen::Matrix3d R;
  for (int i = 0; i < 9; ++i) {
    R(i / 3, i % 3) = in[i];
  }
  return R;
}
/// Orthonormal to 1e-3 and right-handed; false for NaN.
inline bool IsRotation(const Eigen::Matrix3d& R) {
  return (R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < 1e-3 &&
         R.determinant() > 0;
}

template <typename T>
WireMessage MakeMessage(const std::string& channel, Timestamp time, const T& message) {
  return {channel, time, EncodePayload(message)};
}

/// Decodes and, when that worked, converts.
template <typename T, typename Convert>
auto DecodeAnd(const WireMessage& message, Convert convert)
    -> decltype(convert(std::declval<const T&>())) {
  const Result<T> decoded = DecodePayload<T>(message.payload);
  if (!decoded) {
    return Error{decoded.error().code, message.channel + ": " + decoded.error().message};
  }
  return convert(*decoded);
}

}  // namespace palace
