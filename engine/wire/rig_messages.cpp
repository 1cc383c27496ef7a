#include <cstring>

#include "engine/model/camera_numbers.h"
#include "engine/model/rig_limits.h"
#include "engine/wire/sensor_messages.h"
#include "engine/wire/wire_fields.h"
#include "engine/wire/wire_pack.h"

namespace palace {
namespace {

RigCamera CameraFromWire(const rig_camera_t& m) {
  RigCamera camera;
  camera.pinhole = {m.width, m.height, m.fx_px, m.fy_px, m.cx_px, m.cy_px};
  std::copy_n(m.distortion, 5, camera.distortion.begin());
  if (m.has_cahvor != 0) {
    CahvorModel model;
    model.width = m.cahvor_width;
    model.height = m.cahvor_height;
    Eigen::Vector3d* const vectors[] = {&model.C, &model.A, &model.H, &model.V, &model.O, &model.R};
    for (int i = 0; i < 6; ++i) {
      *vectors[i] = Eigen::Map<const Eigen::Vector3d>(m.cahvor + 3 * i);
    }
    camera.model = CameraModel{model};
  }
  if (m.lens_size > 0) {
    camera.model = CameraFromNumbers(m.lens);
  }
  return camera;
}

/// Every number of a rig, in one row.
std::vector<double> Flatten(const StereoRig& rig) {
  std::vector<double> row = {rig.baseline_m,
                             rig.rectified ? 1.0 : 0.0,
                             rig.tilt_rad,
                             rig.rate_hz,
                             rig.position_body_m[0],
                             rig.position_body_m[1],
                             rig.position_body_m[2],
                             static_cast<double>(rig.min_disparity_px),
                             static_cast<double>(rig.num_disparities)};
  for (const RigCamera* camera : {&rig.left, &rig.right}) {
    const PinholeCamera& p = camera->pinhole;
    row.insert(row.end(), {static_cast<double>(p.width), static_cast<double>(p.height), p.fx_px,
                           p.fy_px, p.cx_px, p.cy_px});
    row.insert(row.end(), camera->distortion.begin(), camera->distortion.end());
    if (camera->model) {
      const std::vector<double> lens = NumbersOf(*camera->model);
      row.insert(row.end(), lens.begin(), lens.end());
    }
  }
  return row;
}

/// The first field with a number that is not finite; empty when all are.
std::string NotFiniteField(const StereoRig& rig) {
  const auto finite = [](const auto& numbers) {
    return std::all_of(std::begin(numbers), std::end(numbers),
                       [](double number) { return std::isfinite(number); });
  };
  const std::pair<const char*, double> numbers[] = {
      {"baseline_m", rig.baseline_m}, {"tilt_rad", rig.tilt_rad}, {"rate_hz", rig.rate_hz}};
  for (const auto& [field, number] : numbers) {
    if (!std::isfinite(number)) {
      return field;
    }
  }
  if (!rig.position_body_m.allFinite()) {
    return "position_body_m";
  }
  for (const RigCamera* camera : {&rig.left, &rig.right}) {
    const std::string side = camera == &rig.left ? "left." : "right.";
    const PinholeCamera& p = camera->pinhole;
    if (!finite(std::array{p.fx_px, p.fy_px, p.cx_px, p.cy_px})) {
      return side + "fx_px, fy_px, cx_px or cy_px";
    }
    if (!finite(camera->distortion)) {
      return side + "distortion";
    }
    if (camera->model && !finite(NumbersOf(*camera->model))) {
      return side + "cahvor or lens";
    }
  }
  return {};
}

Result<StereoRig> RigBody(const camera_rig_t& m) {
  StereoRig rig;
  rig.left = CameraFromWire(m.left);
  rig.right = CameraFromWire(m.right);
  if ((m.left.lens_size > 0 && !rig.left.model) || (m.right.lens_size > 0 && !rig.right.model)) {
    return InvalidError("the rig holds a camera model that is none");
  }
  rig.baseline_m = m.baseline_m;
  rig.rectified = m.rectified != 0;
  rig.min_disparity_px = m.min_disparity_px;
  rig.num_disparities = m.num_disparities;
  rig.tilt_rad = m.tilt_rad;
  rig.position_body_m = Unpack(m.position_body_m);
  rig.rate_hz = m.rate_hz;
  if (const std::string field = NotFiniteField(rig); !field.empty()) {
    return InvalidError("the rig's " + field + " holds a number that is not finite");
  }
  if (std::string why = WhyNoRig(rig); !why.empty()) {
    return InvalidError(std::move(why));
  }
  return rig;
}

Result<RigMessage> FromRig(const camera_rig_t& m) {
  RigMessage message;
  message.time = {m.utime};
  message.bundle_end = m.bundle_end != 0;
  message.sequence = IdFromWire(m.sequence);
  message.has_pictures = m.has_pictures != 0;
  message.has_status = m.has_status != 0;
  message.discontinuity = m.discontinuity != 0;
  std::copy_n(m.sample_counts, 6, message.sample_counts.begin());
  if (m.has_rig != 0) {
    Result<StereoRig> rig = RigBody(m);
    if (!rig) {
      return rig.error();
    }
    message.rig = std::move(*rig);
  }
  if (m.has_exposure_pose != 0) {
    VehiclePose pose{{m.exposure_utime},
                     {UnpackRotation(m.exposure_rotation), Unpack(m.exposure_pos)},
                     Unpack(m.exposure_vel),
                     Unpack(m.exposure_rate)};
    if (!pose.X_WB.p.allFinite() || !pose.v_WB.allFinite() || !pose.angular_rate_B.allFinite() ||
        !IsRotation(pose.X_WB.R)) {
      return InvalidError("the pose at exposure is not finite or its rotation is none");
    }
    message.exposure_pose = pose;
  }
  if (m.rotation_size % 9 != 0) {
    return InvalidError("rotation_size is " + std::to_string(m.rotation_size) +
                        ", not a multiple of 9");
  }
  for (std::size_t i = 0; i + 9 <= m.pose_rotations.size(); i += 9) {
    const Eigen::Matrix3d R = UnpackRotation(m.pose_rotations.data() + i);
    if (!IsRotation(R)) {
      return InvalidError("a pose rotation is no rotation");
    }
    message.rotations.push_back(R);
  }
  return message;
}

}  // namespace

Result<RigMessage> RigFromWire(const WireMessage& message) {
  return DecodeAnd<camera_rig_t>(message, FromRig);
}

bool SameRig(const StereoRig& a, const StereoRig& b) {
  const std::vector<double> row_a = Flatten(a);
  const std::vector<double> row_b = Flatten(b);
  return row_a.size() == row_b.size() &&
         std::memcmp(row_a.data(), row_b.data(), row_a.size() * sizeof(double)) == 0;
}

}  // namespace palace
