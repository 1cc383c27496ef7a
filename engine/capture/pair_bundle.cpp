#include "engine/capture/pair_bundle.h"

#include <utility>

namespace palace {

std::shared_ptr<FrameBundle> BundleOf(std::shared_ptr<const StereoRig> rig,
                                      const std::optional<VehiclePose>& pose,
                                      std::shared_ptr<const StereoFrame> frame) {
  auto bundle = std::make_shared<FrameBundle>();
  bundle->rig = std::move(rig);
  bundle->time = frame->time;
  if (pose) {
    bundle->pose_at_exposure = pose;
    bundle->pose_at_exposure->time = frame->time;
    bundle->poses.push_back(*bundle->pose_at_exposure);
  }
  bundle->stereo = std::move(frame);
  return bundle;
}

}  // namespace palace
