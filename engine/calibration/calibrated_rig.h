// RIG.toml of a calibration.
#pragma once

#include <string>

#include "engine/calibration/calibration.h"

namespace palace {

/// The pictures a rig's file names, as patterns with their folder; empty: none.
struct RigPictures {
  std::string left{};
  std::string right{};
};

/// The text of RIG.toml beside left.cahvor and right.cahvor. Criteria that were not met stand at
/// its head. What a calibration cannot know, mount and pose, has defaults that say so.
std::string RigToToml(const Calibration& calibration, const RigPictures& pictures);

}  // namespace palace
