// Stereo pairs on disk in the order in which they were taken: what belongs together, when, and from
// where.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/camera/files/rig_file.h"
#include "engine/core/result.h"
#include "engine/model/frame_bundle.h"

namespace palace {

struct ImagePair {
  std::filesystem::path left;
  std::filesystem::path right;
  Timestamp time;
  std::optional<VehiclePose> pose;  ///< at `time`
};

/// In order of time.
struct ImageSequence {
  std::vector<ImagePair> pairs;
  double rate_hz = 10;  ///< pairs a second, the mean where they were surveyed; tells no time
};

/// Files that match a pattern whose last part may hold * and ?, sorted by name.
std::vector<std::filesystem::path> ExpandPattern(const std::filesystem::path& folder,
                                                 const std::string& pattern);

/// The k-th left picture belongs to the k-th right one, and there is one. `poses_csv` empty: pair k
/// is exposed at kRecordedStart + k / rate_hz of the rig, at [pose] if there is one. Else the pairs
/// stand in the order of that file's rows, the first at kRecordedStart, each at its row's pose;
/// rows without a picture count for nothing. Refuses unequal numbers of pictures, two left pictures
/// of one stem, and a left picture without a row.
Result<ImageSequence> SequenceOf(const std::vector<std::filesystem::path>& left,
                                 const std::vector<std::filesystem::path>& right,
                                 const RigFile& rig, const std::filesystem::path& poses_csv);

/// Reads both pictures as 8-bit grey. Errors name the file; sizes that differ from each other are
/// refused. The frame's time is zero.
Result<StereoFrame> ReadStereoPair(const std::filesystem::path& left,
                                   const std::filesystem::path& right);

}  // namespace palace
