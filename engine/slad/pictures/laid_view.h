// A picture laid into an older one by the ground: where its pixels lie there by the poses, and what
// the poses leave over beside a line, by the ground's texture. Internal to the SLAD room.
//
//   1  whole pixels for the whole picture: least absolute difference of the grey over every shift,
//      so that a line along a row of samples does not draw it
//   2  beside a line, on both sides of it: shift along and across and turn, by least squares on the
//      grey (Lucas & Kanade 1981) without its outliers: the line lies elsewhere in the older one
//
// Frames: pixels of the rectified left pictures, both of one camera.
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "engine/slad/pictures/line_pieces.h"
#include "engine/slad/pictures/older_views.h"
#include "engine/slad/pictures/scene_ground.h"

namespace palace {

/// A point of the new picture and where the pose alone lays it in the older one.
struct Laid {
  double grey = 0;
  Eigen::Vector2d q = Eigen::Vector2d::Zero();
  double along = 0;  ///< from the middle of the line, -1 to 1
};

/// Bilinear; `q` must lie inside by a pixel.
double GreyAt(const ImageF& picture, const Eigen::Vector2d& q);
bool IsInside(const ImageF& picture, const Eigen::Vector2d& q, double rim_px);

/// Every second pixel of a chain.
struct PictureLine {
  PictureLine(const MarkStrips& strips, const std::vector<LinePiece>& chain) {
    for (const LinePiece& piece : chain) {
      for (int k = 0; k < kStrip_px; k += kStep_px) {
        pixels.push_back(strips.Pixel(piece, k / double(kStrip_px - 1)));
      }
    }
  }
  /// -1 at its left end to 1.
  double Along(int x) const {
    const double from = pixels.front().x(), to = pixels.back().x();
    return (2 * x - from - to) / std::max(1.0, to - from);
  }

  static constexpr int kStep_px = 2;
  std::vector<Eigen::Vector2d> pixels;
};

class LaidView {
 public:
  /// view, ground and old must outlive it. `smooth`: the view's picture, smoothed as the older one.
  LaidView(const SceneView& view, const SceneGround& ground, std::shared_ptr<const ImageF> smooth,
           const OlderView& old);

  /// What the ground beside a line leaves over: shift, and what it turns to its ends.
  struct Registered {
    Eigen::Vector3d left_px = Eigen::Vector3d::Zero();
    double sigma_px = 0;  ///< of the shift across

    Eigen::Vector2d operator()(const Laid& laid) const {
      return laid.q + Eigen::Vector2d(left_px.x(), left_px.y() + left_px.z() * laid.along);
    }
  };

  /// Nothing where too little of the ground beside the line is seen in both, or does not tell.
  std::optional<Registered> Register(const PictureLine& line) const;
  /// Disparity of the ground at a pixel; nothing where it is not usable.
  std::optional<double> GroundAt(int x, int y) const;
  /// Where the poses lay a pixel of that disparity; NaN behind the older camera.
  Eigen::Vector2d InOld(double x, double y, double disparity_px) const;
  const Eigen::Vector2d& shift_px() const { return shift_px_; }
  const ImageF& now() const { return *now_; }
  const ImageF& old() const { return old_; }

 private:
  void FindShift();
  std::vector<Laid> Band(const PictureLine& line) const;
  struct OnOld;
  /// Nothing where one leaves the older picture.
  std::optional<std::vector<OnOld>> Sample(const std::vector<Laid>& band,
                                           const Registered& at) const;
  /// The middle of what they are off by, and how far off it the ground's own are at most.
  static std::pair<double, double> Usual(const std::vector<OnOld>& samples);
  std::optional<Registered> Fit(const std::vector<Laid>& band) const;

  const SceneView& view_;
  const SceneGround& ground_;
  std::shared_ptr<const ImageF> now_;
  const ImageF& old_;
  RigidTransform X_OldW_;
  Eigen::Vector2d shift_px_ = Eigen::Vector2d::Zero();  ///< of the whole picture, whole pixels
};

}  // namespace palace
