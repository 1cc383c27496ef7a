// Writes a session as a folder in EuRoC's layout, for other people's programs and our own reader.
//
//   README.txt                               frames, units, what is truth and what is measured
//   mav0/cam0, mav0/cam1                     sensor.yaml, data.csv, data/<stamp>.png
//   mav0/cam0/depth/<stamp>.png              16 bit, millimetres along the left optical axis, of
//   the
//                                            left picture's pixels; 0: nothing, or beyond 65.535 m
//   mav0/imu0                                sensor.yaml, data.csv: as measured, with noise
//   mav0/state_groundtruth_estimate0         sensor.yaml, data.csv: the truth, with the IMU's
//   biases mav0/navigation0                         sensor.yaml, data.csv: the vehicle's own
//   solution
//
// Their body I is our B (forward, right, down), their world R is W turned (euroc_frames.h): x east,
// y north, z up. Stamps are those of the data in nanoseconds. Numbers have 17 digits.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include "engine/core/result.h"
#include "engine/model/frame_bundle.h"
#include "engine/model/image.h"

namespace palace {

/// What EuRoC tells of an IMU; zero random walks are biases that stand still.
struct EurocImu {
  double rate_hz = 100;
  double gyro_noise_rad_s_sqrt_hz = 0;
  double accel_noise_mps2_sqrt_hz = 0;
  double gyro_walk_rad_s2_sqrt_hz = 0;
  double accel_walk_mps3_sqrt_hz = 0;
  Eigen::Vector3d gyro_bias_rad_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d accel_bias_mps2 = Eigen::Vector3d::Zero();
};

/// One growing file.
class EurocTable {
 public:
  Status Open(const std::filesystem::path& path, const std::string& header);
  /// `values` begins with a comma.
  Status Add(Timestamp time, const std::string& values);
  Status Close();

 private:
  std::filesystem::path path_;
  std::ofstream file_;
};

class EurocWriter {
 public:
  /// Refuses a folder that holds a mav0 already, and rigs that sensor.yaml cannot hold. `comment`
  /// is the sensors', e.g. "simulated runway, seed 1".
  static Result<std::unique_ptr<EurocWriter>> Create(const std::filesystem::path& folder,
                                                     const StereoRig& rig, const EurocImu& imu,
                                                     const std::string& comment);

  /// Pictures, truth, IMU samples and poses of the bundle. `depth_m` may be null; it has the size
  /// of the left picture, NaN for nothing.
  Status Add(const FrameBundle& bundle, const ImageF* depth_m);
  /// Of the truth that is added from now on; those of EurocImu until then.
  void SetBiases(const Eigen::Vector3d& gyro_rad_s, const Eigen::Vector3d& accel_mps2) {
    imu_.gyro_bias_rad_s = gyro_rad_s;
    imu_.accel_bias_mps2 = accel_mps2;
  }
  /// After it the folder is whole.
  Status Close();
  /// In place of Close(): takes away what was written.
  void Remove();

  std::uint64_t pairs() const { return pairs_; }

 private:
  EurocWriter(std::filesystem::path mav0, const EurocImu& imu)
      : mav0_(std::move(mav0)), imu_(imu) {}
  Status OpenTables();
  Status AddPictures(const StereoFrame& frame, const ImageF* depth_m);

  const std::filesystem::path mav0_;
  EurocImu imu_;
  EurocTable left_, right_, inertial_, truth_, navigation_;
  std::uint64_t pairs_ = 0;
};

}  // namespace palace
