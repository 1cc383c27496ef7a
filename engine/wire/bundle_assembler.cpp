#include "engine/wire/bundle_assembler.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/wire/convert.h"
#include "engine/wire/decode.h"
#include "engine/wire/sensor_messages.h"
#include "engine/wire/session_messages.h"

namespace palace {
namespace {

constexpr double kNearestPose_s = 0.1;
constexpr double kRestart_s = 10;  ///< a stamp this far back means the sender started anew

/// Returns how many of the oldest had to go.
template <typename T>
std::size_t Append(std::vector<T>& samples, T sample) {
  const std::size_t excess = samples.size() < kMostSamplesInBundle ? 0 : kMostSamplesInBundle / 2;
  samples.erase(samples.begin(), samples.begin() + static_cast<std::ptrdiff_t>(excess));
  samples.push_back(std::move(sample));
  return excess;
}

std::uint64_t Missing(int announced, std::size_t got) {
  const auto wanted = static_cast<std::uint64_t>(std::max(announced, 0));
  return wanted > got ? wanted - got : 0;
}

}  // namespace

VehiclePose CarryPose(VehiclePose pose, Timestamp time) {
  const double dt = SecondsBetween(pose.time, time);
  pose.time = time;
  pose.X_WB.p += pose.v_WB * dt;
  const double angle = pose.angular_rate_B.norm() * dt;
  if (angle != 0) {
    pose.X_WB.R =
        pose.X_WB.R * Eigen::AngleAxisd(angle, pose.angular_rate_B.normalized()).toRotationMatrix();
  }
  return pose;
}

BundleAssembler::BundleAssembler(ChannelNames channels, AssemblerOptions options)
    : channels_(std::move(channels)), options_(options) {}

BundleAssembler::Bundles BundleAssembler::Push(const WireMessage& message) {
  ++report_.messages;
  Bundles done;
  const ::palace::Status taken = Take(message, done);
  problem_.clear();
  if (!taken) {
    problem_ = taken.error().message;
    if (problem_.find(kTypeHashDiffers) != std::string::npos) {
      ++report_.other_version_of[message.channel];
    }
    ++report_.undecodable;
    ++report_.undecodable_of[message.channel];
  }
  return done;
}

Status BundleAssembler::Take(const WireMessage& message, Bundles& done) {
  const std::string& channel = message.channel;
  if (channel == channels_.camera_left || channel == channels_.camera_right) {
    return TakePicture(message, channel == channels_.camera_left, done);
  }
  if (channel == channels_.camera_rig) {
    return TakeRig(message, done);
  }
  return TakeSample(message);
}

bool BundleAssembler::IsNews(const std::string& channel, Timestamp time) {
  if (options_.accepts && !options_.accepts(channel, time)) {
    ++report_.stamps_refused[channel];
    return false;
  }
  if (options_.drop_repeated) {
    const auto seen = newest_of_.find(channel);
    if (seen != newest_of_.end() && time <= seen->second &&
        SecondsBetween(time, seen->second) < kRestart_s) {
      ++report_.repeated;
      return false;
    }
  }
  newest_of_[channel] = time;
  if (!newest_ || time > *newest_ || SecondsBetween(time, *newest_) > kRestart_s) {
    newest_ = time;
  }
  return true;
}

Status BundleAssembler::TakeSample(const WireMessage& message) {
  const std::string& channel = message.channel;
  const auto take = [&](auto decoded, auto keep) -> ::palace::Status {
    if (!decoded) {
      return decoded.error();
    }
    if (IsNews(channel, decoded->time)) {
      keep(std::move(*decoded));
    }
    return Ok();
  };
  const auto keep_in = [&](auto& samples, auto sample) {
    report_.samples_overflowed += Append(samples, std::move(sample));
  };
  if (channel == channels_.vehicle_pose) {
    auto pose = PoseFromWire(message);
    pending_.arrival.poses_invalid += !pose && IsPoseMessage(message) ? 1 : 0;
    return take(std::move(pose), [&](VehiclePose p) { keep_in(pending_.poses, p); });
  }
  if (channel == channels_.imu) {
    return take(ImuFromWire(message), [&](ImuSample s) { keep_in(pending_.imu, s); });
  }
  if (channel == channels_.gps) {
    return take(GpsFromWire(message), [&](GpsFix f) { keep_in(pending_.gps, f); });
  }
  if (channel == channels_.laser_range) {
    return take(LaserFromWire(message), [&](LaserRange r) { keep_in(pending_.laser, r); });
  }
  if (channel == channels_.vehicle_status) {
    return take(StatusFromWire(message), [&](const VehicleStatus& s) {
      constexpr auto kIndex = static_cast<std::size_t>(ChannelId::kVehicleStatus);
      pending_.arrival.overtaken[kIndex] += pending_.status ? 1 : 0;
      pending_.status = s;
    });
  }
  if (channel == channels_.authority) {
    return take(AuthorityFromWire(message), [&](AuthorityReport r) { pending_.authority = r; });
  }
  if (channel == channels_.truth) {
    return take(DecodeTruth(message), [&](Truth t) { keep_in(pending_.truth, t); });
  }
  if (channel == channels_.arrival) {
    Result<ArrivalNotes> notes = ArrivalFromWire(message);
    if (!notes) {
      return notes.error();
    }
    pending_.arrival = std::move(*notes);
    return Ok();
  }
  if (channel == channels_.command_ack) {
    Result<CommandAck> ack = AckFromWire(message);
    if (!ack) {
      return ack.error();
    }
    // Two answers may carry one stamp, so a repeated stamp is news here.
    report_.samples_overflowed += Append(pending_.acks, std::move(*ack));
    return Ok();
  }
  if (channel == channels_.refused) {  // of a recording
    Result<RefusedDatagram> refused = DecodeRefused(message);
    if (!refused) {
      return refused.error();
    }
    report_.samples_overflowed += Append(pending_.refused, std::move(*refused));
    return Ok();
  }
  ++report_.other_channels;
  return Ok();
}

Status BundleAssembler::TakePicture(const WireMessage& message, bool is_left, Bundles& done) {
  Result<TimedPicture> picture = PictureFromWire(message);
  if (!picture) {
    return picture.error();
  }
  if (!IsNews(message.channel, picture->time)) {
    return Ok();
  }
  // A pair still held back was never closed: no rig came.
  if (left_ && right_) {
    ++report_.pairs_without_rig;
    left_.reset();
    right_.reset();
  }
  std::optional<TimedPicture>& mine = is_left ? left_ : right_;
  std::optional<TimedPicture>& other = is_left ? right_ : left_;
  if (mine) {
    DropAlone(is_left);
  }
  mine = std::move(*picture);
  if (other && std::abs(SecondsBetween(other->time, mine->time)) > options_.pair_window_s) {
    // Only the newer one can still find a partner.
    DropAlone(other->time < mine->time ? !is_left : is_left);
  }
  if (!closed_stream_) {
    ClosePair(done);
  }
  return Ok();
}

void BundleAssembler::DropAlone(bool is_left) {
  std::optional<TimedPicture>& picture = is_left ? left_ : right_;
  ++report_.pictures_unpaired;
  (is_left ? pending_.arrival.left_alone : pending_.arrival.right_alone) = picture->time;
  picture.reset();
}

void BundleAssembler::ClosePair(Bundles& done) {
  if (!rig_ || !left_ || !right_) {
    return;
  }
  auto bundle = std::make_shared<FrameBundle>(std::exchange(pending_, {}));
  const Timestamp exposed = left_->time;
  bundle->stereo = std::make_shared<StereoFrame>(
      StereoFrame{exposed, std::move(left_->grey), std::move(right_->grey)});
  left_.reset();
  right_.reset();
  bundle->rig = rig_;
  bundle->sequence = next_sequence_++;
  bundle->time = newest_.value_or(exposed);
  const VehiclePose* nearest = last_pose_ ? &*last_pose_ : nullptr;
  for (const VehiclePose& pose : bundle->poses) {
    if (nearest == nullptr || std::abs(SecondsBetween(pose.time, exposed)) <
                                  std::abs(SecondsBetween(nearest->time, exposed))) {
      nearest = &pose;
    }
  }
  if (nearest != nullptr && std::abs(SecondsBetween(nearest->time, exposed)) <= kNearestPose_s) {
    bundle->pose_at_exposure = CarryPose(*nearest, exposed);
  }
  if (!bundle->poses.empty()) {
    last_pose_ = bundle->poses.back();
  }
  done.push_back(std::move(bundle));
}

Status BundleAssembler::TakeRig(const WireMessage& message, Bundles& done) {
  Result<RigMessage> rig = RigFromWire(message);
  if (!rig) {
    return rig.error();
  }
  const bool differs = rig->rig && !(rig_ && SameRig(*rig_, *rig->rig));
  if (differs && rig_ && message.sender != rig_sender_) {
    return InvalidError(
        "another rig than the one in use, of another sender; connect anew to take it");
  }
  if (!IsNews(message.channel, rig->time)) {
    return Ok();
  }
  if (differs) {
    rig_sender_ = message.sender;
    rig_ = std::make_shared<const StereoRig>(*rig->rig);
  }
  closed_stream_ = rig->bundle_end;
  if (!rig->bundle_end) {
    ClosePair(done);
    return Ok();
  }
  auto bundle = std::make_shared<FrameBundle>(std::exchange(pending_, {}));
  bundle->sequence = rig->sequence;
  bundle->time = rig->time;
  bundle->rig = rig->rig ? rig_ : nullptr;
  bundle->pose_at_exposure = rig->exposure_pose;
  bundle->discontinuity = rig->discontinuity;
  if (rig->has_pictures && left_ && right_) {
    bundle->stereo = std::make_shared<StereoFrame>(
        StereoFrame{left_->time, std::move(left_->grey), std::move(right_->grey)});
  } else {
    report_.pictures_unpaired += (left_ ? 1u : 0u) + (right_ ? 1u : 0u);
    if (left_) {
      bundle->arrival.left_alone = left_->time;
    }
    if (right_) {
      bundle->arrival.right_alone = right_->time;
    }
    bundle->pose_at_exposure = rig->has_pictures ? std::nullopt : bundle->pose_at_exposure;
  }
  left_.reset();
  right_.reset();
  if (rig->rotations.size() == bundle->poses.size()) {
    for (std::size_t i = 0; i < bundle->poses.size(); ++i) {
      bundle->poses[i].X_WB.R = rig->rotations[i];
    }
  }
  const std::size_t got[] = {bundle->poses.size(), bundle->imu.size(),  bundle->gps.size(),
                             bundle->laser.size(), bundle->acks.size(), bundle->truth.size()};
  for (std::size_t i = 0; i < 6; ++i) {
    report_.samples_lost += Missing(rig->sample_counts[i], got[i]);
  }
  if (last_sequence_ && rig->sequence > *last_sequence_ + 1) {
    report_.bundles_lost += rig->sequence - *last_sequence_ - 1;
  }
  last_sequence_ = rig->sequence;
  next_sequence_ = rig->sequence + 1;
  done.push_back(std::move(bundle));
  return Ok();
}

std::shared_ptr<const FrameBundle> BundleAssembler::TakePending(Timestamp now) {
  auto bundle = std::make_shared<FrameBundle>(std::exchange(pending_, {}));
  if (!bundle->poses.empty()) {
    last_pose_ = bundle->poses.back();
  }
  bundle->rig = rig_;
  bundle->sequence = next_sequence_++;
  bundle->time = now;
  return bundle;
}

void BundleAssembler::Reset() {
  pending_ = {};
  left_.reset();
  right_.reset();
  last_pose_.reset();
  last_sequence_.reset();
  newest_.reset();
  newest_of_.clear();
}

}  // namespace palace
