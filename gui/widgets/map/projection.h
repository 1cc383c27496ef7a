// Where points of W fall on a rectified picture as it lies on the screen.
#pragma once

#include <optional>

#include "engine/model/snapshot.h"
#include "gui/widgets/ui_frame.h"

namespace palace {

/// The rectified left camera of the newest pictures, if one is known.
std::optional<PinholeCamera> LeftCamera(const EngineSnapshot& snap);

/// A camera and the rectangle its picture fills on the screen.
struct PictureView {
  PinholeCamera camera;
  RigidTransform X_WC;
  Rect rect;

  float ScalePx() const { return rect.w / static_cast<float>(camera.width); }
  /// Screen position of a picture position; (0,0) is the centre of the top-left pixel.
  ImVec2 ScreenFromPixel(const Eigen::Vector2d& pixel) const;
  /// Empty behind the camera. The result may lie outside the picture.
  std::optional<ImVec2> ScreenFromPoint(const Eigen::Vector3d& p_W) const;
  /// Screen pixels per metre at a point; 0 behind the camera.
  float PixelsPerMetre(const Eigen::Vector3d& p_W) const;
  /// The same for a scale bar; 0 beside the picture, too: the scale there is that of nothing in it.
  float ScaleOfPicture(const Eigen::Vector3d& p_W) const;
};

/// Circle of `radius_m` about a site, on the plane of its ground, projected to the screen.
std::vector<ImVec2> ProjectCircle(const PictureView& view, const LandingSite& site,
                                  double radius_m);

/// Where the corners of the picture meet the horizontal plane at height_m (up-positive): north and
/// east. Empty where the camera does not look down.
std::vector<Eigen::Vector2d> GroundFootprint(const PinholeCamera& camera,
                                             const RigidTransform& X_WC, double height_m);

}  // namespace palace
