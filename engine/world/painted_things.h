// Wires and bare areas painted into rendered pictures by formula: thinner than rays resolve, and of
// any grey. One picture of the ground serves many of them.
#pragma once

#include <vector>

#include <Eigen/Dense>

#include "engine/core/frames.h"
#include "engine/model/image.h"
#include "engine/model/rig.h"

namespace palace {

/// A straight round wire between two points of W, of even grey. Each pixel takes the share of it
/// that the wire covers across its direction, spread by the pixel and the lens (a Gaussian of
/// variance 1/12 + kLensBlur_px^2). On the ground it is a painted line. In front of all else.
struct PaintedWire {
  Eigen::Vector3d from_W = Eigen::Vector3d::Zero();
  Eigen::Vector3d to_W = Eigen::Vector3d::Zero();
  double diameter_m = 0.02;
  double grey = 40;
};
void PaintWire(const PaintedWire& wire, const PinholeCamera& camera, const RigidTransform& X_WC,
               ImageF& grey);

/// A disc of even grey on level ground at height 0: still water under an even sky.
struct PaintedPool {
  double north_m = 0;
  double east_m = 0;
  double radius_m = 1;
  double grey = 90;
};
void PaintPool(const PaintedPool& pool, const PinholeCamera& camera, const RigidTransform& X_WC,
               ImageF& grey);

/// Wires, then pools.
void PaintThings(const std::vector<PaintedWire>& wires, const std::vector<PaintedPool>& pools,
                 const PinholeCamera& camera, const RigidTransform& X_WC, ImageF& grey);

}  // namespace palace
