#include "engine/camera/files/rig_file.h"

#include <cmath>
#include <set>
#include <vector>

#include "engine/camera/camera_pair.h"
#include "engine/camera/files/camera_files.h"
#include "engine/core/files.h"
#include "engine/core/plain_text.h"
#include "engine/core/text.h"
#include "engine/core/toml_table.h"
#include "engine/core/toml_text.h"
#include "engine/core/units.h"
#include "engine/model/rig_limits.h"

namespace palace {
namespace {

using Limits = RigLimits;
constexpr double kBaselineMismatch = 0.01;  // share by which baseline_m may differ from the models

constexpr NumberLimits kSide{Limits::kLeastSide_px, Limits::kMostSide_px,
                             "give the size of the pictures in pixels", true};
constexpr NumberLimits kFocal{Limits::kLeastFocal_px, Limits::kMostFocal_px,
                              "give the focal length in pixels"};
constexpr NumberLimits kCentre{-Limits::kMostCentre_px, Limits::kMostCentre_px,
                               "give the principal point in pixels"};
constexpr NumberLimits kDistortion{-Limits::kMostDistortion, Limits::kMostDistortion,
                                   "give k1 k2 p1 p2 k3 as OpenCV does"};
constexpr NumberLimits kBaseline{Limits::kLeastBaseline_m, Limits::kMostBaseline_m,
                                 "give the distance of the cameras in metres"};
constexpr NumberLimits kTilt{-90, 0, "the tilt is negative downwards: 0 horizon, -90 nadir"};
constexpr NumberLimits kPosition{-Limits::kMostPosition_m, Limits::kMostPosition_m,
                                 "give metres forward, right, down of the reference point"};
constexpr NumberLimits kMinDisparity{0, Limits::kMostSide_px,
                                     "give the least disparity in whole pixels", true};
constexpr NumberLimits kCount{0, Limits::kMostDisparities,
                              "give a multiple of 16, or 0 to follow the pose", true};
constexpr NumberLimits kAngle{-360, 360, "give degrees"};
constexpr NumberLimits kPitch{-90, 90, "give degrees"};
constexpr NumberLimits kPoseHeight{1e-3, 1e5, "give metres above the ground"};
constexpr NumberLimits kRate{Limits::kLeastRate_hz, Limits::kMostRate_hz, "give pairs per second"};
constexpr NumberLimits kTolerance{0.01, 10000,
                                  "give the largest time between the pictures of a pair"};

/// The cameras that model files tell, until both are placed in one frame.
struct ModelFiles {
  std::optional<CameraModel> left;
  std::optional<CameraModel> right;
  std::string left_name;
  std::string right_name;
};

Status ReadModelFile(TomlTable& table, const RigFile& file, StereoSide side, ModelFiles& models) {
  for (const char* key : {"fx_px", "fy_px", "cx_px", "cy_px", "distortion"}) {
    if (table.Has(key)) {
      table.FailKey(key, " contradicts model_file; give one of them");
    }
    table.Allow(key);
  }
  CameraFileOptions options;
  options.side = side;
  for (const char* key : {"width", "height"}) {
    table.Allow(key);
  }
  if (table.Has("width") || table.Has("height")) {  // for files that tell no size
    options.size.width = static_cast<int>(table.Number("width", kSide));
    options.size.height = static_cast<int>(table.Number("height", kSide));
  }
  const std::string model_file = table.Text("model_file");
  if (Status status = table.Finish(); !status) {
    return status;
  }
  const std::filesystem::path path = file.folder / model_file;
  auto model = ReadCameraFile(path, options);
  if (!model) {
    return model.error();
  }
  if (!HasSize(*model)) {
    table.FailKey("model_file", " = " + model_file +
                                    ": the file tells no picture size; add width and height here");
    return table.Finish();
  }
  (side == StereoSide::kLeft ? models.left : models.right) = *model;
  (side == StereoSide::kLeft ? models.left_name : models.right_name) = path.string();
  return Ok();
}

Status ReadCamera(const toml::table& root, const std::string& name, StereoSide side,
                  const RigFile& file, RigCamera& camera, ModelFiles& models) {
  TomlTable table(root, name, side == StereoSide::kLeft ? "left" : "right");
  if (table.Has("model_file")) {
    return ReadModelFile(table, file, side, models);
  }
  table.Allow("model_file");
  PinholeCamera& pinhole = camera.pinhole;
  pinhole.width = static_cast<int>(table.Number("width", kSide));
  pinhole.height = static_cast<int>(table.Number("height", kSide));
  pinhole.fx_px = table.Number("fx_px", kFocal);
  pinhole.fy_px = table.Number("fy_px", kFocal);
  pinhole.cx_px = table.Number("cx_px", kCentre);
  pinhole.cy_px = table.Number("cy_px", kCentre);
  table.Allow("distortion");
  if (table.Has("distortion")) {
    const std::vector<double> values = table.Numbers("distortion", 4, 5, kDistortion);
    std::copy(values.begin(), values.end(), camera.distortion.begin());
  }
  return table.Finish();
}

bool Distorted(const RigCamera& camera) {
  return camera.model || camera.distortion != std::array<double, 5>{};
}

/// The baseline, and the cameras of model files placed by it.
Status ReadBaseline(TomlTable& table, const ModelFiles& models, StereoRig& rig) {
  if (!models.left || !models.right) {
    rig.baseline_m = table.Number("baseline_m", kBaseline);
    return Ok();
  }
  table.Allow("baseline_m");
  std::optional<double> told;
  if (table.Has("baseline_m")) {
    told = table.Number("baseline_m", kBaseline);
  }
  const auto pair =
      PlacePair(*models.left, *models.right, told, models.left_name, models.right_name);
  if (!pair) {
    return pair.error();
  }
  rig.left = RigCameraOf(pair->left);
  rig.right = RigCameraOf(pair->right);
  const double of_models = (CentreOf(pair->right) - CentreOf(pair->left)).norm();
  rig.baseline_m = told.value_or(of_models);
  if (!(std::abs(rig.baseline_m - of_models) <= kBaselineMismatch * of_models)) {
    table.FailKey("baseline_m", " = " + NumberText(rig.baseline_m) + " m, the camera models are " +
                                    NumberText(of_models) +
                                    " m apart; leave the key out or correct it");
  }
  return Ok();
}

Status ReadRig(const toml::table& root, const std::string& name, const ModelFiles& models,
               StereoRig& rig) {
  if (models.left.has_value() != models.right.has_value()) {
    return InvalidError(name +
                        ": one camera has a model_file and the other has not; give both or none");
  }
  TomlTable table(root, name, "rig");
  if (Status status = ReadBaseline(table, models, rig); !status) {
    return status;
  }
  const bool distorted = Distorted(rig.left) || Distorted(rig.right);
  table.Allow("rectified");
  rig.rectified = table.BoolOr("rectified", !distorted);
  if (rig.rectified && distorted) {
    table.FailKey("rectified",
                  " = true contradicts a model_file or distortion; rectified pictures have none");
  }
  for (const char* key : {"min_disparity_px", "num_disparities"}) {
    table.Allow(key);
  }
  rig.min_disparity_px = static_cast<int>(table.NumberOr("min_disparity_px", kMinDisparity, 0));
  rig.num_disparities = static_cast<int>(table.NumberOr("num_disparities", kCount, 0));
  if (rig.num_disparities % 16 != 0) {
    table.FailKey("num_disparities", " = " + std::to_string(rig.num_disparities) +
                                         " must be a multiple of 16, or 0 to follow the pose");
  }
  if (rig.min_disparity_px >= rig.left.pinhole.width) {
    table.FailKey("min_disparity_px", " = " + std::to_string(rig.min_disparity_px) +
                                          " must be less than the picture's width " +
                                          std::to_string(rig.left.pinhole.width));
  }
  return table.Finish();
}

Status ReadMount(const toml::table& root, const std::string& name, StereoRig& rig) {
  TomlTable table(root, name, "mount");
  rig.tilt_rad = Rad(table.Number("tilt_deg", kTilt));
  table.Allow("position_body_m");
  if (table.Has("position_body_m")) {
    const std::vector<double> p = table.Numbers("position_body_m", 3, 3, kPosition);
    if (p.size() == 3) {
      rig.position_body_m = {p[0], p[1], p[2]};
    }
  }
  return table.Finish();
}

Status ReadPose(const toml::table& root, const std::string& name, RigFile& file) {
  TomlTable table(root, name, "pose");
  if (table.present()) {
    EulerAngles attitude;
    attitude.roll_rad = Rad(table.Number("roll_deg", kAngle));
    attitude.pitch_rad = Rad(table.Number("pitch_deg", kPitch));
    attitude.yaw_rad = Rad(table.Number("heading_deg", kAngle));
    VehiclePose pose;
    pose.X_WB.R = RotationFromEuler(attitude);
    pose.X_WB.p.z() = -table.Number("height_m", kPoseHeight);
    file.pose = pose;
  }
  return table.Finish();
}

Status ReadImages(const toml::table& root, const std::string& name, RigFile& file) {
  TomlTable images(root, name, "images");
  if (images.present()) {
    file.left_pattern = images.Text("left");
    file.right_pattern = images.Text("right");
    for (const char* key : {"rate_hz", "poses"}) {
      images.Allow(key);
    }
    if (images.Has("poses")) {
      file.poses_csv = file.folder / images.Text("poses");
    }
    file.rig.rate_hz = images.NumberOr("rate_hz", kRate, file.rig.rate_hz);
  }
  return images.Finish();
}

/// The size asked of a device must be the one that the camera models are made for.
int ReadCaptureSide(TomlTable& table, const char* key, int expected, const char* which) {
  table.Allow(key);
  const int side = static_cast<int>(table.NumberOr(key, kSide, expected));
  if (side != expected) {
    table.FailKey(key, " = " + std::to_string(side) + " px, " + which + " is " +
                           std::to_string(expected) + " px; calibrate for the size you capture");
  }
  return side;
}

void ReadCaptureAddresses(TomlTable& table, RigCapture& capture) {
  for (const char* key : {"side_by_side", "right", "pair_tolerance_ms"}) {
    table.Allow(key);
  }
  capture.left = table.TextOrIndex("left");
  capture.side_by_side = table.BoolOr("side_by_side", false);
  if (capture.side_by_side) {
    for (const char* key : {"right", "pair_tolerance_ms"}) {
      if (table.Has(key)) {
        table.FailKey(key, " contradicts side_by_side = true; leave one of them out");
      }
    }
    return;
  }
  capture.right = table.TextOrIndex("right");
  if (capture.right == capture.left) {
    table.FailKey("right", " = " + capture.right +
                               " is the left camera too; give two, or side_by_side = true where "
                               "one device gives both pictures");
  }
  if (table.Has("pair_tolerance_ms")) {
    capture.pair_tolerance_s = table.Number("pair_tolerance_ms", kTolerance) * 1e-3;
  }
}

Status ReadCapture(const toml::table& root, const std::string& name, RigFile& file) {
  TomlTable table(root, name, "capture");
  if (!table.present()) {
    return table.Finish();
  }
  RigCapture capture;
  ReadCaptureAddresses(table, capture);
  const PinholeCamera& left = file.rig.left.pinhole;
  capture.width = capture.side_by_side
                      ? ReadCaptureSide(table, "width", 2 * left.width, "twice left.width")
                      : ReadCaptureSide(table, "width", left.width, "left.width");
  capture.height = ReadCaptureSide(table, "height", left.height, "left.height");
  for (const char* key : {"rate_hz", "fourcc", "loop"}) {
    table.Allow(key);
  }
  if (table.Has("rate_hz")) {
    capture.rate_hz = table.Number("rate_hz", kRate);
  }
  if (table.Has("fourcc")) {
    capture.fourcc = table.Text("fourcc");
    if (capture.fourcc.size() != 4) {
      table.FailKey("fourcc", " = " + capture.fourcc +
                                  " must have four letters, e.g. MJPG or YUYV; v4l2-ctl "
                                  "--list-formats-ext shows what a device has");
    }
  }
  capture.loop = table.BoolOr("loop", false);
  if (Status status = table.Finish(); !status) {
    return status;
  }
  file.capture = std::move(capture);
  return Ok();
}

Status CheckTables(const toml::table& root, const std::string& name) {
  static constexpr const char* kTables = "left, right, rig, mount, pose, images, capture";
  const std::set<std::string, std::less<>> known = {"left", "right",  "rig",    "mount",
                                                    "pose", "images", "capture"};
  for (const auto& [key, node] : root) {
    if (!known.contains(key.str())) {
      return InvalidError(name + ":" + std::to_string(node.source().begin.line) + ": unknown key " +
                          Printable(key.str()) + "; known tables: " + kTables);
    }
  }
  return Ok();
}

Status CheckPair(const StereoRig& rig, const std::string& name) {
  const PinholeCamera& left = rig.left.pinhole;
  const PinholeCamera& right = rig.right.pinhole;
  if (rig.rectified &&
      (left.width != right.width || left.height != right.height || left.fx_px != right.fx_px ||
       left.fy_px != right.fy_px || left.cy_px != right.cy_px)) {
    return InvalidError(name +
                        ": rig.rectified = true but [left] and [right] differ; rectified pictures "
                        "share size, focal length and cy_px");
  }
  return Ok();
}

}  // namespace

Result<RigFile> LoadRigFile(const std::filesystem::path& path) {
  const auto text = ReadTextFile(path);
  if (!text) {
    return text.error();
  }
  const std::string name = path.string();
  const Result<toml::table> parsed = ParseToml(*text, name);
  if (!parsed) {
    return parsed.error();
  }
  const toml::table& root = *parsed;
  RigFile file;
  file.folder = path.parent_path();
  Status status = CheckTables(root, name);
  const auto then = [&](const auto& step) {
    if (status) {
      status = step();
    }
  };
  ModelFiles models;
  then([&] { return ReadCamera(root, name, StereoSide::kLeft, file, file.rig.left, models); });
  then([&] { return ReadCamera(root, name, StereoSide::kRight, file, file.rig.right, models); });
  then([&] { return ReadRig(root, name, models, file.rig); });
  then([&] { return ReadMount(root, name, file.rig); });
  then([&] { return ReadPose(root, name, file); });
  then([&] { return ReadImages(root, name, file); });
  then([&] { return ReadCapture(root, name, file); });
  then([&] { return CheckPair(file.rig, name); });
  if (!status) {
    return status.error();
  }
  return file;
}

}  // namespace palace
