// Random bundles and one sample message of every type, for the tests of wire and journal.
#pragma once

#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "engine/core/random.h"
#include "engine/wire/convert.h"
#include "engine/wire/output_encoder.h"

namespace palace {

inline Eigen::Vector3d RandomVector(RandomStream& random) {
  return {random.Normal(), random.Normal() * 100, random.Normal() * 1e-3};
}

inline RigidTransform RandomTransform(RandomStream& random) {
  return {
      RotationFromEuler({random.Uniform(-3, 3), random.Uniform(-1.5, 1.5), random.Uniform(-3, 3)}),
      RandomVector(random)};
}

inline VehiclePose RandomPose(RandomStream& random, Timestamp time) {
  return {time, RandomTransform(random), RandomVector(random), RandomVector(random)};
}

inline StereoRig RandomRig(RandomStream& random) {
  StereoRig rig;
  for (RigCamera* camera : {&rig.left, &rig.right}) {
    camera->pinhole = {32, 36, random.Uniform(20, 30), random.Uniform(20, 30), 15.5, 17.5};
    for (double& k : camera->distortion) {
      k = random.Normal() * 0.01;
    }
  }
  CahvorModel model{32,
                    36,
                    RandomVector(random),
                    RandomVector(random),
                    RandomVector(random),
                    RandomVector(random),
                    RandomVector(random),
                    RandomVector(random)};
  if (model.A.cross(model.H).cross(model.A.cross(model.V)).dot(model.A) < 0) {
    model.H = -model.H;  // a mirrored model is refused
  }
  rig.right.model = CameraModel{model};
  OpenCvModel lens;
  lens.pinhole = rig.left.pinhole;
  lens.coefficients = 8;
  for (double& k : lens.k) {
    k = random.Normal() * 0.01;
  }
  lens.t_CF = RandomVector(random);
  rig.left.model = CameraModel{lens};
  rig.baseline_m = random.Uniform(0.2, 1.2);
  rig.rectified = false;
  rig.min_disparity_px = 3;
  rig.num_disparities = 48;
  rig.tilt_rad = -random.Uniform(0.5, 1.5);
  rig.position_body_m = 0.1 * RandomVector(random);
  rig.rate_hz = 9.7;
  return rig;
}

/// Every field set, with counts that vary, a laser without return, and texts.
inline std::shared_ptr<FrameBundle> RandomBundle(RandomStream& random, std::uint64_t sequence,
                                                 std::shared_ptr<const StereoRig> rig,
                                                 int width = 32, int height = 24) {
  auto bundle = std::make_shared<FrameBundle>();
  const std::int64_t start_us = 1'000'000'000'000 + static_cast<std::int64_t>(sequence) * 100'000;
  bundle->sequence = sequence;
  bundle->time = {start_us + 100'000};
  bundle->rig = std::move(rig);
  auto stereo = std::make_shared<StereoFrame>();
  stereo->time = {start_us + 95'000};
  stereo->left = ImageU8(width, height);
  stereo->right = ImageU8(width, height);
  for (ImageU8* image : {&stereo->left, &stereo->right}) {
    for (std::uint8_t& pixel : image->pixels()) {
      pixel = static_cast<std::uint8_t>(random.NextBits());
    }
  }
  bundle->stereo = stereo;
  bundle->pose_at_exposure = RandomPose(random, stereo->time);
  const int samples = 1 + random.Index(10);
  for (int i = 0; i < samples; ++i) {
    const Timestamp time{start_us + 1'000 * (i + 1)};
    bundle->poses.push_back(RandomPose(random, time));
    bundle->imu.push_back({time, RandomVector(random), RandomVector(random)});
    bundle->truth.push_back({time, RandomTransform(random), RandomVector(random)});
    bundle->laser.push_back({time, i % 3 == 0 ? NAN : random.Uniform(1, 20)});
  }
  bundle->gps.push_back({{start_us + 7}, RandomVector(random), RandomVector(random), 1.5, 2.5});
  VehicleStatus status;
  status.time = bundle->time;
  status.boot_id = random.NextBits();
  status.mode = static_cast<VehicleMode>(random.Index(9));
  status.flies_on_vision = true;
  status.approval_id = random.NextBits();
  status.wind_speed_mps = random.Uniform();
  status.wind_from_rad = random.Uniform();
  status.battery_or_fuel = random.Uniform();
  status.simulated = true;
  bundle->status = status;
  bundle->arrival.clock = ClockReading{random.Uniform(), sequence % 2 == 0, random.Normal(),
                                       random.Uniform(), random.Normal(),   random.Uniform()};
  bundle->arrival.left_alone = Timestamp{start_us + 1};
  bundle->arrival.right_alone = Timestamp{start_us + 2};
  bundle->arrival.poses_invalid = 3;
  bundle->arrival.overtaken = {1, 2, 3, 4, 5, 6, 7, 0};
  bundle->acks.push_back({{start_us + 8}, random.NextBits(), AckResult::kRefused, "zu spät"});
  bundle->acks.push_back({{start_us + 8}, random.NextBits(), AckResult::kAccepted, ""});
  bundle->authority = AuthorityReport{{start_us + 9},
                                      status.boot_id,
                                      true,
                                      random.NextBits(),
                                      5,
                                      6,
                                      "alpha",
                                      7,
                                      8,
                                      {start_us},
                                      {start_us + 1},
                                      9,
                                      "no",
                                      {1, 2}};
  return bundle;
}

inline EngineSnapshot RandomSnapshot(RandomStream& random, const FrameBundle& bundle) {
  EngineSnapshot snapshot;
  snapshot.sequence = bundle.sequence + 1;
  snapshot.time = bundle.time;
  snapshot.sensors.Edit().pose = bundle.pose_at_exposure;
  snapshot.flight.Edit().mission.state = static_cast<MissionState>(random.Index(9));
  snapshot.flight.Edit().mission.why = "a test";
  snapshot.flight.Edit().mission.height_above_site_m = random.Uniform(0, 15);
  snapshot.flight.Edit().mission.distance_to_site_m = NAN;
  snapshot.decision_hash = random.NextBits();
  snapshot.session.Edit().settings_hash = HashOf(snapshot.session->settings);
  auto decision = std::make_shared<TerrainDecision>();
  decision->map_time = bundle.time;
  decision->map_hash = random.NextBits();
  decision->settings_hash = random.NextBits();
  LandingSite site;
  site.id = random.NextBits();
  site.letter = 'C';
  site.map_time = bundle.time;
  site.cell = {3, 4};
  site.p_WS = RandomVector(random);
  site.pixel = {random.Uniform(), random.Uniform()};
  site.slope_rad = {random.Uniform(), random.Uniform()};
  site.safe_distance_m = random.Uniform();
  site.confirmed = true;
  site.newest_confirms = true;
  site.reason = "widest clearance";
  decision->selection.sites = {site, site};
  snapshot.terrain.Edit().applied = decision;
  snapshot.flight.Edit().tracker.time = bundle.time;
  snapshot.flight.Edit().tracker.locked = true;
  snapshot.flight.Edit().tracker.mode = "Plane";
  snapshot.flight.Edit().tracker.coherence = random.Uniform();
  return snapshot;
}

inline bool SameBits(double a, double b) {
  return std::memcmp(&a, &b, sizeof a) == 0 || (std::isnan(a) && std::isnan(b));
}

/// One message of every type the station and its vehicle exchange.
inline std::vector<WireMessage> OneOfEach(RandomStream& random) {
  const ChannelNames channels;
  const auto rig = std::make_shared<const StereoRig>(RandomRig(random));
  const auto bundle = RandomBundle(random, 7, rig, 5, 3);
  std::vector<WireMessage> messages = EncodeBundle(*bundle, channels);
  Approval approval;
  approval.id = random.NextBits();
  approval.p_WS = RandomVector(random);
  approval.stop_height_m = 12;
  approval.seal.mac.fill(0xA5);
  PositionEstimate estimate;
  estimate.time = bundle->time;
  estimate.source = EstimateSource::kVision;
  estimate.healthy = true;
  estimate.p_WB = RandomVector(random);
  for (const VehicleMessage& message :
       {VehicleMessage(approval), VehicleMessage(estimate),
        VehicleMessage(HoldRequest{random.NextBits(), "hold it"}), VehicleMessage(SessionRequest{}),
        VehicleMessage(GoRequest{random.NextBits(), 7, bundle->time, RandomVector(random), 1, {}}),
        VehicleMessage(AbortRequest{random.NextBits(), "away"})}) {
    messages.push_back(EncodeVehicleMessage(message, bundle->time, channels));
  }
  EngineSnapshot snapshot = RandomSnapshot(random, *bundle);
  snapshot.session.Edit().events = std::make_shared<const std::vector<Event>>(
      std::vector<Event>{{bundle->time, EventKind::kBookmark, "here", 1}});
  for (WireMessage& message : OutputEncoder(channels).Encode(snapshot)) {
    messages.push_back(std::move(message));
  }
  messages.push_back(EncodeRefused({.time = bundle->time,
                                    .sender = "10.0.0.2:7667",
                                    .channel = channels.gps,
                                    .reason = "not finite",
                                    .bytes = 3,
                                    .head = {1, 2, 3}},
                                   bundle->time, channels));
  messages.push_back(EncodeCommand({CommandOrigin::kScript, SetSetting{"slad.max_slope_deg", 8}},
                                   bundle->time, channels));
  messages.push_back(
      EncodeCommand({CommandOrigin::kOperator, LookAtSite{3, 7, 12}}, bundle->time, channels));
  messages.push_back(
      EncodeCommand({CommandOrigin::kOperator, TurnApproach{3, 5}}, bundle->time, channels));
  return messages;
}

}  // namespace palace
