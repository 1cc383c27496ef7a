// OrbitCamera: the eye of the 3-D view; turns about a target, with three presets.
#pragma once

#include <optional>

#include <Eigen/Dense>

#include "engine/core/frames.h"

namespace palace {

enum class View3dPreset { kOrbit, kAbove, kBehind, kOblique };

/// World frame W (north, east, down). azimuth 0: the eye lies south of the target and looks north;
/// elevation is the angle of the eye above the horizon as seen from the target.
class OrbitCamera {
 public:
  void SetPreset(View3dPreset preset);
  /// The preset in force; empty once the operator has turned the view by hand.
  std::optional<View3dPreset> preset() const { return preset_; }

  /// Mouse drag in pixels: right turns the eye to the left round the target, up lowers it.
  void Drag(double dx_px, double dy_px);
  /// Mouse drag that moves the target over the ground.
  void Pan(double dx_px, double dy_px, double view_height_px);
  /// Wheel steps; positive comes closer.
  void Zoom(double steps);
  /// Sets what must be in view: the vehicle, the ground point it works over and the radius of
  /// interest there. Target and distance follow; hand zoom and pan stay on top.
  void Frame(const Eigen::Vector3d& p_WVehicle, const Eigen::Vector3d& p_WGround, double radius_m,
             double heading_rad);
  /// Moves towards the preset: ease-out in 0.25 s. At once when `dt_s` is infinite.
  void Advance(double dt_s);

  Eigen::Vector3d eye_W() const;
  /// Of the eye of a picture so many times as wide as high: right, down, forward.
  RigidTransform X_WE(double aspect) const;
  Eigen::Matrix4d ClipFromWorld(double width_px, double height_px) const;
  double field_of_view_rad() const { return 0.66; }

 private:
  double DistanceFor(double aspect) const;

  std::optional<View3dPreset> preset_ = View3dPreset::kOrbit;
  double azimuth_rad_ = 0.62;
  double elevation_rad_ = 0.42;
  double wanted_azimuth_rad_ = 0.62;
  double wanted_elevation_rad_ = 0.42;
  double zoom_ = 1;
  Eigen::Vector3d pan_W_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d top_W_{0, 0, -15};
  Eigen::Vector3d ground_W_ = Eigen::Vector3d::Zero();
  double radius_m_ = 8;
  double heading_rad_ = 0;
};

}  // namespace palace
