// mrcal's .cameramodel: Python-dict text with lensmodel, intrinsics, extrinsics and imagersize.
#include <cmath>

#include "engine/camera/cahvor.h"
#include "engine/camera/files/camera_file_formats.h"
#include "engine/core/rotation_vector.h"

namespace palace {
namespace {

/// fx, fy, cx, cy lead every list of intrinsics.
Result<std::vector<double>> ReadIntrinsics(const KeyedText& text, std::size_t count) {
  auto values = text.Numbers("intrinsics", count, count);
  if (values && (!((*values)[0] > 0) || !((*values)[1] > 0))) {
    return text.Wrong("intrinsics", "the focal lengths, its first two numbers, must be positive");
  }
  return values;
}

PinholeCamera PinholeFrom(const std::vector<double>& values) {
  return {0, 0, values[0], values[1], values[2], values[3]};
}

/// The optical axis in camera axes: two angles beside the picture's normal.
Eigen::Vector3d AxisFrom(double alpha, double beta) {
  return {std::sin(alpha) * std::cos(beta), std::sin(beta), std::cos(alpha) * std::cos(beta)};
}

/// "LENSMODEL_CAHVORE_linearity=0.34"
Result<double> LinearityFrom(const KeyedText& text, const std::string& lens) {
  const std::string mark = "LENSMODEL_CAHVORE_linearity=";
  KeyedText part(text.file());
  part.Add("linearity", text.Find("lensmodel")->line,
           lens.substr(0, mark.size()) == mark ? lens.substr(mark.size()) : "");
  const auto linearity = part.Number("linearity");
  if (!linearity || !(std::abs(*linearity) <= 10)) {
    return text.Wrong("lensmodel",
                      "needs a linearity within -10 .. 10, as in "
                      "LENSMODEL_CAHVORE_linearity=0.34");
  }
  return linearity;
}

/// The lens in camera axes.
Result<CameraModel> ReadLens(const KeyedText& text, const std::string& lens) {
  const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
  const Eigen::Vector3d o = Eigen::Vector3d::Zero();
  for (const auto& [name, coefficients] : {std::pair{"LENSMODEL_PINHOLE", 0},
                                           {"LENSMODEL_OPENCV4", 4},
                                           {"LENSMODEL_OPENCV5", 5},
                                           {"LENSMODEL_OPENCV8", 8},
                                           {"LENSMODEL_OPENCV12", 12}}) {
    if (lens == name) {
      const auto values = ReadIntrinsics(text, 4 + static_cast<std::size_t>(coefficients));
      if (!values) {
        return values.error();
      }
      OpenCvModel model;
      model.pinhole = PinholeFrom(*values);
      model.coefficients = coefficients;
      std::copy(values->begin() + 4, values->end(), model.k.begin());
      return CameraModel{model};
    }
  }
  if (lens == "LENSMODEL_CAHVOR") {
    const auto values = ReadIntrinsics(text, 9);
    if (!values) {
      return values.error();
    }
    const std::vector<double>& v = *values;
    CahvorModel model = CahvFromPinhole(PinholeFrom(v), I, o);
    model.O = AxisFrom(v[4], v[5]);
    model.R = {v[6], v[7], v[8]};
    return CameraModel{model};
  }
  if (lens.substr(0, 17) == "LENSMODEL_CAHVORE") {
    const auto linearity = LinearityFrom(text, lens);
    if (!linearity) {
      return linearity.error();
    }
    const auto values = ReadIntrinsics(text, 12);
    if (!values) {
      return values.error();
    }
    const std::vector<double>& v = *values;
    CahvoreModel model;
    model.base = CahvFromPinhole(PinholeFrom(v), I, o);
    model.base.O = AxisFrom(v[4], v[5]);
    model.base.R = {v[6], v[7], v[8]};
    model.E = {v[9], v[10], v[11]};
    model.linearity = *linearity;
    return CameraModel{model};
  }
  return text.Wrong("lensmodel",
                    "PALACE reads LENSMODEL_PINHOLE, OPENCV4, 5, 8, 12, CAHVOR and CAHVORE; refit "
                    "the model to one of them with mrcal-convert-lensmodel");
}

}  // namespace

Result<CameraModel> ReadMrcal(const KeyedText& text) {
  if (!text.Has("lensmodel")) {
    return text.Missing("lensmodel", "a .cameramodel file needs it");
  }
  const auto lens = ReadLens(text, text.Word("lensmodel"));
  if (!lens) {
    return lens.error();
  }
  const auto size = ReadSides(text, "imagersize");
  if (!size) {
    return size.error();
  }
  const std::string key = text.Has("rt_cam_ref") ? "rt_cam_ref" : "extrinsics";
  const auto rt = text.Numbers(key, 6, 6);
  if (!rt) {
    return rt.error();
  }
  const Eigen::Vector3d t_CF = Eigen::Map<const Eigen::Vector3d>(rt->data() + 3);
  const Eigen::Matrix3d R_CF = RotationFromVector(Eigen::Map<const Eigen::Vector3d>(rt->data()));
  CameraModel model = MovedCamera(*lens, R_CF.transpose(), -(R_CF.transpose() * t_CF));
  SetSize(model, size->width, size->height);
  return WithInternals(text, InternalsKeys::In("intrinsics"), model);
}

}  // namespace palace
