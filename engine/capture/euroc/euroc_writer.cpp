#include "engine/capture/euroc/euroc_writer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <opencv2/core.hpp>

#include "engine/camera/camera_model.h"
#include "engine/camera/files/camera_files.h"
#include "engine/camera/picture_writer.h"
#include "engine/capture/euroc/euroc_frames.h"
#include "engine/capture/picture_file.h"
#include "engine/core/files.h"

namespace palace {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPoseColumns =
    "#timestamp [ns],p_RS_R_x [m],p_RS_R_y [m],p_RS_R_z [m],q_RS_w [],q_RS_x [],q_RS_y [],q_RS_z "
    "[]";
constexpr const char* kReadMe =
    R"(A session of PALACE in the layout of the EuRoC data sets (Burri et al. 2016).

Stamps are nanoseconds of the data's own clock; a picture's name is its stamp. Both pictures of a
pair were exposed at the same moment.

mav0/cam0, mav0/cam1   left and right camera, 8-bit grey; T_BS is the camera (x right, y down, z
                       forward) in the body; pixel (0,0) is the centre of the top-left pixel
mav0/cam0/depth        true depth of the left picture: 16-bit PNG, millimetres along the optical
                       axis; 0 where there is nothing or beyond 65.535 m
mav0/imu0              the IMU as measured: angular rate rad/s, specific force m/s^2, in the body
mav0/state_groundtruth_estimate0
                       the truth: place and attitude of the body (w x y z), its velocity, and the
                       biases of the IMU
mav0/navigation0       place and attitude as the vehicle's own navigation had them

body    x forward, y right, z down; the IMU sits at its origin
world   x east, y north, z up; metres
)";

std::string StampText(Timestamp time) { return std::to_string(time.us) + "000"; }

Status CannotWrite(const fs::path& path) {
  return UnavailableError(path.string() + ": cannot be written; check folder and disk");
}

std::string Values(const double* values, Eigen::Index count) {
  std::string text;
  for (Eigen::Index i = 0; i < count; ++i) {
    char number[40];
    std::snprintf(number, sizeof number, ",%.17g", values[i]);
    text += number;
  }
  return text;
}
std::string Values(const Eigen::Vector3d& v) { return Values(v.data(), 3); }

/// p_RS_R and q_RS of a body at X_WB.
std::string PoseValues(const RigidTransform& X_WB) {
  const Eigen::Matrix3d R_RW = WorldFromEuroc();
  Eigen::Quaterniond q(Eigen::Matrix3d(R_RW * X_WB.R));
  if (q.w() < 0) {
    q.coeffs() *= -1;
  }
  const std::array<double, 4> wxyz = {q.w(), q.x(), q.y(), q.z()};
  return Values(R_RW * X_WB.p) + Values(wxyz.data(), 4);
}

CameraModel ModelOf(const RigCamera& camera, const RigidTransform& X_BC) {
  OpenCvModel model;
  model.pinhole = camera.pinhole;
  std::copy(camera.distortion.begin(), camera.distortion.end(), model.k.begin());
  model.coefficients = static_cast<int>(camera.distortion.size());
  model.R_CF = X_BC.R.transpose();
  model.t_CF = -(model.R_CF * X_BC.p);
  return {model};
}

/// Both cameras of a rig in B.
std::pair<CameraModel, CameraModel> CamerasInBody(const StereoRig& rig) {
  const RigidTransform X_BC = rig.X_BC();
  if (!rig.left.model || !rig.right.model) {
    const RigidTransform X_C0C1{Eigen::Matrix3d::Identity(), {rig.baseline_m, 0, 0}};
    return {ModelOf(rig.left, X_BC), ModelOf(rig.right, X_BC * X_C0C1)};
  }
  const Eigen::Matrix3d R_C0F = RotationOf(*rig.left.model);
  const RigidTransform X_C0F{R_C0F, -(R_C0F * CentreOf(*rig.left.model))};
  const RigidTransform X_BF = X_BC * X_C0F;
  return {MovedCamera(*rig.left.model, X_BF.R, X_BF.p),
          MovedCamera(*rig.right.model, X_BF.R, X_BF.p)};
}

/// sensor.yaml of a sensor that is the body itself.
std::string BodySensorText(const std::string& type, const std::string& comment,
                           const std::string& rest) {
  return "sensor_type: " + type + "\ncomment: " + comment +
         "\nT_BS:\n  cols: 4\n  rows: 4\n"
         "  data: [1, 0, 0, 0,\n         0, 1, 0, 0,\n         0, 0, 1, 0,\n"
         "         0, 0, 0, 1]\n" +
         rest;
}

std::string ImuText(const EurocImu& imu, const std::string& comment) {
  char rest[500];
  std::snprintf(rest, sizeof rest,
                "rate_hz: %.17g\ngyroscope_noise_density: %.17g     # rad/s/sqrt(Hz)\n"
                "gyroscope_random_walk: %.17g     # rad/s^2/sqrt(Hz)\n"
                "accelerometer_noise_density: %.17g     # m/s^2/sqrt(Hz)\n"
                "accelerometer_random_walk: %.17g     # m/s^3/sqrt(Hz)\n",
                imu.rate_hz, imu.gyro_noise_rad_s_sqrt_hz, imu.gyro_walk_rad_s2_sqrt_hz,
                imu.accel_noise_mps2_sqrt_hz, imu.accel_walk_mps3_sqrt_hz);
  return BodySensorText("imu", comment, rest);
}

/// Millimetres; 0 for what 16 bits do not hold.
Status WriteDepth(const fs::path& path, const ImageF& depth_m) {
  constexpr double kMost_mm = 65535;
  cv::Mat depth(depth_m.height(), depth_m.width(), CV_16UC1);
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      const double mm = std::round(static_cast<double>(depth_m.at(x, y)) * 1000);
      depth.at<std::uint16_t>(y, x) =
          mm > 0 && mm <= kMost_mm ? static_cast<std::uint16_t>(mm) : std::uint16_t{0};
    }
  }
  return WritePicture(path, depth);
}

/// The first that failed.
Status Each(std::initializer_list<Status> results) {
  for (const Status& status : results) {
    if (!status) {
      return status;
    }
  }
  return Ok();
}

}  // namespace

Status EurocTable::Open(const fs::path& path, const std::string& header) {
  path_ = path;
  file_.open(path, std::ios::binary);
  file_ << header << '\n';
  return file_ ? Ok() : CannotWrite(path_);
}

Status EurocTable::Add(Timestamp time, const std::string& values) {
  file_ << StampText(time) << values << '\n' << std::flush;  // a killed export has its rows
  return file_ ? Ok() : CannotWrite(path_);
}

Status EurocTable::Close() {
  file_.close();
  return file_ ? Ok() : CannotWrite(path_);
}

Result<std::unique_ptr<EurocWriter>> EurocWriter::Create(const fs::path& folder,
                                                         const StereoRig& rig, const EurocImu& imu,
                                                         const std::string& comment) {
  const fs::path mav0 = folder / "mav0";
  std::error_code code;
  if (fs::exists(mav0, code)) {
    return UsageError(mav0.string() + ": there is one already; choose another folder");
  }
  const auto [left, right] = CamerasInBody(rig);
  const auto left_text = EurocSensorText(left, rig.rate_hz, comment + ", left camera");
  const auto right_text = EurocSensorText(right, rig.rate_hz, comment + ", right camera");
  if (!left_text || !right_text) {
    return left_text ? right_text.error() : left_text.error();
  }
  for (const char* part : {"cam0/data", "cam0/depth", "cam1/data", "imu0",
                           "state_groundtruth_estimate0", "navigation0"}) {
    if (const Status made = MakeFolder(mav0 / part); !made) {
      return made.error();
    }
  }
  const Status texts =
      Each({WriteTextFile(folder / "README.txt", kReadMe),
            WriteTextFile(mav0 / "cam0/sensor.yaml", *left_text),
            WriteTextFile(mav0 / "cam1/sensor.yaml", *right_text),
            WriteTextFile(mav0 / "imu0/sensor.yaml", ImuText(imu, comment + ", IMU")),
            WriteTextFile(mav0 / "state_groundtruth_estimate0/sensor.yaml",
                          BodySensorText("visual-inertial", comment + ", truth", "")),
            WriteTextFile(mav0 / "navigation0/sensor.yaml",
                          BodySensorText("pose", comment + ", the vehicle's navigation", ""))});
  if (!texts) {
    return texts.error();
  }
  std::unique_ptr<EurocWriter> writer(new EurocWriter(mav0, imu));
  if (const Status opened = writer->OpenTables(); !opened) {
    return opened.error();
  }
  return writer;
}

Status EurocWriter::OpenTables() {
  const std::string pose = kPoseColumns;
  return Each(
      {left_.Open(mav0_ / "cam0/data.csv", "#timestamp [ns],filename"),
       right_.Open(mav0_ / "cam1/data.csv", "#timestamp [ns],filename"),
       inertial_.Open(mav0_ / "imu0/data.csv",
                      "#timestamp [ns],w_RS_S_x [rad s^-1],w_RS_S_y [rad s^-1],"
                      "w_RS_S_z [rad s^-1],a_RS_S_x [m s^-2],a_RS_S_y [m s^-2],"
                      "a_RS_S_z [m s^-2]"),
       truth_.Open(mav0_ / "state_groundtruth_estimate0/data.csv",
                   pose + ",v_RS_R_x [m s^-1],v_RS_R_y [m s^-1],v_RS_R_z [m s^-1],"
                          "b_w_RS_S_x [rad s^-1],b_w_RS_S_y [rad s^-1],b_w_RS_S_z [rad s^-1],"
                          "b_a_RS_S_x [m s^-2],b_a_RS_S_y [m s^-2],b_a_RS_S_z [m s^-2]"),
       navigation_.Open(mav0_ / "navigation0/data.csv", pose)});
}

Status EurocWriter::AddPictures(const StereoFrame& frame, const ImageF* depth_m) {
  const std::string name = StampText(frame.time) + ".png";
  ++pairs_;
  const Status pictures =
      Each({WriteGreyPicture(mav0_ / "cam0/data" / name, frame.left),
            WriteGreyPicture(mav0_ / "cam1/data" / name, frame.right),
            left_.Add(frame.time, "," + name), right_.Add(frame.time, "," + name)});
  return pictures && depth_m != nullptr ? WriteDepth(mav0_ / "cam0/depth" / name, *depth_m)
                                        : pictures;
}

Status EurocWriter::Add(const FrameBundle& bundle, const ImageF* depth_m) {
  for (const ImuSample& sample : bundle.imu) {
    if (const Status added = inertial_.Add(
            sample.time, Values(sample.angular_rate_B) + Values(sample.specific_force_B));
        !added) {
      return added;
    }
  }
  for (const Truth& truth : bundle.truth) {
    if (const Status added =
            truth_.Add(truth.time, PoseValues(truth.X_WB) + Values(WorldFromEuroc() * truth.v_WB) +
                                       Values(imu_.gyro_bias_rad_s) + Values(imu_.accel_bias_mps2));
        !added) {
      return added;
    }
  }
  for (const VehiclePose& pose : bundle.poses) {
    if (const Status added = navigation_.Add(pose.time, PoseValues(pose.X_WB)); !added) {
      return added;
    }
  }
  return bundle.stereo ? AddPictures(*bundle.stereo, depth_m) : Ok();
}

void EurocWriter::Remove() {
  std::error_code ignored;
  fs::remove_all(mav0_, ignored);
  fs::remove(mav0_.parent_path() / "README.txt", ignored);
}

Status EurocWriter::Close() {
  return Each(
      {left_.Close(), right_.Close(), inertial_.Close(), truth_.Close(), navigation_.Close()});
}

}  // namespace palace
