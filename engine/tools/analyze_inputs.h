// What analyze works on: an elevation map from a pair, an elevation model or a cloud.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/model/elevation_map.h"
#include "engine/model/image.h"
#include "engine/model/range_map.h"
#include "engine/model/settings.h"
#include "engine/slad/sites/site_selection.h"

namespace palace {

struct StageTime {
  std::string stage;
  double milliseconds = 0;
};

struct AnalyzeInput {
  ElevationMap map;
  SiteContext context;            ///< camera width 0 without a picture
  std::optional<ImageU8> left;    ///< rectified
  std::optional<RangeMap> range;  ///< of that picture
  StereoQuality stereo;           ///< of the pair; meaningful with a range map
  std::optional<int> epsg;
  std::vector<StageTime> timings;
  std::vector<std::string> warnings;
};

/// settings.slad.cell_m is enlarged, with a warning, when the data would not fit the grid, unless
/// the bounds are given.
Result<AnalyzeInput> ElevationOfPair(const std::filesystem::path& left,
                                     const std::filesystem::path& right,
                                     const std::filesystem::path& rig, Settings settings);

/// Keeps the grid of the model unless cell_m is given. X east, Y north, Z up.
Result<AnalyzeInput> ElevationOfModel(const std::filesystem::path& path,
                                      std::optional<double> cell_m, const Settings& settings);

/// Text of x y z lines, or PLY (ascii, binary little endian). Covers all points: cells of cell_m
/// where given, else of the settings' size, enlarged so that the map fits and most cells hold a
/// point. X east, Y north, Z up.
Result<AnalyzeInput> ElevationOfCloud(const std::filesystem::path& path,
                                      std::optional<double> cell_m, const Settings& settings);

}  // namespace palace
