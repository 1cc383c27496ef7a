// A small folder in EuRoC's layout, written by hand. The IMU is mounted as on the data sets'
// sensor: x up, z ahead.
#pragma once

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "engine/core/frames.h"
#include "tests/support/own_path.h"

namespace palace {

/// Removed with the object.
class EurocSample {
 public:
  static constexpr std::int64_t kStart_ns = 1403636579763555584;

  EurocSample() : folder_(OwnPath()) {
    std::filesystem::remove_all(folder_);
    for (const char* part : {"cam0/data", "cam1/data", "imu0", "state_groundtruth_estimate0"}) {
      std::filesystem::create_directories(folder_ / "mav0" / part);
    }
    // The camera looks along z of the IMU; its right is y, its down -x of it.
    Sensor("cam0", "0, -1, 0, 0.02,  1, 0, 0, -0.06,  0, 0, 1, 0.01,  0, 0, 0, 1");
    Sensor("cam1", "0, -1, 0, 0.02,  1, 0, 0, 0.05,  0, 0, 1, 0.01,  0, 0, 0, 1");
  }
  ~EurocSample() { std::filesystem::remove_all(folder_); }
  EurocSample(const EurocSample&) = delete;
  EurocSample& operator=(const EurocSample&) = delete;

  void Sensor(const std::string& camera, const std::string& T_BS,
              const std::string& distortion = "-0.1, 0.01, 0, 0", int width = 32) {
    Write(camera + "/sensor.yaml",
          "sensor_type: camera\nT_BS:\n  cols: 4\n  rows: 4\n  data: [" + T_BS +
              "]\nrate_hz: 20\nresolution: [" + std::to_string(width) +
              ", 32]\ncamera_model: pinhole\nintrinsics: [40, 40, 15.5, 15.5]\n"
              "distortion_model: radial-tangential\ndistortion_coefficients: [" +
              distortion + "]\n");
  }
  void Write(const std::string& file, const std::string& text) {
    std::ofstream(folder_ / "mav0" / file, std::ios::binary) << text;
  }
  /// A picture of one grey, 50 ms after the one before.
  static std::int64_t Stamp(int index) { return kStart_ns + 50'000'000LL * index; }
  void Pictures(const std::string& camera, const std::vector<int>& indices, int grey) {
    std::string rows = "#timestamp [ns],filename\r\n";
    for (const int index : indices) {
      const std::string name = std::to_string(Stamp(index)) + ".png";
      rows += std::to_string(Stamp(index)) + "," + name + "\r\n";
      cv::imwrite((folder_ / "mav0" / camera / "data" / name).string(),
                  cv::Mat(32, 32, CV_8UC1, cv::Scalar(grey + index)));
    }
    Write(camera + "/data.csv", rows);
  }
  /// Rows every 10 ms from `first` to `last` ms: the place grows by 1 m a second along x of R.
  void States(int first_ms, int last_ms, const std::string& attitude = "0.5,-0.5,0.5,-0.5") {
    std::string rows = "#timestamp, p_RS_R_x [m], ...\n";
    for (int ms = first_ms; ms <= last_ms; ms += 10) {
      char row[160];
      std::snprintf(row, sizeof row, "%lld,%.6f,2,3,%s,1,0,0,0,0,0,0,0,0\n",
                    static_cast<long long>(kStart_ns + ms * 1'000'000LL), ms * 1e-3,
                    attitude.c_str());
      rows += row;
    }
    Write("state_groundtruth_estimate0/data.csv", rows);
  }
  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path folder_;
};

}  // namespace palace
