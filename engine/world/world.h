// World: the one description of what is simulated. The renderers draw it, laser and skids meet it,
// experiments and tests know its truth.
//
// Heights are above the origin of W, up-positive. Ray-cast pictures (ray_pictures.h) and the GL
// renderer read the same ground, solids and sun; what only one of them shows is said at the field.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Dense>

#include "engine/world/ground_texture.h"
#include "engine/world/height_field.h"
#include "engine/world/material.h"
#include "engine/world/painted_things.h"
#include "engine/world/solids.h"

namespace palace {

/// A plane through the origin of W, with the relief on it where there is one.
struct Ground {
  double rise_north = 0;  ///< metres up per metre north
  double rise_east = 0;
  GroundTexture texture = GroundTexture::kCloud;  ///< in ray-cast pictures; GL has its own
  std::uint64_t texture_seed = 7;
  double contrast = 1;           ///< of a ray-cast texture about mid grey; 0: none
  bool runway_markings = false;  ///< GL only
  /// Rocks that grew in, holes, ditches, dunes: heights added to the plane's. Null: none.
  std::shared_ptr<const HeightField> relief{};
  /// What the ground is made of, and what lies on it. With it both renderers show the ground by
  /// its lit picture (ground_picture.h); without, as `texture` says.
  std::optional<Material> material{};
  std::vector<GroundPatch> patches{};  ///< read with a material only

  double Height(double north_m, double east_m) const;
  /// Unit normal of the plane in W, pointing up.
  Eigen::Vector3d Normal() const;
  /// The same of the ground at a place, relief and all.
  Eigen::Vector3d NormalAt(double north_m, double east_m) const;
  /// What lies on top there; only with a material.
  const Material& MaterialAt(double north_m, double east_m) const;
};

/// Where light comes from; RenderGrey and DrawGrey show no shadows.
struct Sun {
  double azimuth_rad = 2.4;
  double elevation_rad = 0.9;
  double direct = 0.7;   ///< on a surface square to it, of what makes grey 255 of albedo 1
  double diffuse = 0.5;  ///< from the sky, on every surface

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
/// The same for the ground alone. `clear`: the ray is known to be over it up to there.
Hit CastGround(const Ground& ground, const Eigen::Vector3d& p_W, const Eigen::Vector3d& r_W,
               double clear = 0);
/// A number s >= 0 up to which all rays p + s r with r a mean of the beam's edges are over ground.
double ClearOfGround(const Ground& ground, const Beam& beam_W);

/// Height of whatever is on top at that place.
double SurfaceHeight(const World& world, double north_m, double east_m);
/// Horizontal distance from the place to the nearest solid; 0 on one, infinity without solids.
double ObstacleDistance(const World& world, double north_m, double east_m);

}  // namespace palace
