// RayScene: pictures, depths and single rays of a world with material ground, by ray casting.
//
// Exact in geometry: the relief's own triangles and those of every solid (world_mesh.h), which the
// GL renderer draws too. Ground light comes from the world's GroundPicture; solids are lit by
// Lambert with their shadows. Rays see no lens: a pixel is the mean of its samples over its square.
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include <Eigen/Dense>

#include "engine/core/frames.h"
#include "engine/model/image.h"
#include "engine/model/rig.h"
#include "engine/world/ground_picture.h"
#include "engine/world/surface_grain.h"
#include "engine/world/world.h"
#include "engine/world/world_mesh.h"

namespace palace {

class RayScene {
 public:
  /// The ground's light has texels of that size: about the finest ground sample distance of the
  /// pictures to come. The world's ground has a material.
  RayScene(const World& world, double texel_m);
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  /// Grey 0..255, samples x samples rays a pixel; sky is 200. Rows at once on several threads.
  ImageF Grey(const PinholeCamera& camera, const RigidTransform& X_WC, int samples,
              double time_s = 0) const;
  /// Distance along the optical axis through the pixels' centres, metres; infinity: sky.
  ImageF Depth(const PinholeCamera& camera, const RigidTransform& X_WC, double time_s = 0) const;

  struct Meeting {
    double s = std::numeric_limits<double>::infinity();
    bool ground = false;
    int mover = -1;              ///< index of the moving solid, -1: it stands still
    std::uint32_t triangle = 0;  ///< of the solids, unless ground
  };
  /// What the ray p + s r meets first, s >= 0; infinity: sky.
  Meeting Cast(const Eigen::Vector3d& p_W, const Eigen::Vector3d& r_W, double time_s = 0) const;

  const World& world() const { return world_; }
  const GroundPicture& ground() const { return *ground_; }
  const SurfaceGrain& grain() const { return grain_; }

 private:
  /// Triangles with what their corners carry.
  struct Surfaces {
    std::vector<MeshVertex> corners;  ///< three a triangle
    std::unique_ptr<TriangleMesh> mesh;
    Eigen::Vector3d v_W = Eigen::Vector3d::Zero();
  };
  static Surfaces SurfacesOf(const World& world);
  const Surfaces& SurfacesOf(int mover) const {
    return mover < 0 ? still_ : movers_[static_cast<std::size_t>(mover)];
  }
  /// What rays of a few neighbouring pixels may meet.
  struct Bundle {
    double clear_of_ground = 0;               ///< s up to which all are over the ground
    std::vector<BoxTree::Branches> solids{};  ///< of what stands still, then of each mover
  };
  Bundle BundleOf(const Beam& beam_W, double time_s) const;
  /// Calls visit(x, y, bundle) for every pixel, on several threads.
  template <typename Visit>
  void OverPixels(const PinholeCamera& camera, const RigidTransform& X_WC, double time_s,
                  Visit&& visit) const;
  /// `clear_of_ground` as in Bundle; `branches_of(mover)`: where to look for what the ray meets of
  /// it, -1: of what stands still.
  template <typename BranchesOf>
  Meeting CastAmong(const Eigen::Vector3d& p_W, const Eigen::Vector3d& r_W, double time_s,
                    double clear_of_ground, BranchesOf&& branches_of) const;
  Meeting Cast(const Bundle& bundle, const Eigen::Vector3d& p_W, const Eigen::Vector3d& r_W,
               double time_s) const;
  /// Whether the sun reaches a place just above a surface; past what stands still, past all.
  bool StillSees(const Eigen::Vector3d& p_W) const;
  bool Sees(const Eigen::Vector3d& p_W, double time_s, bool movers_only) const;
  double GreyAt(const Eigen::Vector3d& p_W, const Eigen::Vector3d& r_W, const Meeting& meeting,
                double time_s) const;

  World world_;
  Eigen::Vector3d sun_W_;
  SurfaceGrain grain_;
  Surfaces still_;
  std::vector<Surfaces> movers_;
  std::unique_ptr<GroundPicture> ground_;
};

}  // namespace palace
