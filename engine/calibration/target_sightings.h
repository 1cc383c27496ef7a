// The target in all pictures of a calibration.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "engine/calibration/calibration.h"
#include "engine/core/result.h"
#include "engine/model/calibration_target.h"
#include "engine/model/image.h"

namespace palace {

/// What the pictures show, and their common size.
struct Sightings {
  std::vector<TargetView> views{};
  std::vector<std::string> unseen{};  ///< pictures without a target, with the reason
  int width = 0;
  int height = 0;
};

/// How pictures are read, and who is told before each: its number from 1, of how many.
struct PictureReader {
  std::function<Result<ImageU8>(const std::filesystem::path&)> read;
  std::function<void(std::size_t, std::size_t)> before = [](std::size_t, std::size_t) {};
};

/// View by view, one picture of each side. Refuses unlike numbers of pictures, one picture given as
/// both sides of a view (which then has no baseline), unlike sizes, and pictures most of which show
/// no target. A picture without a target is told in `unseen`.
Result<Sightings> SightTarget(const std::vector<std::filesystem::path>& left,
                              const std::vector<std::filesystem::path>& right,
                              const CalibrationTarget& target, const PictureReader& reader);

}  // namespace palace
