// Camera models as data: one struct a lens family, and CameraModel, which is any of them.
//
// Projection, rays, Jacobians and limits are functions of engine/camera (camera_model.h). All
// families share the pixel convention (x right, y down, (0,0) = centre of the top-left pixel) and
// carry their pose: the model's frame F is the one its file was written in. Sizes are 0 where a
// file does not tell them.
#pragma once

#include <array>
#include <variant>

#include <Eigen/Dense>

namespace palace {

/// Undistorted pinhole. x_px = fx X/Z + cx, y_px = fy Y/Z + cy, camera axes right-down-forward.
struct PinholeCamera {
  int width = 0;
  int height = 0;
  double fx_px = 0;
  double fy_px = 0;
  double cx_px = 0;  ///< principal point; (width-1)/2 for a centred one
  double cy_px = 0;
  friend bool operator==(const PinholeCamera&, const PinholeCamera&) = default;
};

/// JPL CAHVOR model (Yakimovsky & Cunningham 1978; Gennery 2006). O = A and R = 0 make it CAHV.
/// Vectors in the frame of the rig: the left camera's own axes unless a file says otherwise.
struct CahvorModel {
  int width = 0;
  int height = 0;
  Eigen::Vector3d C = Eigen::Vector3d::Zero();
  Eigen::Vector3d A = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d H = Eigen::Vector3d::UnitX();
  Eigen::Vector3d V = Eigen::Vector3d::UnitY();
  Eigen::Vector3d O = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d R = Eigen::Vector3d::Zero();
};

/// JPL CAHVORE model (Gennery 2006): wide lenses whose entrance pupil moves along O.
struct CahvoreModel {
  CahvorModel base;                             ///< size, C, A, H, V, O, R
  Eigen::Vector3d E = Eigen::Vector3d::Zero();  ///< pupil terms, unit of C
  /// 1 perspective (type 1), 0 fisheye (type 2), any other value general (type 3).
  double linearity = 0;
};

/// Tsai's model in Willson's conventions (Tsai 1987; Willson's Tsai 3.0b3). f, sensor sizes and T
/// share one unit, millimetres in his files.
struct TsaiModel {
  int width = 0;
  int height = 0;
  double sensor_columns = 0;  ///< Ncx, sensor elements along x
  double frame_columns = 0;   ///< Nfx, pixels a frame-grabber line
  double dx = 0;              ///< sensor element pitch along x
  double dy = 0;
  double dpx = 0;  ///< effective pixel pitch along x in the frame buffer
  double dpy = 0;
  double Cx_px = 0;
  double Cy_px = 0;
  double sx = 1;  ///< horizontal scale uncertainty (a scale, not a skew: erratum E13)
  double f = 0;
  double kappa1 = 0;                            ///< 1 / length^2
  Eigen::Vector3d T = Eigen::Vector3d::Zero();  ///< p_C = R p_F + T
  double Rx_rad = 0;                            ///< R = Rz Ry Rx
  double Ry_rad = 0;
  double Rz_rad = 0;
};

/// The distortion of an OpenCV camera.
enum class OpenCvLens {
  kPolynomial,  ///< k1 k2 p1 p2 [k3 [k4 k5 k6 [s1 s2 s3 s4 [tau_x tau_y]]]]
  kFisheye,     ///< k1 k2 k3 k4 of the equidistant model
};

/// OpenCV's cameras, as calibrateCamera and fisheye::calibrate write them.
struct OpenCvModel {
  PinholeCamera pinhole;
  OpenCvLens lens = OpenCvLens::kPolynomial;
  int coefficients = 0;        ///< how many of k count: 0 4 5 8 12 14, or 4 for kFisheye
  std::array<double, 14> k{};  ///< in OpenCV's order; those beyond `coefficients` are 0
  Eigen::Matrix3d R_CF = Eigen::Matrix3d::Identity();  ///< p_C = R_CF p_F + t_CF
  Eigen::Vector3d t_CF = Eigen::Vector3d::Zero();
};

/// A camera of any family.
struct CameraModel {
  std::variant<CahvorModel, CahvoreModel, TsaiModel, OpenCvModel> lens;
  double unit_m = 1;          ///< metres per unit of length of the model; 0.001 for Willson's files
  bool pose_is_known = true;  ///< false: F is the camera's own frame (intrinsics alone)
};

}  // namespace palace
