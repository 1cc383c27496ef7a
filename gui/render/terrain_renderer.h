// TerrainRenderer: the elevation map as a surface, coloured by the verdict and the picture.
#pragma once

#include <memory>
#include <optional>

#include <Eigen/Dense>

#include "engine/core/frames.h"
#include "engine/core/result.h"
#include "engine/model/elevation_map.h"
#include "engine/model/hazard_maps.h"
#include "engine/model/image.h"
#include "engine/model/rig.h"
#include "gui/render/gl_handle.h"
#include "gui/render/shader.h"
#include "gui/render/texture.h"

namespace palace {

/// A surface where four neighbouring cells are known and differ by at most 0.75 m; points where a
/// cell stands more than 0.75 m above the ground; hatch on the ground of the map box elsewhere.
class TerrainRenderer {
 public:
  Status Start();
  /// Rebuilds the mesh when another map comes in. `hazards` may be null: plain grey surface.
  void Update(std::shared_ptr<const ElevationMap> elevation,
              std::shared_ptr<const HazardMaps> hazards, double safe_distance_max_m);
  /// Brightness for the surface; null: none.
  void Drape(std::shared_ptr<const ImageU8> picture, const PinholeCamera& camera,
             const RigidTransform& X_WC);
  void Draw(const Eigen::Matrix4d& clip_from_world, double ui_scale) const;

  /// Median height of the known cells, metres up-positive; empty without a map.
  std::optional<double> ground_height_m() const { return ground_height_m_; }

 private:
  void BuildMesh(const ElevationMap& elevation);
  void BuildCells(const ElevationMap& elevation, const HazardMaps* hazards,
                  double safe_distance_max_m);

  ShaderProgram shader_;
  GlVertexArray array_;
  GlBuffer vertices_;
  GlBuffer indices_;
  GLsizei index_count_ = 0;
  GLsizei point_first_ = 0;
  GLsizei point_count_ = 0;
  GlVertexArray box_array_;
  GlBuffer box_vertices_;
  Texture cells_;  ///< rgb verdict colour, alpha 1 safe, 0.5 over a limit, 0 no verdict
  Texture picture_;
  std::shared_ptr<const ElevationMap> elevation_;
  std::shared_ptr<const HazardMaps> hazards_;
  double safe_distance_max_m_ = 0;
  std::shared_ptr<const ImageU8> draped_;
  Eigen::Matrix4d picture_from_world_ = Eigen::Matrix4d::Zero();
  std::optional<double> ground_height_m_;
};

}  // namespace palace
