// The fields of every generated type in wire order, once. For .cpp files of this room only.
#pragma once

#include <palace/abort_t.hpp>
#include <palace/arrival_t.hpp>
#include <palace/authority_t.hpp>
#include <palace/camera_rig_t.hpp>
#include <palace/command_ack_t.hpp>
#include <palace/command_t.hpp>
#include <palace/event_t.hpp>
#include <palace/gps_t.hpp>
#include <palace/image_t.hpp>
#include <palace/imu_t.hpp>
#include <palace/laser_range_t.hpp>
#include <palace/mission_t.hpp>
#include <palace/pose_t.hpp>
#include <palace/position_estimate_t.hpp>
#include <palace/refused_t.hpp>
#include <palace/session_request_t.hpp>
#include <palace/site_decision_t.hpp>
#include <palace/site_proposal_t.hpp>
#include <palace/slad_settings_t.hpp>
#include <palace/station_status_t.hpp>
#include <palace/tracker_status_t.hpp>
#include <palace/truth_t.hpp>
#include <palace/vehicle_status_t.hpp>

namespace palace {

/// Calls `read` with each field. `read.List(count, list)` stands for an array sized by `count`.
template <typename Reader>
void VisitFields(Reader& read, image_metadata_t& m) {
  read(m.key, m.n);
  read.List(m.n, m.value);
}
template <typename Reader>
void VisitFields(Reader& read, image_t& m) {
  read(m.utime, m.width, m.height, m.row_stride, m.pixelformat, m.size);
  read.List(m.size, m.data);
  read(m.nmetadata);
  read.List(m.nmetadata, m.metadata);
}
template <typename Reader>
void VisitFields(Reader& read, pose_t& m) {
  read(m.utime, m.pos, m.vel, m.orientation, m.rotation_rate, m.accel);
}
template <typename Reader>
void VisitFields(Reader& read, rig_camera_t& m) {
  read(m.width, m.height, m.fx_px, m.fy_px, m.cx_px, m.cy_px, m.distortion, m.has_cahvor,
       m.cahvor_width, m.cahvor_height, m.cahvor, m.lens_size);
  read.List(m.lens_size, m.lens);
}
template <typename Reader>
void VisitFields(Reader& read, camera_rig_t& m) {
  read(m.utime, m.bundle_end, m.sequence, m.discontinuity, m.has_rig, m.has_pictures, m.has_status,
       m.sample_counts, m.has_exposure_pose, m.exposure_utime, m.exposure_pos, m.exposure_vel,
       m.exposure_rate, m.exposure_rotation, m.rotation_size);
  read.List(m.rotation_size, m.pose_rotations);
  VisitFields(read, m.left);
  VisitFields(read, m.right);
  read(m.baseline_m, m.rectified, m.min_disparity_px, m.num_disparities, m.tilt_rad,
       m.position_body_m, m.rate_hz);
}
template <typename Reader>
void VisitFields(Reader& read, imu_t& m) {
  read(m.utime, m.specific_force, m.angular_rate);
}
template <typename Reader>
void VisitFields(Reader& read, gps_t& m) {
  read(m.utime, m.pos, m.vel, m.sigma_horizontal_m, m.sigma_vertical_m);
}
template <typename Reader>
void VisitFields(Reader& read, laser_range_t& m) {
  read(m.utime, m.range_m);
}
template <typename Reader>
void VisitFields(Reader& read, vehicle_status_t& m) {
  read(m.utime, m.boot_id, m.mode, m.on_ground, m.flies_on_vision, m.approval_id, m.wind_speed_mps,
       m.wind_from_rad, m.battery_or_fuel, m.simulated);
}
template <typename Reader>
void VisitFields(Reader& read, command_ack_t& m) {
  read(m.utime, m.command_id, m.result, m.reason);
}
template <typename Reader>
void VisitFields(Reader& read, arrival_t& m) {
  read(m.utime, m.has_clock, m.station_s, m.estimating, m.drift_ppm, m.jitter_s, m.stepped_s,
       m.stalled_s, m.left_alone, m.left_utime, m.right_alone, m.right_utime, m.poses_invalid,
       m.overtaken);
}
template <typename Reader>
void VisitFields(Reader& read, truth_t& m) {
  read(m.utime, m.pos, m.vel, m.rotation);
}
template <typename Reader>
void VisitFields(Reader& read, mission_t& m) {
  read(m.utime, m.state, m.since_utime, m.why, m.site_id, m.approval_id, m.site_pos,
       m.glide_slope_rad, m.descent_rate_mps, m.commit_height_m);
}
template <typename Reader>
void VisitFields(Reader& read, slad_setting_t& m) {
  read(m.name, m.value);
}
template <typename Reader>
void VisitFields(Reader& read, slad_settings_t& m) {
  read(m.utime, m.settings_hash, m.count);
  read.List(m.count, m.rows);
}
template <typename Reader>
void VisitFields(Reader& read, site_t& m) {
  read(m.id, m.letter, m.map_utime, m.row, m.col, m.pos, m.normal, m.pixel, m.slope_rad,
       m.roughness_m, m.step_m, m.height_m, m.safe_distance_m, m.clear_radius_m, m.clearance_m,
       m.cost, m.safe_probability, m.touchdown_worst, m.touchdown_best, m.flags, m.unknown_cells,
       m.frames_fused, m.confirmed, m.newest_confirms, m.corridor_clear, m.clear_approaches,
       m.age_s, m.distance_m, m.reason);
}
template <typename Reader>
void VisitFields(Reader& read, site_proposal_t& m) {
  read(m.utime, m.map_utime, m.map_hash, m.settings_hash, m.grid_rows, m.grid_cols, m.grid_cell_m,
       m.grid_north_min_m, m.grid_east_min_m, m.count);
  read.List(m.count, m.sites);
  read(m.none_reason);
}
template <typename Reader>
void VisitFields(Reader& read, site_decision_t& m) {
  read(m.utime, m.kind, m.origin, m.name, m.value, m.site_id, m.snapshot_sequence, m.text, m.pos,
       m.corner_count);
  read.List(m.corner_count, m.corner_north);
  read.List(m.corner_count, m.corner_east);
}
template <typename Reader>
void VisitFields(Reader& read, command_t& m) {
  read(m.utime, m.kind, m.command_id, m.session_id, m.counter, m.site_id, m.map_hash,
       m.settings_hash, m.calibration_hash, m.vehicle_boot_id, m.approved_utime, m.expires_utime,
       m.provisional, m.site_pos, m.approach_heading_rad, m.glide_slope_rad, m.descent_rate_mps,
       m.clear_radius_m, m.stop_height_m, m.reason, m.mac);
}
template <typename Reader>
void VisitFields(Reader& read, position_estimate_t& m) {
  read(m.utime, m.source, m.healthy, m.approval_id, m.pos, m.vel, m.sigma_pos, m.sigma_vel,
       m.session_id, m.counter, m.mac);
}
template <typename Reader>
void VisitFields(Reader& read, tracker_status_t& m) {
  read(m.utime, m.locked, m.mode, m.coherence, m.site_pixel, m.site_in_picture, m.inliers,
       m.keyframes, m.anchor_height_m, m.window_centre, m.window_side_px);
}
template <typename Reader>
void VisitFields(Reader& read, station_status_t& m) {
  read(m.utime, m.sequence, m.state, m.settings_hash, m.decision_hash, m.best_site,
       m.best_safe_distance_m, m.height_above_site_m, m.distance_to_site_m, m.height_m, m.alarms,
       m.vision_in_force);
}
template <typename Reader>
void VisitFields(Reader& read, event_t& m) {
  read(m.utime, m.kind, m.text);
}
template <typename Reader>
void VisitFields(Reader& read, refused_t& m) {
  read(m.utime, m.wall_utime, m.sender, m.channel, m.reason, m.bytes, m.like_it, m.head_size);
  read.List(m.head_size, m.head);
}
template <typename Reader>
void VisitFields(Reader& read, session_request_t& m) {
  read(m.utime, m.kind, m.station_id, m.station_name, m.key_id, m.vehicle_boot_id, m.challenge,
       m.nonce, m.session_id, m.counter, m.mac);
}
template <typename Reader>
void VisitFields(Reader& read, authority_t& m) {
  read(m.utime, m.boot_id, m.checks, m.challenge, m.session_id, m.station_id, m.station_name,
       m.key_id, m.station_nonce, m.since_utime, m.heard_utime, m.refused_station_id, m.refusal,
       m.mac);
}
template <typename Reader>
void VisitFields(Reader& read, abort_t& m) {
  read(m.utime, m.command_id, m.reason);
}

}  // namespace palace
