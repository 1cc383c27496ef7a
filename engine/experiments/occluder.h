// What comes between the camera and the point for a while, painted into a picture before its noise.
//
//   bird    a dark ellipse of 45 to 75 px that crosses the picture in 1 s, over the point half-way
//   hand    1 s: a smooth palm that hides a third and more of the picture, the point in its middle,
//           and three fingers with edges; it comes in and leaves within four pictures and trembles
//   shadow  1.5 s: a band 300 px wide passes over; grey is halved, over a soft edge of 30 px
//   black   0.5 s of dark pictures: a covered lens, a camera that lost its exposure
//
// Where, which way and how large comes from the seed.
#pragma once

#include <array>
#include <cstdint>

#include <Eigen/Dense>

#include "engine/core/random.h"
#include "engine/model/image.h"

namespace palace {

enum class OccluderKind { kNone, kBird, kHand, kShadow, kBlack };
inline constexpr std::array kAllOccluders = {OccluderKind::kNone, OccluderKind::kBird,
                                             OccluderKind::kHand, OccluderKind::kShadow,
                                             OccluderKind::kBlack};
/// "none", "bird", ...
const char* NameOf(OccluderKind kind);
/// Pictures that it lasts, at 30 a second. None: as long as a bird, so that both count alike.
int PicturesOf(OccluderKind kind);

class Occluder {
 public:
  Occluder(OccluderKind kind, std::uint64_t seed);
  int pictures() const { return PicturesOf(kind_); }
  /// Picture 0 to pictures() - 1 of it; the point lies at `pixel` in that picture.
  void Paint(int picture, const Eigen::Vector2d& pixel, ImageF& grey) const;

 private:
  void PaintBird(int picture, const Eigen::Vector2d& pixel, ImageF& grey) const;
  void PaintHand(int picture, const Eigen::Vector2d& pixel, ImageF& grey) const;
  void PaintShadow(int picture, const Eigen::Vector2d& pixel, ImageF& grey) const;

  OccluderKind kind_;
  Eigen::Vector2d way_ = Eigen::Vector2d::UnitX();  ///< unit, in the picture
  double size_ = 0;                                 ///< 0 to 1, of what the kind may be
  double phase_rad_ = 0;
};

}  // namespace palace
