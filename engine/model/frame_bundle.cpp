#include "engine/model/frame_bundle.h"

#include <iterator>
#include <utility>

namespace palace {
namespace {

/// `older` before `newer`. Returns how many of the oldest had to go.
template <typename T>
std::size_t Prepend(const std::vector<T>& older, std::vector<T>& newer) {
  const std::size_t room =
      newer.size() < kMostSamplesInBundle ? kMostSamplesInBundle - newer.size() : 0;
  const std::size_t dropped = older.size() > room ? older.size() - room : 0;
  newer.insert(newer.begin(), std::next(older.begin(), static_cast<std::ptrdiff_t>(dropped)),
               older.end());
  return dropped;
}

ArrivalNotes Joined(const ArrivalNotes& older, const ArrivalNotes& newer, bool jump_between) {
  ArrivalNotes joined = newer;
  if (older.clock) {
    joined.clock = newer.clock ? newer.clock : older.clock;
    if (newer.clock) {
      joined.clock->stepped_s += older.clock->stepped_s;
      joined.clock->stalled_s += older.clock->stalled_s;
    }
  }
  joined.poses_invalid += older.poses_invalid;
  if (!jump_between) {
    for (std::size_t i = 0; i < kChannelCount; ++i) {
      joined.overtaken[i] += older.overtaken[i];
    }
    joined.left_alone = newer.left_alone ? newer.left_alone : older.left_alone;
    joined.right_alone = newer.right_alone ? newer.right_alone : older.right_alone;
  }
  return joined;
}

}  // namespace

FrameBundle WithoutPictures(const FrameBundle& bundle) {
  FrameBundle slim = bundle;
  slim.stereo = nullptr;
  slim.pose_at_exposure.reset();
  return slim;
}

JoinedBundle Join(const FrameBundle& older, const FrameBundle& newer) {
  auto joined = std::make_shared<FrameBundle>(newer);
  JoinedBundle result;
  const auto overtake = [&](ChannelId channel, std::size_t messages) {
    joined->arrival.overtaken[static_cast<std::size_t>(channel)] += static_cast<int>(messages);
  };
  const auto prepend = [&](ChannelId channel, const auto& before, auto& samples) {
    const std::size_t dropped = Prepend(before, samples);
    result.samples_dropped += dropped;
    overtake(channel, dropped);
  };
  // Orders and answers are not of a moment: they outlive a jump in time.
  joined->recorded_commands.insert(joined->recorded_commands.begin(),
                                   older.recorded_commands.begin(), older.recorded_commands.end());
  result.samples_dropped += Prepend(older.acks, joined->acks);
  result.samples_dropped += Prepend(older.refused, joined->refused);
  joined->arrival = Joined(older.arrival, newer.arrival, newer.discontinuity);
  if (!joined->authority) {
    joined->authority = older.authority;
  }
  if (!joined->rig) {
    joined->rig = older.rig;
  }
  result.pair_replaced = older.stereo && (newer.stereo || newer.discontinuity);
  if (!newer.discontinuity) {
    joined->discontinuity = older.discontinuity;
    prepend(ChannelId::kVehiclePose, older.poses, joined->poses);
    prepend(ChannelId::kImu, older.imu, joined->imu);
    prepend(ChannelId::kGps, older.gps, joined->gps);
    prepend(ChannelId::kLaserRange, older.laser, joined->laser);
    result.samples_dropped += Prepend(older.truth, joined->truth);
    if (!joined->status) {
      joined->status = older.status;
    } else {
      overtake(ChannelId::kVehicleStatus, older.status ? 1 : 0);
    }
    if (result.pair_replaced) {
      overtake(ChannelId::kCameraLeft, 1);
      overtake(ChannelId::kCameraRight, 1);
    } else if (older.stereo) {
      joined->stereo = older.stereo;
      joined->pose_at_exposure = older.pose_at_exposure;
    }
  }
  result.bundle = std::move(joined);
  return result;
}

}  // namespace palace
