// Stereo pairs for analyze: rectified, measured and fused by the calls of flight.
#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "engine/camera/files/rig_file.h"
#include "engine/camera/rectification.h"
#include "engine/capture/euroc/euroc_folder.h"
#include "engine/capture/image_sequence.h"
#include "engine/core/text.h"
#include "engine/slad/terrain/terrain_points.h"
#include "engine/stereo/range_measurement.h"
#include "engine/tools/analyze_inputs.h"
#include "engine/tools/rig_doubts.h"

namespace palace {
namespace {

namespace fs = std::filesystem;

/// A file of that very name, else those that match.
std::vector<fs::path> Matching(const std::string& pattern) {
  std::error_code error;
  if (fs::exists(pattern, error) || pattern.find_first_of("*?") == std::string::npos) {
    return {pattern};
  }
  return ExpandPattern("", pattern);
}

/// The rig, the pairs, and by which file or folder messages call them.
struct Pictures {
  RigFile rig;
  ImageSequence sequence;
  std::string name;
  std::string left_out{};
};

Result<ImageSequence> FindPairs(const PairFiles& files, const RigFile& rig) {
  const auto left = Matching(files.left), right = Matching(files.right);
  for (const auto& [found, pattern] :
       {std::pair(&left, &files.left), std::pair(&right, &files.right)}) {
    if (found->empty()) {
      return UnavailableError("no file matches " + *pattern + "; check the name");
    }
  }
  const fs::path poses = files.poses.empty() ? rig.poses_csv : files.poses;
  if (left.size() > 1 && poses.empty()) {
    return UsageError(std::to_string(left.size()) + " left pictures need --poses POSES.csv");
  }
  return SequenceOf(left, right, rig, poses);
}

Result<Pictures> FindPictures(const PairFiles& files) {
  if (!files.euroc.empty()) {
    auto euroc = LoadEurocFolder(files.euroc);
    if (!euroc) {
      return euroc.error();
    }
    return Pictures{std::move(euroc->rig), std::move(euroc->sequence), files.euroc.string(),
                    std::move(euroc->left_out)};
  }
  auto rig = LoadRigFile(files.rig);
  if (!rig) {
    return rig.error();
  }
  auto sequence = FindPairs(files, *rig);
  if (!sequence) {
    return sequence.error();
  }
  return Pictures{std::move(rig).value(), std::move(sequence).value(), files.rig.string()};
}

/// What fusion goes through, pair by pair.
struct Work {
  const RigFile& rig;
  const StereoRectifier& rectifier;
  const Settings& settings;
  bool several = false;         ///< pairs, so that warnings name theirs
  bool ground_at_zero = false;  ///< the poses say how high above the ground
  StereoMatcher matcher{};
  GroundBounds seen{HUGE_VAL, -HUGE_VAL, HUGE_VAL, -HUGE_VAL};  ///< by all pairs
};

void WarnOfStereo(const StereoQuality& quality, const std::string& pair,
                  std::vector<std::string>& warnings) {
  if (quality.coverage < 0.05) {
    warnings.push_back(pair +
                       WithNumbers("only %.1f %% of the picture could be matched; check rig, "
                                   "disparity window and texture",
                                   100 * quality.coverage));
  }
  if (quality.suspect_swapped) {
    warnings.push_back(pair + "left and right look exchanged");
  }
  if (quality.suspect_same) {
    warnings.push_back(pair + "left and right are the same picture");
  }
}

void Widen(const RangeMap& range, GroundBounds& seen) {
  const TerrainPoints points = PointsFromRange(range);
  if (points.empty()) {
    return;
  }
  const GroundBounds now = BoundsOfData(points);
  seen = {std::min(seen.north_min_m, now.north_min_m), std::max(seen.north_max_m, now.north_max_m),
          std::min(seen.east_min_m, now.east_min_m), std::max(seen.east_max_m, now.east_max_m)};
}

Status AddPair(const ImagePair& pair, Work& work, AnalyzeInput& input) {
  const std::string name = pair.left.string() + ", " + pair.right.string();
  auto raw = ReadStereoPair(pair.left, pair.right);
  if (!raw) {
    return raw.error();
  }
  raw->time = pair.time;
  input.watch.Lap("read");
  const auto rectified = work.rectifier.Rectify(*raw);
  if (!rectified) {
    return InvalidError(name + ": " + rectified.error().message);
  }
  input.watch.Lap("rectify");
  const VehiclePose at = pair.pose.value_or(VehiclePose{});
  auto match =
      MeasureRanges({.raw = *raw,
                     .pair = *rectified,
                     .rig = work.rig.rig,
                     .rectifier = work.rectifier,
                     .pose = ViewPose{at.X_WB * work.rectifier.X_BC(work.rig.rig), at.sigmas}},
                    work.settings.stereo, work.matcher);
  if (!match) {
    return InvalidError(name + ": " + match.error().message);
  }
  input.watch.Lap("stereo");
  input.stereo = match->quality;
  const std::string of_pair = work.several ? name + ": " : "";
  WarnOfStereo(match->quality, of_pair, input.warnings);
  if (work.ground_at_zero) {
    if (const std::string doubt = DoubtOfHeight(match->range); !doubt.empty()) {
      input.warnings.push_back(of_pair + doubt);
    }
  }
  Widen(match->range, work.seen);
  input.left = rectified->left;
  input.range = std::make_shared<const RangeMap>(std::move(match->range));
  input.slad.Add({.view = {rectified->left, rectified->right, input.range}, .p_WB = at.X_WB.p},
                 work.settings.slad);
  input.watch.Lap("fuse");
  ++input.pairs;
  input.pairs_in_map = work.settings.slad.mode == SladMode::kModern ? input.pairs : 1;
  return Ok();
}

constexpr double kHardlyMore_m = 1;  // beyond the map: what a hover drifts

/// What is seen beyond the map is not judged; what is judged in larger cells is judged coarser.
void WarnOfMap(const GroundBounds& seen, const SladSettings& slad, AnalyzeInput& input) {
  const GridGeometry& g = input.slad.elevation()->geometry;
  if (slad.mode == SladMode::kThesis || slad.grid.bounds != BoundsMode::kData) {
    return;
  }
  if (g.cell_m > slad.grid.cell_m) {
    input.warnings.push_back(
        WithNumbers("cell enlarged from %.3g m to %.3g m so that the map holds the view",
                    slad.grid.cell_m, g.cell_m));
  }
  const double north_m = seen.north_max_m - seen.north_min_m;
  const double east_m = seen.east_max_m - seen.east_min_m;
  if (north_m > g.rows * g.cell_m + kHardlyMore_m || east_m > g.cols * g.cell_m + kHardlyMore_m) {
    input.warnings.push_back(
        WithNumbers("the map holds %.1f x %.1f m, what the last pair saw and ground around it, ",
                    g.rows * g.cell_m, g.cols * g.cell_m) +
        WithNumbers("of the %.1f x %.1f m that all pairs saw; raise slad.grid_rows and "
                    "slad.grid_cols to keep more",
                    north_m, east_m));
  }
}

}  // namespace

Result<AnalyzeInput> ElevationOfPairs(const PairFiles& files, const Settings& settings) {
  const auto pictures = FindPictures(files);
  if (!pictures) {
    return pictures.error();
  }
  const auto& [rig, sequence, name, left_out] = *pictures;
  const bool posed = sequence.pairs.front().pose.has_value();
  if (!posed && rig.rig.num_disparities == 0) {
    return InvalidError(
        name + (files.euroc.empty()
                    ? ": needs [pose] height_m, or [rig] min_disparity_px and num_disparities, to "
                      "know where to search"
                    : ": has no state_groundtruth_estimate0; without poses give its pictures by "
                      "--left, --right and a RIG.toml"));
  }
  const auto rectifier = StereoRectifier::Make(rig.rig);
  if (!rectifier) {
    return InvalidError(name + ": " + rectifier.error().message);
  }
  AnalyzeInput input;
  if (!left_out.empty()) {
    input.warnings.push_back(name + ": " + left_out);
  }
  if (!posed) {
    input.warnings.push_back(name +
                             " has no [pose]: attitude taken as level, heights from the camera");
  }
  if (const std::string doubt = DoubtOfFocalLength(rig.rig); !doubt.empty()) {
    input.warnings.push_back(name + ": " + doubt);
  }
  // [pose] says so; poses of others do where nothing else says how far away the ground is.
  const bool own_pose = files.poses.empty() && rig.poses_csv.empty();
  const bool ground_at_zero =
      posed && files.euroc.empty() && (own_pose || rig.rig.num_disparities == 0);
  Work work{rig, *rectifier, settings, sequence.pairs.size() > 1, ground_at_zero};
  for (const ImagePair& pair : sequence.pairs) {
    if (const Status done = AddPair(pair, work, input); !done) {
      return done.error();
    }
  }
  if (input.pairs_in_map < input.pairs) {
    input.warnings.push_back(WithNumbers(
        "thesis mode fuses nothing: the map is that of the last of %.0f pairs", input.pairs));
  }
  WarnOfMap(work.seen, settings.slad, input);
  return input;
}

}  // namespace palace
