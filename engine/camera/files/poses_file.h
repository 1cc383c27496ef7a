// POSES.csv: when and from where each pair of a surveyed sequence was taken. A person edits it, or
// a survey's software writes it.
//
//   file,time,north,east,down,roll,pitch,heading
//   left_0001,0.0,12.5,-3.0,-30.0,0.4,-1.2,91.0     # the vehicle's reference point in W
//
// The header row holds each column once, in any order. `file` is the stem of the left picture (its
// name without folder and ending), `time` seconds of any clock, places metres, angles degrees. W's
// origin is where the survey puts it; stereo expects the ground near down = 0 unless RIG.toml fixes
// the disparity window. Text from '#' on is a comment; blank lines count for nothing.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/frames.h"
#include "engine/core/result.h"

namespace palace {

/// One row.
struct SurveyedPose {
  std::string stem;
  double time_s = 0;
  RigidTransform X_WB;
};

struct PosesFile {
  std::string name;                 ///< path, for messages
  std::vector<SurveyedPose> poses;  ///< in order of time, at least one; stems differ
  int last_line = 0;                ///< of the last row

  /// Null when no row has that stem.
  const SurveyedPose* Find(const std::string& stem) const;
};

/// Refuses unknown, missing and repeated columns, rows of another length, empty and repeated stems,
/// values that are no number, not finite or out of their limits, and times that do not grow by a
/// microsecond at least from row to row. Errors name file, line, column, value and limit.
Result<PosesFile> LoadPosesFile(const std::filesystem::path& path);

}  // namespace palace
