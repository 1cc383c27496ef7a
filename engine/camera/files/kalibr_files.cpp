// EuRoC's sensor.yaml and Kalibr's camchain.yaml, which name lenses alike.
//
// EuRoC tells T_BS, the sensor's pose in the body: the model's frame F is the body, whose axes are
// the IMU's. Kalibr tells T_cn_cnm1, from the camera before to this one: F is the chain's first
// camera. Both count pixels as we do, (0,0) the centre of the top-left one.
// Source: Burri et al., The EuRoC micro aerial vehicle datasets, 2016; Kalibr's documentation of
// its YAML formats; Furgale et al. 2013.
#include <algorithm>
#include <cmath>
#include <string_view>

#include "engine/camera/camera_model.h"
#include "engine/camera/files/camera_file_formats.h"
#include "engine/core/frames.h"
#include "engine/core/text.h"
#include "engine/model/rig_limits.h"

namespace palace {
namespace {

using Limits = RigLimits;

/// The keys of one camera.
struct CameraKeys {
  std::string prefix;        ///< "cam1.", or empty in a file of one camera
  std::string coefficients;  ///< of the distortion, without prefix

  std::string operator()(const char* key) const { return prefix + key; }
};

/// A key outside of `known` may be one of these, misspelt, or a term that changes the lens.
Status CheckKeys(const KeyedText& text, const CameraKeys& keys,
                 const std::vector<std::string_view>& known) {
  std::string all;
  for (const std::string_view key : known) {
    all += (all.empty() ? "" : ", ") + std::string(key);
  }
  for (const std::string& key : text.Keys()) {
    if (!key.starts_with(keys.prefix)) {
      continue;
    }
    const std::string_view rest = std::string_view(key).substr(keys.prefix.size());
    const std::string_view name = rest.substr(0, rest.find('.'));
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      return text.Wrong(key, "unknown key; known are " + all +
                                 "; correct it, or delete it if it tells nothing of the lens");
    }
  }
  return Ok();
}

Status CheckLimits(const KeyedText& text, const std::string& key, double value, double least,
                   double most, const char* what) {
  return value >= least && value <= most
             ? Ok()
             : Status(text.Wrong(key, std::string(what) + " must lie within " + NumberText(least) +
                                          " .. " + NumberText(most)));
}

Status ReadIntrinsics(const KeyedText& text, const std::string& key, PinholeCamera& camera) {
  const auto values = text.Numbers(key, 4, 4);
  if (!values) {
    return values.error();
  }
  const std::vector<double>& v = *values;
  for (const double focal : {v[0], v[1]}) {
    if (Status good = CheckLimits(text, key, focal, Limits::kLeastFocal_px, Limits::kMostFocal_px,
                                  "the focal lengths fu fv");
        !good) {
      return good;
    }
  }
  for (const double centre : {v[2], v[3]}) {
    if (Status good = CheckLimits(text, key, centre, -Limits::kMostCentre_px,
                                  Limits::kMostCentre_px, "the principal point cu cv");
        !good) {
      return good;
    }
  }
  camera.fx_px = v[0];
  camera.fy_px = v[1];
  camera.cx_px = v[2];
  camera.cy_px = v[3];
  return Ok();
}

/// Of the lenses that such files name, those that OpenCvModel is exactly: radtan is its
/// k1 k2 p1 p2, equidistant its fisheye.
Status ReadLens(const KeyedText& text, const CameraKeys& keys, OpenCvModel& model) {
  const std::string projection = keys("camera_model"), distortion = keys("distortion_model");
  const std::string coefficients = keys.prefix + keys.coefficients;
  constexpr const char* kRead =
      "PALACE reads pinhole with radtan (radial-tangential), equidistant or none; calibrate for "
      "one of these";
  for (const std::string& key : {projection, distortion}) {
    if (!text.Has(key)) {
      return text.Missing(key, kRead);
    }
  }
  const std::string lens = text.Word(distortion);
  const bool is_fisheye = lens == "equidistant";
  if (text.Word(projection) != "pinhole") {
    return text.Wrong(projection, kRead);
  }
  if (!is_fisheye && lens != "radtan" && lens != "radial-tangential" && lens != "none") {
    return text.Wrong(distortion, kRead);
  }
  if (Status status = ReadIntrinsics(text, keys("intrinsics"), model.pinhole); !status) {
    return status;
  }
  if (lens == "none" && !text.Has(coefficients)) {
    return Ok();
  }
  const std::size_t count = lens == "none" ? 0 : 4;
  const auto values = text.Numbers(coefficients, count, count);
  if (!values) {
    return values.error();
  }
  for (const double k : *values) {
    if (Status good = CheckLimits(text, coefficients, k, -Limits::kMostDistortion,
                                  Limits::kMostDistortion, "coefficients");
        !good) {
      return good;
    }
  }
  std::copy(values->begin(), values->end(), model.k.begin());
  model.lens = is_fisheye ? OpenCvLens::kFisheye : OpenCvLens::kPolynomial;
  const bool all_zero =
      std::all_of(values->begin(), values->end(), [](double k) { return k == 0; });
  model.coefficients = all_zero && !is_fisheye ? 0 : 4;
  return Ok();
}

/// A 4x4 matrix [R p; 0 0 0 1].
Result<RigidTransform> ReadRigid(const KeyedText& text, const std::string& key) {
  const auto values = text.Numbers(key, 16, 16);
  if (!values) {
    return values.error();
  }
  const Eigen::Matrix4d T =
      Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(values->data());
  if (T.row(3) != Eigen::RowVector4d(0, 0, 0, 1)) {
    return text.Wrong(key, "the last row of a 4x4 pose must be 0 0 0 1");
  }
  RigidTransform X{T.topLeftCorner<3, 3>(), T.topRightCorner<3, 1>()};
  if (Status status = TakeRotation(text, key, X.R); !status) {
    return status.error();
  }
  for (const double offset_m : X.p) {
    if (Status good = CheckLimits(text, key, offset_m, -Limits::kMostPosition_m,
                                  Limits::kMostPosition_m, "the offset in metres");
        !good) {
      return good.error();
    }
  }
  return X;
}

/// The lens with its size.
Result<CameraModel> ReadCamera(const KeyedText& text, const CameraKeys& keys) {
  OpenCvModel model;
  if (Status status = ReadLens(text, keys, model); !status) {
    return status.error();
  }
  const auto size = ReadSides(text, keys("resolution"));
  if (!size) {
    return size.error();
  }
  if (const std::string rate = keys("rate_hz"); text.Has(rate)) {
    const auto rate_hz = text.Number(rate);
    const Status good = rate_hz ? CheckLimits(text, rate, *rate_hz, Limits::kLeastRate_hz,
                                              Limits::kMostRate_hz, "the rate in hertz")
                                : Status(rate_hz.error());
    if (!good) {
      return good.error();
    }
  }
  CameraModel camera{model, 1, false};
  SetSize(camera, size->width, size->height);
  return WithInternals(text, InternalsKeys::In(keys("intrinsics")), camera);
}

void Place(CameraModel& camera, const RigidTransform& X_CF) {
  auto& model = std::get<OpenCvModel>(camera.lens);
  model.R_CF = X_CF.R;
  model.t_CF = X_CF.p;
  camera.pose_is_known = true;
}

}  // namespace

Result<CameraModel> ReadEurocSensor(const KeyedText& text) {
  const CameraKeys keys{"", "distortion_coefficients"};
  if (text.Has("sensor_type") && text.Word("sensor_type") != "camera") {
    return text.Wrong("sensor_type", "no camera; give the sensor.yaml of cam0 or cam1");
  }
  if (Status status =
          CheckKeys(text, keys,
                    {"sensor_type", "comment", "T_BS", "rate_hz", "resolution", "camera_model",
                     "intrinsics", "distortion_model", "distortion_coefficients"});
      !status) {
    return status.error();
  }
  for (const char* key : {"T_BS.rows", "T_BS.cols"}) {
    if (const auto side = text.Count(key, 4, 4); text.Has(key) && !side) {
      return side.error();
    }
  }
  auto camera = ReadCamera(text, keys);
  if (!camera) {
    return camera.error();
  }
  const auto X_BS = ReadRigid(text, text.Has("T_BS.data") ? "T_BS.data" : "T_BS");
  if (!X_BS) {
    return X_BS.error();
  }
  Place(*camera, X_BS->Inverse());
  return camera;
}

Result<CameraModel> ReadKalibrChain(const KeyedText& text, const CameraFileOptions& options) {
  const bool is_pair = text.Has("cam0") && text.Has("cam1");
  if (is_pair && !options.side) {
    return InvalidError(text.file() +
                        ": holds two cameras (cam0, cam1); choose one with --camera left or right");
  }
  const bool is_right = options.side == StereoSide::kRight;
  const CameraKeys keys{is_right ? "cam1." : "cam0.", "distortion_coeffs"};
  if (!text.Has(is_right ? "cam1" : "cam0")) {
    return text.Missing(is_right ? "cam1" : "cam0",
                        "the left camera of a chain is cam0, the right one cam1 (a file cut short "
                        "lacks it too)");
  }
  if (Status status =
          CheckKeys(text, keys,
                    {"camera_model", "intrinsics", "distortion_model", "distortion_coeffs",
                     "resolution", "T_cn_cnm1", "T_cam_imu", "T_imu_cam", "timeshift_cam_imu",
                     "cam_overlaps", "rostopic", "rate_hz", "sensor_type", "comment"});
      !status) {
    return status.error();
  }
  auto camera = ReadCamera(text, keys);
  if (!camera || !is_right) {
    return camera;
  }
  const auto X_C1C0 = ReadRigid(text, keys("T_cn_cnm1"));
  if (!X_C1C0) {
    return X_C1C0.error();
  }
  Place(*camera, *X_C1C0);
  return camera;
}

Result<std::string> EurocSensorText(const CameraModel& camera, double rate_hz,
                                    const std::string& comment) {
  const auto* m = std::get_if<OpenCvModel>(&camera.lens);
  const bool fits =
      m != nullptr && std::all_of(m->k.begin() + 4, m->k.end(), [](double k) { return k == 0; });
  if (!fits || !HasSize(camera)) {
    return UsageError("an EuRoC sensor.yaml cannot hold a " + FamilyOf(camera) +
                      (fits ? " camera of unknown size" : " camera: its lenses have 4 terms"));
  }
  const Eigen::Matrix3d R_BC = m->R_CF.transpose();
  const Eigen::Vector3d p_BC = -(R_BC * m->t_CF) * camera.unit_m;
  std::string pose;
  for (int row = 0; row < 3; ++row) {
    const double values[] = {R_BC(row, 0), R_BC(row, 1), R_BC(row, 2), p_BC[row]};
    pose += Exact(values, 4, ", ") + ",\n         ";
  }
  const PinholeCamera& p = m->pinhole;
  const double intrinsics[] = {p.fx_px, p.fy_px, p.cx_px, p.cy_px};
  return "sensor_type: camera\ncomment: " + comment + "\n# the camera in the body\n" +
         "T_BS:\n  cols: 4\n  rows: 4\n  data: [" + pose +
         "0, 0, 0, 1]\nrate_hz: " + Exact(rate_hz) + "\nresolution: [" + std::to_string(p.width) +
         ", " + std::to_string(p.height) + "]\ncamera_model: pinhole\nintrinsics: [" +
         Exact(intrinsics, 4, ", ") + "]     # fu fv cu cv, pixels\ndistortion_model: " +
         (m->lens == OpenCvLens::kFisheye ? "equidistant" : "radial-tangential") +
         "\ndistortion_coefficients: [" + Exact(m->k.data(), 4, ", ") + "]\n";
}

}  // namespace palace
