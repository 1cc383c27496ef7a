// The tables of an EuRoC folder: data.csv of its cameras, IMU and ground truth.
//
// A row is a stamp in whole nanoseconds of any clock, which grows by a microsecond at least from row
// to row, and its values, with commas between; text from '#' on, the header with it, is a comment. Files hold at most
// 256 MiB. Errors name file, line, column, value and limit.
// Source: Burri et al. 2016 (euroc_frames.h, for the frames R and I); the data sets' own headers.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/frames.h"
#include "engine/core/result.h"

namespace palace {

struct EurocPicture {
  std::int64_t time_ns = 0;
  std::string file;  ///< in the folder data/
};

struct EurocState {
  std::int64_t time_ns = 0;
  RigidTransform X_RI;
  Eigen::Vector3d v_RI = Eigen::Vector3d::Zero();  ///< in R; 0 where the table has none
};

struct EurocInertial {
  std::int64_t time_ns = 0;
  Eigen::Vector3d angular_rate_I = Eigen::Vector3d::Zero();    ///< rad/s
  Eigen::Vector3d specific_force_I = Eigen::Vector3d::Zero();  ///< m/s^2, without gravity
};

/// Rows `stamp, file`. Refuses names that lead out of the folder, and a table without rows.
Result<std::vector<EurocPicture>> ReadEurocPictures(const std::filesystem::path& data_csv);
/// Rows `stamp, p_RS_R x y z, q_RS w x y z`, then nothing, or v_RS_R x y z, or that and the biases
/// of gyroscope and accelerometer, which are not read. Quaternions are brought to length 1; ones
/// that are 1 % off are refused.
Result<std::vector<EurocState>> ReadEurocStates(const std::filesystem::path& data_csv);
/// Rows `stamp, w x y z, a x y z`.
Result<std::vector<EurocInertial>> ReadEurocInertials(const std::filesystem::path& data_csv);

/// What is not between two rows at most this far apart has no pose.
inline constexpr std::int64_t kLongestStateGap_ns = 100'000'000;

/// The state at a moment (PoseBetween of the rows around it, velocity in between likewise); nothing
/// before the first row, after the last, or in a longer gap.
std::optional<EurocState> StateAt(const std::vector<EurocState>& states, std::int64_t time_ns);

}  // namespace palace
