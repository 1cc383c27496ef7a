#include "engine/calibration/target_sightings.h"

#include <utility>

#include "engine/calibration/target_detection.h"

namespace palace {
namespace {

namespace fs = std::filesystem;

Status CheckPairs(const std::vector<fs::path>& left, const std::vector<fs::path>& right) {
  if (left.size() != right.size()) {
    return InvalidError(std::to_string(left.size()) + " left and " + std::to_string(right.size()) +
                        " right pictures; every view needs one of each, in the same order");
  }
  for (std::size_t v = 0; v < left.size(); ++v) {
    std::error_code error;
    if (fs::equivalent(left[v], right[v], error)) {
      return InvalidError("view " + std::to_string(v + 1) + ": --left and --right give the same " +
                          "picture " + left[v].string() +
                          "; give the two cameras' pictures in the same order");
    }
  }
  return Ok();
}

Result<TargetObservation> Look(const fs::path& file, const CalibrationTarget& target,
                               const PictureReader& reader, Sightings& sightings) {
  const Result<ImageU8> picture = reader.read(file);
  if (!picture) {
    return picture.error();
  }
  if (sightings.width == 0) {
    sightings.width = picture->width();
    sightings.height = picture->height();
  }
  if (picture->width() != sightings.width || picture->height() != sightings.height) {
    return InvalidError(file.string() + " has " + std::to_string(picture->width()) + " x " +
                        std::to_string(picture->height()) + " px, the pictures before it " +
                        std::to_string(sightings.width) + " x " + std::to_string(sightings.height) +
                        "; one calibration needs one size of picture");
  }
  const auto seen = DetectTarget(*picture, target);
  if (!seen) {
    sightings.unseen.push_back(file.string() + ": " + seen.error().message);
    return TargetObservation{};
  }
  return seen;
}

}  // namespace

Result<Sightings> SightTarget(const std::vector<fs::path>& left, const std::vector<fs::path>& right,
                              const CalibrationTarget& target, const PictureReader& reader) {
  if (const Status pairs = CheckPairs(left, right); !pairs) {
    return pairs.error();
  }
  Sightings sightings;
  for (std::size_t v = 0; v < left.size(); ++v) {
    TargetView view;
    view.name = left[v].filename().string();
    view.right_name = right[v].filename().string();
    for (const bool is_left : {true, false}) {
      reader.before(2 * v + (is_left ? 1 : 2), 2 * left.size());
      auto seen = Look(is_left ? left[v] : right[v], target, reader, sightings);
      if (!seen) {
        return seen.error();
      }
      (is_left ? view.left : view.right) = std::move(*seen);
    }
    MatchTurn(target, view.left, view.right);
    sightings.views.push_back(std::move(view));
  }
  if (sightings.unseen.size() > left.size()) {
    return InvalidError("the target was not found in " + std::to_string(sightings.unseen.size()) +
                        " of " + std::to_string(2 * left.size()) +
                        " pictures (half of them are the most); does the target's file describe "
                        "the board? First " +
                        sightings.unseen.front());
  }
  return sightings;
}

}  // namespace palace
