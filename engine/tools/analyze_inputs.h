// What analyze works on: SLAD with the map of one pair, of a surveyed sequence, of an elevation
// model or of a cloud.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/model/image.h"
#include "engine/model/range_map.h"
#include "engine/model/settings/settings.h"
#include "engine/slad/slad.h"
#include "engine/tools/stopwatch.h"

namespace palace {

/// Where the pictures are, as given on the command line.
struct PairFiles {
  std::string left;  ///< a file, or a pattern whose last part may hold * and ?
  std::string right;
  std::filesystem::path rig;
  std::filesystem::path poses;  ///< POSES.csv; empty: that of RIG.toml, if it names one
  std::filesystem::path euroc;  ///< an EuRoC folder, in place of all others
};

struct AnalyzeInput {
  Slad slad;                              ///< it has a map
  int pairs = 0;                          ///< measured, in order of time; 0 without pictures
  int pairs_in_map = 0;                   ///< all of them; thesis mode has the newest only
  std::shared_ptr<const ImageU8> left;    ///< rectified, of the newest pair; null without pictures
  std::shared_ptr<const RangeMap> range;  ///< of that picture
  StereoQuality stereo;                   ///< of the newest pair
  std::optional<int> epsg;
  Stopwatch watch;
  std::vector<std::string> warnings;
};

/// Gives SLAD the pairs in order of time, as in flight: modern mode fuses them, thesis mode keeps
/// the map of the newest, with a warning. Several pairs need poses.
Result<AnalyzeInput> ElevationOfPairs(const PairFiles& files, const Settings& settings);

/// Whether this program may have the memory that deciding over such a map takes beside it; else an
/// error that tells how much that is, and ends in the remedy.
Status RoomToDecide(const GridGeometry& map, SladMode mode, const std::string& remedy);

/// Keeps the grid of the model unless cell_m is given. X east, Y north, Z up. Refuses, before it
/// reads the cells, a model that there is no room to decide over.
Result<AnalyzeInput> ElevationOfModel(const std::filesystem::path& path,
                                      std::optional<double> cell_m, const Settings& settings);

/// Text of x y z lines, or PLY (ascii, binary little endian). Covers all points: cells of cell_m
/// where given, else of the settings' size, enlarged so that the map fits and most cells hold a
/// point. X east, Y north, Z up.
Result<AnalyzeInput> ElevationOfCloud(const std::filesystem::path& path,
                                      std::optional<double> cell_m, const Settings& settings);

}  // namespace palace
