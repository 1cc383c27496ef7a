// What palacectl track leaves: annotated pictures, track.csv, report.html, and its summary.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/model/image.h"
#include "engine/tracking/feature_follower.h"

namespace palace {

struct TrackedPicture {
  int frame = 0;        ///< from 0; one that could not be decoded has its number, but no row
  double time_s = NAN;  ///< since the first picture; NaN unknown
  double follow_ms = 0;
  FollowedFeature told;
  std::string file;  ///< of the annotated picture in the folder; empty: none was written
};

struct Track {
  std::string source;
  std::string chosen;  ///< how the feature was: "given", or selected, with its figures
  FollowerOptions options;
  int width = 0;
  int height = 0;
  int undecodable = 0;
  std::vector<TrackedPicture> pictures{};
  std::string ended{};  ///< why, where it was no end of the source
};

/// "120 pictures, tracked 118, lost 2, re-acquired 1, 0.8 ms a picture"
std::string TrackSummary(const Track& track);
/// "frame 31, 1.240 s: LOST, coherence 0.21, limit 0.70"
std::string TrackEvent(const TrackedPicture& picture);

/// The picture with the search window (white, 1 px on 3 px of black), corner brackets of 20 x 20 px
/// at the feature (grey while it is lost: it is only expected there) and the coherence with its
/// limit.
ImageU8 AnnotatedPicture(const ImageU8& picture, const TrackedPicture& tracked,
                         double min_coherence);

std::string TrackCsv(const Track& track);
/// One page with its pictures in it; those of changes of state, the first twelve.
std::string TrackReport(const Track& track, const std::filesystem::path& folder);

}  // namespace palace
