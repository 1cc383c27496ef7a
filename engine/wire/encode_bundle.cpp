#include <algorithm>

#include "engine/model/camera_numbers.h"
#include "engine/wire/convert.h"
#include "engine/wire/session_messages.h"
#include "engine/wire/wire_fields.h"
#include "engine/wire/wire_pack.h"

namespace palace {
namespace {

pose_t PoseToWire(const VehiclePose& pose) {
  pose_t m{};
  m.utime = pose.time.us;
  Pack(pose.X_WB.p, m.pos);
  Pack(pose.v_WB, m.vel);
  const Eigen::Quaterniond q(pose.X_WB.R);
  const double wxyz[] = {q.w(), q.x(), q.y(), q.z()};
  std::copy_n(wxyz, 4, m.orientation);
  Pack(pose.angular_rate_B, m.rotation_rate);
  return m;
}

imu_t ImuToWire(const ImuSample& sample) {
  imu_t m{};
  m.utime = sample.time.us;
  Pack(sample.specific_force_B, m.specific_force);
  Pack(sample.angular_rate_B, m.angular_rate);
  return m;
}

gps_t GpsToWire(const GpsFix& fix) {
  gps_t m{};
  m.utime = fix.time.us;
  Pack(fix.p_WB, m.pos);
  Pack(fix.v_WB, m.vel);
  m.sigma_horizontal_m = fix.sigma_horizontal_m;
  m.sigma_vertical_m = fix.sigma_vertical_m;
  return m;
}

vehicle_status_t StatusToWire(const VehicleStatus& status) {
  vehicle_status_t m{};
  m.utime = status.time.us;
  m.boot_id = WireId(status.boot_id);
  m.mode = static_cast<std::int8_t>(status.mode);
  m.on_ground = status.on_ground;
  m.flies_on_vision = status.flies_on_vision;
  m.approval_id = WireId(status.approval_id);
  m.wind_speed_mps = status.wind_speed_mps;
  m.wind_from_rad = status.wind_from_rad;
  m.battery_or_fuel = status.battery_or_fuel;
  m.simulated = status.simulated;
  return m;
}

truth_t TruthToWire(const Truth& truth) {
  truth_t m{};
  m.utime = truth.time.us;
  Pack(truth.X_WB.p, m.pos);
  Pack(truth.v_WB, m.vel);
  PackRotation(truth.X_WB.R, m.rotation);
  return m;
}

image_t PictureToWire(const ImageU8& image, Timestamp time) {
  image_t m{};
  m.utime = time.us;
  m.width = image.width();
  m.height = image.height();
  m.row_stride = image.width();
  m.pixelformat = image_t::PIXEL_FORMAT_GRAY;
  m.data = image.pixels();
  m.size = static_cast<std::int32_t>(m.data.size());
  return m;
}

rig_camera_t CameraToWire(const RigCamera& camera) {
  rig_camera_t m{};
  m.width = camera.pinhole.width;
  m.height = camera.pinhole.height;
  m.fx_px = camera.pinhole.fx_px;
  m.fy_px = camera.pinhole.fy_px;
  m.cx_px = camera.pinhole.cx_px;
  m.cy_px = camera.pinhole.cy_px;
  std::copy(camera.distortion.begin(), camera.distortion.end(), m.distortion);
  if (!camera.model) {
    return m;
  }
  if (const auto* cahvor = std::get_if<CahvorModel>(&camera.model->lens)) {
    m.has_cahvor = 1;
    m.cahvor_width = cahvor->width;
    m.cahvor_height = cahvor->height;
    double* out = m.cahvor;
    for (const Eigen::Vector3d* v :
         {&cahvor->C, &cahvor->A, &cahvor->H, &cahvor->V, &cahvor->O, &cahvor->R}) {
      out = std::copy_n(v->data(), 3, out);
    }
  } else {
    m.lens = NumbersOf(*camera.model);
    m.lens_size = static_cast<std::int32_t>(m.lens.size());
  }
  return m;
}

camera_rig_t RigToWire(const StereoRig* rig) {
  camera_rig_t m{};
  if (rig == nullptr) {
    return m;
  }
  m.has_rig = 1;
  m.left = CameraToWire(rig->left);
  m.right = CameraToWire(rig->right);
  m.baseline_m = rig->baseline_m;
  m.rectified = rig->rectified;
  m.min_disparity_px = rig->min_disparity_px;
  m.num_disparities = rig->num_disparities;
  m.tilt_rad = rig->tilt_rad;
  Pack(rig->position_body_m, m.position_body_m);
  m.rate_hz = rig->rate_hz;
  return m;
}

arrival_t ArrivalToWire(const ArrivalNotes& notes, Timestamp now) {
  arrival_t m{};
  m.utime = now.us;
  m.has_clock = notes.clock.has_value();
  const ClockReading clock = notes.clock.value_or(ClockReading{});
  m.station_s = clock.station_s;
  m.estimating = clock.estimating;
  m.drift_ppm = clock.drift_ppm;
  m.jitter_s = clock.jitter_s;
  m.stepped_s = clock.stepped_s;
  m.stalled_s = clock.stalled_s;
  m.left_alone = notes.left_alone.has_value();
  m.left_utime = notes.left_alone.value_or(Timestamp{}).us;
  m.right_alone = notes.right_alone.has_value();
  m.right_utime = notes.right_alone.value_or(Timestamp{}).us;
  m.poses_invalid = notes.poses_invalid;
  std::copy(notes.overtaken.begin(), notes.overtaken.end(), m.overtaken);
  return m;
}

camera_rig_t BundleEnd(const FrameBundle& bundle) {
  camera_rig_t m = RigToWire(bundle.rig.get());
  m.utime = bundle.time.us;
  m.bundle_end = 1;
  m.sequence = WireId(bundle.sequence);
  m.discontinuity = bundle.discontinuity;
  m.has_pictures = bundle.stereo != nullptr;
  m.has_status = bundle.status.has_value();
  const std::size_t counts[] = {bundle.poses.size(), bundle.imu.size(),  bundle.gps.size(),
                                bundle.laser.size(), bundle.acks.size(), bundle.truth.size()};
  for (int i = 0; i < 6; ++i) {
    m.sample_counts[i] = static_cast<std::int32_t>(counts[i]);
  }
  if (bundle.pose_at_exposure) {
    const VehiclePose& pose = *bundle.pose_at_exposure;
    m.has_exposure_pose = 1;
    m.exposure_utime = pose.time.us;
    Pack(pose.X_WB.p, m.exposure_pos);
    Pack(pose.v_WB, m.exposure_vel);
    Pack(pose.angular_rate_B, m.exposure_rate);
    PackRotation(pose.X_WB.R, m.exposure_rotation);
  }
  m.pose_rotations.resize(9 * bundle.poses.size());
  m.rotation_size = static_cast<std::int32_t>(m.pose_rotations.size());
  for (std::size_t i = 0; i < bundle.poses.size(); ++i) {
    PackRotation(bundle.poses[i].X_WB.R, m.pose_rotations.data() + 9 * i);
  }
  return m;
}

}  // namespace

WireMessage EncodeAck(const CommandAck& ack, const ChannelNames& channels) {
  command_ack_t m{};
  m.utime = ack.time.us;
  m.command_id = WireId(ack.command_id);
  m.result = static_cast<std::int8_t>(ack.result);
  m.reason = ack.reason;
  return MakeMessage(channels.command_ack, ack.time, m);
}

std::vector<WireMessage> EncodeBundle(const FrameBundle& bundle, const ChannelNames& channels) {
  const Timestamp now = bundle.time;
  std::vector<WireMessage> messages;
  for (const VehiclePose& pose : bundle.poses) {
    messages.push_back(MakeMessage(channels.vehicle_pose, now, PoseToWire(pose)));
  }
  for (const ImuSample& sample : bundle.imu) {
    messages.push_back(MakeMessage(channels.imu, now, ImuToWire(sample)));
  }
  for (const GpsFix& fix : bundle.gps) {
    messages.push_back(MakeMessage(channels.gps, now, GpsToWire(fix)));
  }
  for (const LaserRange& range : bundle.laser) {
    laser_range_t m{};
    m.utime = range.time.us;
    m.range_m = range.range_m;
    messages.push_back(MakeMessage(channels.laser_range, now, m));
  }
  if (bundle.status) {
    messages.push_back(MakeMessage(channels.vehicle_status, now, StatusToWire(*bundle.status)));
  }
  for (const CommandAck& ack : bundle.acks) {
    messages.push_back(EncodeAck(ack, channels));
    messages.back().time = now;
  }
  if (bundle.authority) {
    messages.push_back(MakeMessage(channels.authority, now, AuthorityToWire(*bundle.authority)));
  }
  for (const Truth& truth : bundle.truth) {
    messages.push_back(MakeMessage(channels.truth, now, TruthToWire(truth)));
  }
  if (bundle.stereo) {
    const Timestamp exposed = bundle.stereo->time;
    messages.push_back(
        MakeMessage(channels.camera_left, now, PictureToWire(bundle.stereo->left, exposed)));
    messages.push_back(
        MakeMessage(channels.camera_right, now, PictureToWire(bundle.stereo->right, exposed)));
  }
  for (const RefusedDatagram& refused : bundle.refused) {
    messages.push_back(EncodeRefused(refused, now, channels));
  }
  if (!(bundle.arrival == ArrivalNotes{})) {
    messages.push_back(MakeMessage(channels.arrival, now, ArrivalToWire(bundle.arrival, now)));
  }
  messages.push_back(MakeMessage(channels.camera_rig, now, BundleEnd(bundle)));
  return messages;
}

}  // namespace palace
