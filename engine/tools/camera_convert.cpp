// palacectl camera convert.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <variant>

#include "engine/camera/conversion.h"
#include "engine/tools/camera_verbs.h"

namespace palace {
namespace {

constexpr double kFineForStereo_px = 0.05;

/// What --to names: a family, and the container of the file.
struct ConversionGoal {
  LensFamily family = LensFamily::kCahvor;
  CameraFormat format = CameraFormat::kJplText;
};

/// The OpenCV family that keeps what the model has: 14 coefficients lose the tilt of the sensor.
std::string OpenCvNameFor(const CameraModel& model) {
  const auto* opencv = std::get_if<OpenCvModel>(&model.lens);
  if (opencv == nullptr) {
    return "opencv5";
  }
  return opencv->lens == OpenCvLens::kFisheye ? "fisheye"
         : opencv->coefficients == 0
             ? "pinhole"
             : "opencv" + std::to_string(std::min(opencv->coefficients, 12));
}

Result<ConversionGoal> GoalOf(const CameraOptions& options, const CameraModel& source) {
  std::string name = options.to;
  std::string extension = std::filesystem::path(options.out).extension().string();
  if (name.empty()) {
    const bool opencv = extension == ".yml" || extension == ".yaml" || extension == ".xml";
    name = opencv ? OpenCvNameFor(source) : extension.size() > 1 ? extension.substr(1) : "";
  }
  ConversionGoal goal;
  const bool ros = name.substr(0, 3) == "ros";
  name = name == "cpcc" ? "tsai" : name == "opencv" || name == "ros" ? "opencv5" : name;
  name = name == "ros8" ? "opencv8" : name == "ros_fisheye" ? "fisheye" : name;
  const auto family = LensFamilyFromName(name);
  if (!family) {
    return UsageError("--to " + (options.to.empty() ? "(from the name of --out)" : options.to) +
                      ": choose cahv, cahvor, cahvore, tsai, pinhole, opencv4, opencv5, opencv8, "
                      "opencv12, fisheye, ros, ros8 or ros_fisheye");
  }
  goal.family = *family;
  if (goal.family == LensFamily::kTsai) {
    goal.format = CameraFormat::kWillson;
  } else if (goal.family > LensFamily::kTsai) {
    goal.format = ros                   ? CameraFormat::kRosYaml
                  : extension == ".xml" ? CameraFormat::kOpenCvXml
                                        : CameraFormat::kOpenCvYaml;
  }
  return goal;
}

void PrintResidual(const ConvertedCamera& converted, LensFamily family, const CameraModel& source) {
  const Residual& r = converted.residual;
  std::printf("residual  rms %.6g px, max %.6g px at pixel (%.1f, %.1f), over %d pixels\n",
              r.rms_px, r.max_px, r.worst_pixel.x(), r.worst_pixel.y(), r.pixels);
  if (family == LensFamily::kCahv && r.max_px > 1e-6) {
    std::printf(
        "field     kept by JPL's rule, not fitted: every new pixel has a source in the old "
        "picture\n"
        "          a CAHV camera has no distortion: pictures must be resampled, the residual "
        "is how far pixels move\n");
  }
  if (family != LensFamily::kCahv && r.rms_px > kFineForStereo_px) {
    std::printf(
        "warning   over %.2f px rms the new file is no substitute for the old one in stereo: the "
        "lens does not fit this family\n",
        kFineForStereo_px);
  }
  if (r.without_ray > 0) {
    std::printf("warning   %d pixels of the grid have no ray in the source model; left out\n",
                r.without_ray);
  }
  if (r.unseen > 0) {
    std::printf("warning   %d rays are beyond the range of the new model; left out\n", r.unseen);
  }
  if (std::abs(converted.lost_shear_px) > 1e-9) {
    std::printf(
        "lost      row shear of %.6g px: the new family has perpendicular rows and columns\n",
        converted.lost_shear_px);
  }
  if (converted.lost_pupil_m > 0) {
    std::printf(
        "lost      motion of the entrance pupil, up to %.3g m: the residual holds for far "
        "points\n",
        converted.lost_pupil_m);
  }
  if (source.unit_m != 1 || family == LensFamily::kTsai) {
    std::printf("lengths   %s in the source, %s in the new file\n", source.unit_m == 1 ? "m" : "mm",
                family == LensFamily::kTsai ? "mm" : "m");
  }
}

}  // namespace

int RunCameraConvert(const CameraOptions& options) {
  if (const Status apart = CheckNoInput(options.out, {options.model}); !apart) {
    return FailCamera(apart.error());
  }
  const auto model = ReadCameraModel(options.model, options);
  if (!model) {
    return FailCamera(model.error());
  }
  const auto goal = GoalOf(options, *model);
  if (!goal) {
    return FailCamera(goal.error());
  }
  const auto converted = ConvertCamera(*model, goal->family);
  if (!converted) {
    return FailCamera({converted.error().code, options.model + ": " + converted.error().message});
  }
  const auto text = CameraToText(converted->model, goal->format);
  if (!text) {
    return FailCamera(text.error());
  }
  if (const Status written = WriteCameraModel(options.out, *text); !written) {
    return FailCamera(written.error());
  }
  std::printf("from      %s: %s\nto        %s: %s, %s\n", options.model.c_str(),
              FamilyOf(*model).c_str(), options.out.c_str(), FamilyOf(converted->model).c_str(),
              CameraFormatName(goal->format));
  PrintResidual(*converted, goal->family, *model);
  return 0;
}

}  // namespace palace
