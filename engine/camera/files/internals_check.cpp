// Focal lengths and principal points that no camera has, whichever format tells them.
#include <cmath>
#include <string>
#include <utility>

#include "engine/camera/cahvor.h"
#include "engine/camera/files/camera_file_formats.h"
#include "engine/core/text.h"
#include "engine/model/rig_limits.h"

namespace palace {
namespace {

constexpr double kLeastFocal_px = 1;
constexpr double kMostFocal_px = RigLimits::kMostFocal_px;
/// The part of a larger picture that is kept may lie off its axis; no lens draws ten pictures away.
constexpr double kMostPictures = 10;

Status CheckFocal(const KeyedText& text, const std::string& key, double focal_px) {
  return focal_px >= kLeastFocal_px && focal_px <= kMostFocal_px
             ? Ok()
             : Status(text.Wrong(key, WithNumbers("gives a focal length of %g px, it must lie "
                                                  "within %g .. %.0f px; is it told in pixels?",
                                                  focal_px, kLeastFocal_px, kMostFocal_px)));
}

Status CheckCentre(const KeyedText& text, const std::string& key, double centre_px, int side) {
  const double most_px = side > 0 ? kMostPictures * side : RigLimits::kMostCentre_px;
  const std::string limit =
      side > 0 ? WithNumbers("%.0f px, %.0f times the picture's side", most_px, kMostPictures)
               : WithNumbers("%.0f px", most_px);
  return std::abs(centre_px) <= most_px
             ? Ok()
             : Status(text.Wrong(key, WithNumbers("puts the principal point at %g px, farther "
                                                  "than the limit of ",
                                                  centre_px) +
                                          limit));
}

Status CheckInternals(const KeyedText& text, const InternalsKeys& keys, const CameraModel& model) {
  const CahvInternals internals = InternalsOf(LinearPartOf(model));
  for (const Status& good :
       {CheckFocal(text, keys.focal_across, internals.hs_px),
        CheckFocal(text, keys.focal_down, internals.vs_px),
        CheckCentre(text, keys.centre_across, internals.hc_px, WidthOf(model)),
        CheckCentre(text, keys.centre_down, internals.vc_px, HeightOf(model))}) {
    if (!good) {
      return good;
    }
  }
  return Ok();
}

}  // namespace

Result<CameraModel> WithInternals(const KeyedText& text, const InternalsKeys& keys,
                                  CameraModel model) {
  const Status good = CheckInternals(text, keys, model);
  return good ? Result<CameraModel>(std::move(model)) : Result<CameraModel>(good.error());
}

}  // namespace palace
