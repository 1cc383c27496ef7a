// View3dRenderer: the 3-D view of vehicle, camera frustum, terrain and site (look.md, "3-D view").
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Dense>

#include "engine/core/frames.h"
#include "engine/core/result.h"
#include "engine/model/elevation_map.h"
#include "engine/model/hazard_maps.h"
#include "engine/model/image.h"
#include "engine/model/rig.h"
#include "gui/render/gl.h"
#include "gui/render/orbit_camera.h"
#include "gui/render/picture.h"
#include "gui/render/vehicle_body.h"

namespace palace {

struct View3dSite {
  Eigen::Vector3d p_WS = Eigen::Vector3d::Zero();
  double clear_radius_m = 2.3;
};

/// Positions in W, metres. Null pointers and empty lists are simply not drawn.
struct View3dInput {
  std::shared_ptr<const ElevationMap> elevation;
  std::shared_ptr<const HazardMaps> hazards;
  double safe_distance_max_m = 5;  ///< end of the safe-distance colours

  /// Rectified left picture whose brightness is draped over the terrain, and where it was taken.
  std::shared_ptr<const ImageU8> picture;
  PinholeCamera picture_camera;
  RigidTransform picture_X_WC;

  std::optional<RigidTransform> X_WB;  ///< vehicle
  VehicleBody body = VehicleBody::kHelicopter;
  double rotor_diameter_m = 3.1;       ///< how wide it is drawn
  std::optional<RigidTransform> X_WC;  ///< left camera now
  PinholeCamera camera;                ///< for the frustum; width 0: no frustum

  std::optional<View3dSite> site;
  bool site_commanded = false;  ///< filled centre: commanded; hollow: proposed
  std::vector<View3dSite> other_sites;
  std::vector<Eigen::Vector3f> trail;  ///< flown, oldest first
  std::vector<Eigen::Vector3f> path;   ///< planned, from the vehicle to where it ends
  double ground_height_m = 0;          ///< used until a map is known
  double ui_scale = 1;                 ///< widths of lines and hatch
};

/// A height tick on the drop line; the panel writes the label there.
struct View3dLabel {
  Eigen::Vector2f pixel = Eigen::Vector2f::Zero();  ///< from the picture's top-left corner
  std::string text;                                 ///< "20 m"
};
struct View3dLabels {
  std::vector<View3dLabel> height_ticks;
  std::optional<Eigen::Vector2f> vehicle;  ///< centre of the vehicle
  std::optional<Eigen::Vector2f> site;     ///< centre of the site
};

/// Needs one GL 3.3 core context current for every call and for the destructor. The terrain mesh is
/// rebuilt only when another elevation or hazard map comes in; redraw only when something moved.
class View3dRenderer {
 public:
  static Result<std::unique_ptr<View3dRenderer>> Create();
  ~View3dRenderer();

  /// Draws into texture(), width x height pixels, row 0 on top.
  Result<View3dLabels> Render(const View3dInput& input, const OrbitCamera& camera, int width_px,
                              int height_px);
  GLuint texture() const;
  /// The picture drawn last, for tests and screenshots.
  ImageRgba Read() const;

 private:
  struct Parts;
  explicit View3dRenderer(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace palace
