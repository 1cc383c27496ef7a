#include "engine/capture/image_sequence.h"

#include <fnmatch.h>

#include <algorithm>
#include <map>
#include <system_error>
#include <utility>

#include "engine/camera/files/poses_file.h"
#include "engine/capture/picture_file.h"
#include "engine/capture/picture_order.h"
#include "engine/capture/playback_turns.h"
#include "engine/core/plain_text.h"
#include "engine/core/text.h"

namespace palace {
namespace {

namespace fs = std::filesystem;

/// The pictures by the stem of the left one.
Result<std::map<std::string, ImagePair>> ByStem(const std::vector<ImagePair>& pairs) {
  std::map<std::string, ImagePair> by_stem;
  for (const ImagePair& pair : pairs) {
    const auto [other, fresh] = by_stem.emplace(pair.left.stem().string(), pair);
    if (!fresh) {
      return InvalidError(pair.left.string() + " and " + other->second.left.string() +
                          " have one stem, by which poses name them; rename one");
    }
  }
  return by_stem;
}

Error Unposed(const PosesFile& file, const std::map<std::string, ImagePair>& by_stem) {
  std::string first;
  int missing = 0;
  for (const auto& [stem, pair] : by_stem) {
    if (file.Find(stem) == nullptr) {
      first = missing++ == 0 ? stem : first;
    }
  }
  return InvalidError(file.name + ":" + std::to_string(file.last_line) + ": no row with file = " +
                      Printable(first) + "; " + std::to_string(missing) + " of " +
                      std::to_string(by_stem.size()) + " left pictures have none, the file has " +
                      std::to_string(file.poses.size()) + " rows; give each left picture a row");
}

Result<ImageSequence> InOrderOfPoses(const std::vector<ImagePair>& pairs, const PosesFile& file) {
  const auto by_stem = ByStem(pairs);
  if (!by_stem) {
    return by_stem.error();
  }
  ImageSequence sequence;
  double first_s = 0;
  for (const SurveyedPose& row : file.poses) {
    const auto pair = by_stem->find(row.stem);
    if (pair == by_stem->end()) {
      continue;
    }
    first_s = sequence.pairs.empty() ? row.time_s : first_s;
    sequence.pairs.push_back(pair->second);
    ImagePair& placed = sequence.pairs.back();
    placed.time = AddSeconds(kRecordedStart, row.time_s - first_s);
    placed.pose = VehiclePose{};
    placed.pose->time = placed.time;
    placed.pose->X_WB = row.X_WB;
  }
  if (sequence.pairs.size() < pairs.size()) {
    return Unposed(file, *by_stem);
  }
  return sequence;
}

}  // namespace

Result<StereoFrame> ReadStereoPair(const fs::path& left, const fs::path& right) {
  auto left_image = ReadGreyPicture(left);
  if (!left_image) {
    return left_image.error();
  }
  auto right_image = ReadGreyPicture(right);
  if (!right_image) {
    return right_image.error();
  }
  if (left_image->width() != right_image->width() ||
      left_image->height() != right_image->height()) {
    return InvalidError(right.string() + ": the picture is " +
                        SizeText(right_image->width(), right_image->height()) + ", the left one (" +
                        left.string() + ") is " +
                        SizeText(left_image->width(), left_image->height()) +
                        "; both cameras of a pair give the same size");
  }
  return StereoFrame{{}, std::move(left_image).value(), std::move(right_image).value()};
}

std::vector<fs::path> ExpandPattern(const fs::path& folder, const std::string& pattern) {
  const fs::path full = folder / pattern;
  const std::string name = full.filename().string();
  const fs::path parent = full.has_parent_path() ? full.parent_path() : ".";
  std::vector<fs::path> files;
  std::error_code code;
  for (fs::directory_iterator entry(parent, code), end; !code && entry != end;
       entry.increment(code)) {
    std::error_code type_code;
    if (entry->is_regular_file(type_code) &&
        fnmatch(name.c_str(), entry->path().filename().c_str(), FNM_PERIOD) == 0) {
      files.push_back(entry->path());
    }
  }
  std::sort(files.begin(), files.end(), IsEarlierName);
  return files;
}

Result<ImageSequence> SequenceOf(const std::vector<fs::path>& left,
                                 const std::vector<fs::path>& right, const RigFile& rig,
                                 const fs::path& poses_csv) {
  if (left.size() != right.size()) {
    return InvalidError(left.front().string() + ", " + right.front().string() + ": " +
                        std::to_string(left.size()) + " left and " + std::to_string(right.size()) +
                        " right pictures; every pair needs both");
  }
  ImageSequence sequence;
  sequence.rate_hz = rig.rig.rate_hz;
  for (std::size_t k = 0; k < left.size(); ++k) {
    const Timestamp time = AddSeconds(kRecordedStart, static_cast<double>(k) / rig.rig.rate_hz);
    sequence.pairs.push_back({left[k], right[k], time, rig.pose});
    if (rig.pose) {
      sequence.pairs.back().pose->time = time;
    }
  }
  if (poses_csv.empty()) {
    return sequence;
  }
  const auto file = LoadPosesFile(poses_csv);
  if (!file) {
    return file.error();
  }
  auto surveyed = InOrderOfPoses(sequence.pairs, *file);
  if (surveyed && surveyed->pairs.size() > 1) {
    surveyed->rate_hz = static_cast<double>(surveyed->pairs.size() - 1) /
                        SecondsBetween(surveyed->pairs.front().time, surveyed->pairs.back().time);
  } else if (surveyed) {
    surveyed->rate_hz = sequence.rate_hz;
  }
  return surveyed;
}

}  // namespace palace
