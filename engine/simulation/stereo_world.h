// Stereo pairs with exact depths: a small world of convex solids on textured ground, ray cast.
//
// Depth is the distance along the optical axis. No GL: pictures depend on nothing but the numbers
// given, so accuracy is measured against them to any digit.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Dense>

#include "engine/core/frames.h"
#include "engine/model/image.h"
#include "engine/model/rig.h"
#include "engine/simulation/ground_texture.h"

namespace palace {

/// Points p of W with normal . p <= offset.
struct HalfSpace {
  Eigen::Vector3d normal;
  double offset = 0;
};

/// Convex: the points inside all faces.
struct Solid {
  std::vector<HalfSpace> faces;
};

/// On level ground at height 0, sides along north and east; metres.
Solid MakeBox(double north_m, double east_m, double size_north_m, double size_east_m,
              double height_m);
/// A ramp that rises to the north by `slope_rad` over `length_m`, centred at (north, east).
Solid MakeWedge(double north_m, double east_m, double length_m, double width_m, double slope_rad);

struct StereoWorld {
  GroundTexture texture = GroundTexture::kCloud;
  std::uint64_t texture_seed = 7;
  double contrast = 1;     ///< of the texture about mid grey; 0: none
  double slope_north = 0;  ///< rise of the ground per metre north
  std::vector<Solid> solids{};
};

/// Depth of the nearest surface along p + s r, for a ray r of W with unit depth; infinity for sky.
double CastDepth(const StereoWorld& world, const Eigen::Vector3d& p_W, const Eigen::Vector3d& r_W);

/// The lens spreads a point over a Gaussian of this standard deviation; with the pixel's own square
/// the contrast at half a cycle a pixel is 0.35, as good lenses have it.
inline constexpr double kLensBlur_px = 0.35;

/// Grey that falls on each pixel: samples x samples rays a pixel, weighted by the pixel's square
/// spread by the lens. Sky is 200.
ImageF RenderGrey(const StereoWorld& world, const PinholeCamera& camera, const RigidTransform& X_WC,
                  int samples);
/// Through the pixels' centres.
ImageF RenderDepth(const StereoWorld& world, const PinholeCamera& camera,
                   const RigidTransform& X_WC);

/// What a sensor makes of it: gain * grey + offset, normal noise, whole levels 0..255.
struct Exposure {
  double noise_grey = 2;
  double gain = 1;
  double offset = 0;
};
ImageU8 Expose(const ImageF& grey, const Exposure& exposure, std::uint64_t seed);

/// Both cameras' grey and the left one's depths. The right camera stands baseline_m along the left
/// one's x axis.
struct StereoView {
  PinholeCamera camera;
  RigidTransform X_WC;
  double baseline_m = 1;
  ImageF left_grey;
  ImageF right_grey;
  ImageF depth_m;
};

/// Camera `height_m` over the origin of W, tilted (negative down, -pi/2 nadir), heading north.
StereoView ViewFrom(const StereoWorld& world, const PinholeCamera& camera, double height_m,
                    double tilt_rad, int samples = 4);

}  // namespace palace
