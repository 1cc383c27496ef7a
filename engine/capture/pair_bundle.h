// A stereo pair without a vehicle, as a bundle.
#pragma once

#include <memory>
#include <optional>

#include "engine/model/frame_bundle.h"

namespace palace {

/// Time is the pair's; the pose is that of [pose], if there is one. Sequence 0. No vehicle status
/// and no laser: there is no vehicle.
std::shared_ptr<FrameBundle> BundleOf(std::shared_ptr<const StereoRig> rig,
                                      const std::optional<VehiclePose>& pose,
                                      std::shared_ptr<const StereoFrame> frame);

}  // namespace palace
