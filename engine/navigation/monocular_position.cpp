#include "engine/navigation/monocular_position.h"

#include <cmath>
#include <string>

#include "engine/core/check.h"

namespace palace {
namespace {

constexpr double kMinDenominator = 0.1;

bool AllFinite(const MonocularInput& in) {
  return std::isfinite(in.attitude.roll_rad) && std::isfinite(in.attitude.pitch_rad) &&
         std::isfinite(in.attitude.yaw_rad) && std::isfinite(in.tilt_rad) &&
         std::isfinite(in.focal_x_px) && std::isfinite(in.focal_y_px) && in.pixel.allFinite() &&
         std::isfinite(in.laser_m) && in.p_WS.allFinite();
}

}  // namespace

double FocalFromFieldOfView(double width_px, double fov_rad) {
  PALACE_CHECK(width_px > 0 && fov_rad > 0 && fov_rad < 3.14, width_px, fov_rad);
  return 0.5 * width_px / std::tan(0.5 * fov_rad);
}

Result<MonocularPosition> PositionFromPixel(const MonocularInput& in) {
  if (!AllFinite(in) || in.focal_x_px <= 0 || in.focal_y_px <= 0) {
    return InvalidError(
        "monocular position: an input is not finite or the focal length is not "
        "positive");
  }
  const double sin_pitch = std::sin(in.attitude.pitch_rad);
  const double cos_pitch = std::cos(in.attitude.pitch_rad);
  const double cos_roll = std::cos(in.attitude.roll_rad);
  const double sin_tilt = std::sin(in.tilt_rad);
  const double cos_tilt = std::cos(in.tilt_rad);
  MonocularPosition out;
  out.Z_IC_m = -(sin_pitch * cos_tilt + cos_roll * cos_pitch * sin_tilt) * in.laser_m;  // 3.8
  if (!(out.Z_IC_m > 0)) {
    return InvalidError("monocular position: the laser's spot is not below the camera (Z_IC = " +
                        std::to_string(out.Z_IC_m) + " m)");
  }
  const double x = in.pixel.x() / in.focal_x_px;
  const double y = in.pixel.y() / in.focal_y_px;
  const Eigen::Vector3d D(cos_tilt + y * sin_tilt, x, -sin_tilt + y * cos_tilt);  // 3.10
  const Eigen::Matrix3d sigma = RotationFromEuler(in.attitude);                   // 3.4
  const Eigen::Vector3d F = sigma * D;                                            // 3.11
  if (!(F.z() > kMinDenominator)) {
    return InvalidError("monocular position: the feature's ray is near the horizon (" +
                        std::to_string(F.z()) + ", at least 0.1 is needed)");
  }
  out.Z_CF_m = out.Z_IC_m / F.z();                                         // 3.12
  out.P_CF = Eigen::Vector3d(x * out.Z_CF_m, y * out.Z_CF_m, out.Z_CF_m);  // 3.2
  out.P_IF = out.Z_CF_m * F;
  out.p_WC = in.p_WS - out.P_IF;  // step 7, E8
  return out;
}

Eigen::Vector3d BodyFromCamera(const Eigen::Vector3d& p_WC, const EulerAngles& attitude,
                               const Eigen::Vector3d& camera_in_body_m) {
  return p_WC - RotationFromEuler(attitude) * camera_in_body_m;
}

}  // namespace palace
