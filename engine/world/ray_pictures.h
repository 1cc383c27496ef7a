// Pictures and stereo pairs of a world with exact depths, ray cast.
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
#include "engine/world/baked_ground.h"
#include "engine/world/world.h"

namespace palace {

/// Grey that falls on each pixel: samples x samples rays a pixel, weighted by the pixel's square
/// spread by the lens. Sky is 200.
ImageF RenderGrey(const World& world, const PinholeCamera& camera, const RigidTransform& X_WC,
                  int samples);
/// The same, quickly: ground is looked up in what was baked for pictures like this one, and only
/// pixels that a solid touches are cast. Ground there is spread by the lens twice, for a pixel or
/// two along the solid's edge. Solids and ground beyond the bake are exact. Pictures whose ground
/// sample distance leaves that of the bake by more than 25 % are made by RenderGrey.
ImageF DrawGrey(const World& world, const PinholeCamera& camera, const RigidTransform& X_WC,
                const BakedGround& ground);
/// Ground for DrawGrey of all these cameras' pictures; finest where they differ.
BakedGround BakeFor(const World& world, const PinholeCamera& camera,
                    const std::vector<RigidTransform>& X_WCs);

/// Through the pixels' centres.
ImageF RenderDepth(const World& world, const PinholeCamera& camera, const RigidTransform& X_WC);

/// The same of a camera with any lens, along its own optical axis; NaN where a pixel has no ray or
/// one at right angles to the axis or more.
ImageF RenderDepth(const World& world, const RigCamera& camera, const RigidTransform& X_WC);

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
StereoView ViewFrom(const World& world, const PinholeCamera& camera, double height_m,
                    double tilt_rad, int samples = 4);

}  // namespace palace
