// CAHV and CAHVOR camera models of the Jet Propulsion Laboratory.
//
//   CAHV     x = (P-C).H / (P-C).A,   y = (P-C).V / (P-C).A
//   CAHVOR   zeta = (P-C).O,  lambda = (P-C) - zeta O,  tau = |lambda|^2 / zeta^2,
//            mu = R0 + R1 tau + R2 tau^2,  P' = P + mu lambda, then CAHV with P'
//
// All vectors in the frame the model was written in (F), metres and pixels; A and O are unit.
// Pixel (0,0) is the centre of the top-left pixel. Points behind the camera, values that are not
// finite and rays beyond the range of the distortion give nothing, never a clamped value.
// Source: Yakimovsky & Cunningham 1978 (CAHV); Gennery 2006 (CAHVOR). Thesis equations 4.2-4.3
// print the CAHV part only (erratum E16).
#pragma once

#include <optional>

#include <Eigen/Dense>

#include "engine/camera/camera_ray.h"
#include "engine/model/camera_models.h"

namespace palace {

/// Scales and centres hidden in H and V: hc = A.H, hs = |A x H|, and the same for V.
struct CahvInternals {
  double hs_px = 0;
  double hc_px = 0;
  double vs_px = 0;
  double vc_px = 0;
  double theta_rad = 0;  ///< angle from V' to H' about A; -pi/2 for perpendicular rows and columns
};

/// The exact pinhole inside a CAHV model: K R_CF = [H; V; A]. K(1,0) is the row shear of a model
/// whose rows and columns are not perpendicular; a PinholeCamera cannot hold it.
struct CahvPinhole {
  PinholeCamera camera;
  double shear_px = 0;                                 ///< K(1,0)
  Eigen::Matrix3d R_CF = Eigen::Matrix3d::Identity();  ///< camera axes from the model's frame
  Eigen::Vector3d p_FC = Eigen::Vector3d::Zero();      ///< projection centre
};

/// True when O = A and R = 0: the model is linear.
bool IsLinear(const CahvorModel& model);
/// Pixel of the point p_FQ.
std::optional<Eigen::Vector2d> ProjectCahvor(const CahvorModel& model, const Eigen::Vector3d& p_FQ);
/// The same with its derivative by p_FQ.
std::optional<ProjectionJacobian> JacobianOfCahvor(const CahvorModel& model,
                                                   const Eigen::Vector3d& p_FQ);
/// Ray through the pixel. Newton's method on the polynomial of the distortion.
std::optional<CameraRay> RayFromPixelCahvor(const CahvorModel& model, const Eigen::Vector2d& pixel);
/// The ray of the linear part with unit advance along A: (V - yA) x (H - xA) / (A . V x H). Not
/// finite when H, V and A do not span space.
Eigen::Vector3d LinearRayCahv(const CahvorModel& model, const Eigen::Vector2d& pixel);
CahvInternals InternalsOf(const CahvorModel& model);
/// The linear (CAHV) part; O and R are ignored.
CahvPinhole PinholeFromCahv(const CahvorModel& model);
/// The CAHV model of an undistorted pinhole with rotation R_CF and centre p_FC.
CahvorModel CahvFromPinhole(const PinholeCamera& camera, const Eigen::Matrix3d& R_CF,
                            const Eigen::Vector3d& p_FC);

/// The model of the picture resampled so that x_new = scale_x x, y_new = scale_y y. Pixel centres
/// count: halving a picture by averaging 2 x 2 pixels also shifts it by a quarter pixel of the new
/// size (ShiftCahvor by 0.25). Width and height are scaled and rounded.
/// Source: JPL cmod_cahv_scale.
CahvorModel ScaleCahvor(CahvorModel model, double scale_x, double scale_y);
/// The model of the picture whose pixel (0,0) is the old (dx, dy), e.g. a cut-out. The size stays.
/// Source: JPL cmod_cahv_shift.
CahvorModel ShiftCahvor(CahvorModel model, double dx_px, double dy_px);

}  // namespace palace
