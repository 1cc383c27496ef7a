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
    result.samples_dropped += Prepend(older.poses, joined->poses);
    result.samples_dropped += Prepend(older.imu, joined->imu);
    result.samples_dropped += Prepend(older.gps, joined->gps);
    result.samples_dropped += Prepend(older.laser, joined->laser);
    result.samples_dropped += Prepend(older.truth, joined->truth);
    if (!joined->status) {
      joined->status = older.status;
    }
    if (!joined->stereo && older.stereo) {
      joined->stereo = older.stereo;
      joined->pose_at_exposure = older.pose_at_exposure;
    }
  }
  result.bundle = std::move(joined);
  return result;
}

}  // namespace palace
