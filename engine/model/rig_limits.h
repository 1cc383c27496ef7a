// What a stereo rig may be, whoever tells it: RIG.toml, or a vehicle on the bus. Wide enough for
// any camera that flies, narrow enough that no rig asks for memory or arithmetic that is not there.
#pragma once

#include <string>

#include "engine/model/rig.h"

namespace palace {

struct RigLimits {
  static constexpr int kLeastSide_px = 32;  ///< the columns that stereo must see in both pictures
  static constexpr int kMostSide_px = 8192;
  static constexpr int kMostPixels = 1 << 25;  ///< rectification keeps 16 bytes for each
  static constexpr double kLeastFocal_px = 1e-3;
  static constexpr double kMostFocal_px = 1e6;
  static constexpr double kMostCentre_px = 1e6;
  static constexpr double kMostDistortion = 100;
  static constexpr double kLeastBaseline_m = 1e-3;
  static constexpr double kMostBaseline_m = 1000;
  static constexpr double kMostPosition_m = 100;
  static constexpr double kLeastRate_hz = 1e-3;
  static constexpr double kMostRate_hz = 1000;
  static constexpr int kMostDisparities = 1024;
};

/// What is wrong with the size, in words with number and limit; empty: nothing.
std::string WhyNoPictureSize(int width, int height);
/// What is wrong with size, focal length or principal point; numbers that are not finite are.
std::string WhyNoPinhole(const PinholeCamera& camera);
std::string WhyNoBaseline(double baseline_m);
/// All of a rig, its camera models' sizes too.
std::string WhyNoRig(const StereoRig& rig);

}  // namespace palace
