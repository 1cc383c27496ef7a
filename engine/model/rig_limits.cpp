#include "engine/model/rig_limits.h"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <type_traits>
#include <utility>

#include "engine/core/text.h"

namespace palace {
namespace {

using Limits = RigLimits;

bool IsWithin(double value, double least, double greatest) {
  return value >= least && value <= greatest;  // NaN is not
}

/// Width and height of a model of any family.
std::pair<int, int> SizeOf(const CameraModel& model) {
  return std::visit(
      [](const auto& lens) -> std::pair<int, int> {
        if constexpr (requires { lens.base; }) {
          return {lens.base.width, lens.base.height};
        } else if constexpr (requires { lens.pinhole; }) {
          return {lens.pinhole.width, lens.pinhole.height};
        } else {
          return {lens.width, lens.height};
        }
      },
      model.lens);
}

/// Of the CAHV family: x to the right, y down and A forward, else all that is left of the axis is
/// measured on its right.
bool IsMirrored(const CameraModel& model) {
  return std::visit(
      [](const auto& lens) {
        const auto mirrored = [](const CahvorModel& m) {
          return !(m.A.cross(m.H).cross(m.A.cross(m.V)).dot(m.A) > 0);
        };
        if constexpr (requires { lens.base; }) {
          return mirrored(lens.base);
        } else if constexpr (std::is_same_v<std::decay_t<decltype(lens)>, CahvorModel>) {
          return mirrored(lens);
        } else {
          return false;
        }
      },
      model.lens);
}

std::string WhyNoCamera(const RigCamera& camera) {
  if (std::string why = WhyNoPinhole(camera.pinhole); !why.empty()) {
    return why;
  }
  for (const double k : camera.distortion) {
    if (!IsWithin(k, -Limits::kMostDistortion, Limits::kMostDistortion)) {
      return WithNumbers("a distortion coefficient of %g, outside -100 to 100", k);
    }
  }
  if (!camera.model) {
    return {};
  }
  if (IsMirrored(*camera.model)) {
    return "a mirrored camera model: (A x H) x (A x V) does not point along A";
  }
  const auto [width, height] = SizeOf(*camera.model);
  return WhyNoPictureSize(width, height);
}

std::string WhyNoMount(const StereoRig& rig) {
  if (!IsWithin(rig.tilt_rad, -std::numbers::pi / 2 - 1e-9, 1e-9)) {
    return WithNumbers("a tilt of %.1f deg, outside -90 to 0 deg",
                       rig.tilt_rad * 180 / std::numbers::pi);
  }
  if (!(rig.position_body_m.cwiseAbs().maxCoeff() <= Limits::kMostPosition_m)) {
    return "a camera more than 100 m from the reference point";
  }
  return IsWithin(rig.rate_hz, Limits::kLeastRate_hz, Limits::kMostRate_hz)
             ? ""
             : WithNumbers("a rate of %g Hz, outside 0.001 to 1000 Hz", rig.rate_hz);
}

std::string WhyNoWindow(const StereoRig& rig) {
  if (rig.min_disparity_px < 0 || rig.min_disparity_px >= rig.left.pinhole.width) {
    return WithNumbers("disparities from %.0f px, outside its pictures", rig.min_disparity_px);
  }
  const int count = rig.num_disparities;
  return count >= 0 && count <= Limits::kMostDisparities && count % 16 == 0
             ? ""
             : WithNumbers("%.0f disparities; a multiple of 16 up to 1024, or 0", count);
}

}  // namespace

std::string WhyNoPictureSize(int width, int height) {
  if (IsWithin(width, Limits::kLeastSide_px, Limits::kMostSide_px) &&
      IsWithin(height, Limits::kLeastSide_px, Limits::kMostSide_px) &&
      std::int64_t{width} * height <= Limits::kMostPixels) {
    return {};
  }
  return WithNumbers(
      "pictures of %.0f x %.0f px; sides of 32 to 8192 px and at most 33.5 megapixels are taken",
      width, height);
}

std::string WhyNoPinhole(const PinholeCamera& camera) {
  if (std::string why = WhyNoPictureSize(camera.width, camera.height); !why.empty()) {
    return why;
  }
  for (const double focal_px : {camera.fx_px, camera.fy_px}) {
    if (!IsWithin(focal_px, Limits::kLeastFocal_px, Limits::kMostFocal_px)) {
      return WithNumbers("a focal length of %g px, outside 0.001 to 1000000 px", focal_px);
    }
  }
  for (const double centre_px : {camera.cx_px, camera.cy_px}) {
    if (!IsWithin(centre_px, -Limits::kMostCentre_px, Limits::kMostCentre_px)) {
      return WithNumbers("a principal point at %g px, more than 1000000 px away", centre_px);
    }
  }
  return {};
}

std::string WhyNoBaseline(double baseline_m) {
  return IsWithin(baseline_m, Limits::kLeastBaseline_m, Limits::kMostBaseline_m)
             ? ""
             : WithNumbers("a baseline of %g m, outside 0.001 to 1000 m", baseline_m);
}

std::string WhyNoRig(const StereoRig& rig) {
  for (const std::string& why :
       {WhyNoCamera(rig.left), WhyNoCamera(rig.right), WhyNoBaseline(rig.baseline_m),
        WhyNoMount(rig), WhyNoWindow(rig)}) {
    if (!why.empty()) {
      return "the rig has " + why;
    }
  }
  return {};
}

}  // namespace palace
