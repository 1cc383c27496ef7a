// World: the one description of what is simulated. The renderers draw it, laser and skids meet it,
// experiments and tests know its truth.
//
// Heights are above the origin of W, up-positive. Ray-cast pictures (ray_pictures.h) and the GL
// renderer read the same ground, solids and sun; what only one of them shows is said at the field.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Dense>

#include "engine/world/ground_texture.h"
#include "engine/world/painted_things.h"
#include "engine/world/solids.h"

namespace palace {

/// A plane through the origin of W.
struct Ground {
  double rise_north = 0;  ///< metres up per metre north
  double rise_east = 0;
  GroundTexture texture = GroundTexture::kCloud;  ///< in ray-cast pictures; GL has its own
  std::uint64_t texture_seed = 7;
  double contrast = 1;           ///< of a ray-cast texture about mid grey; 0: none
  bool runway_markings = false;  ///< GL only

  double Height(double north_m, double east_m) const;
  /// Unit normal in W, pointing up.
  Eigen::Vector3d Normal() const;
};

/// Where light comes from; ray-cast pictures are shadowless.
struct Sun {
  double azimuth_rad = 2.4;
  double elevation_rad = 0.9;

  /// Unit vector to the sun in W.
  Eigen::Vector3d Direction() const;
};

struct World {
  std::string name{};
  Ground ground{};
  Sun sun{};
  std::vector<Solid> solids{};
  std::vector<PaintedWire> wires{};  ///< too thin for rays: in ray-cast pictures only
  std::vector<PaintedPool> pools{};  ///< the same
};

/// Solids where their motion has brought them.
World WorldAt(const World& world, double time_s);
/// The shape with its foot on the ground at a place, turned from north towards east.
Solid StandingOn(const Ground& ground, Shape shape, double north_m, double east_m,
                 double yaw_rad = 0);

struct Hit {
  double s = std::numeric_limits<double>::infinity();  ///< along the ray; infinity: sky
  const Solid* solid = nullptr;                        ///< null: ground or sky
};
/// What the ray p + s r meets first, s >= 0: with a unit direction s is the range, with unit depth
/// along a camera's axis the depth. From below the ground it meets solids only.
Hit CastRay(const World& world, const Eigen::Vector3d& p_W, const Eigen::Vector3d& r_W);
/// The same for the ground alone.
Hit CastGround(const Ground& ground, const Eigen::Vector3d& p_W, const Eigen::Vector3d& r_W);

/// Height of whatever is on top at that place.
double SurfaceHeight(const World& world, double north_m, double east_m);
/// Horizontal distance from the place to the nearest solid; 0 on one, infinity without solids.
double ObstacleDistance(const World& world, double north_m, double east_m);

}  // namespace palace
