// Writing OpenCV's camera files (FileStorage YAML and XML) and ROS camera_info.
#include "engine/camera/files/camera_file_formats.h"

namespace palace {
namespace {

/// The text of a matrix in the two containers.
struct Matrix {
  const char* name;
  int rows;
  std::vector<double> values;  ///< row by row
};

std::vector<double> RowByRow(const Eigen::Matrix3d& m) {
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> rows = m;
  return {rows.data(), rows.data() + 9};
}

std::vector<double> CameraMatrix(const PinholeCamera& c) {
  return {c.fx_px, 0, c.cx_px, 0, c.fy_px, c.cy_px, 0, 0, 1};
}

/// A camera without distortion is written with five zeros, as OpenCV does.
std::vector<double> Coefficients(const OpenCvModel& m) {
  return {m.k.begin(), m.k.begin() + (m.coefficients == 0 ? 5 : m.coefficients)};
}

/// The camera matrix, which no file may lack, stands last: YAML has no end mark, and a file cut
/// short must not read as a camera without distortion or pose.
std::vector<Matrix> MatricesOf(const CameraModel& model) {
  const auto& m = std::get<OpenCvModel>(model.lens);
  std::vector<Matrix> matrices = {{"distortion_coefficients", 1, Coefficients(m)}};
  if (model.pose_is_known) {
    matrices.push_back({"R", 3, RowByRow(m.R_CF)});
    matrices.push_back({"T", 3, {m.t_CF.x(), m.t_CF.y(), m.t_CF.z()}});
  }
  matrices.push_back({"camera_matrix", 3, CameraMatrix(m.pinhole)});
  return matrices;
}

bool IsFisheye(const CameraModel& model) {
  return std::get<OpenCvModel>(model.lens).lens == OpenCvLens::kFisheye;
}

}  // namespace

std::string OpenCvToYaml(const CameraModel& model) {
  std::string text = "%YAML:1.0\n---\n";
  if (HasSize(model)) {
    text += "image_width: " + std::to_string(WidthOf(model)) +
            "\nimage_height: " + std::to_string(HeightOf(model)) + "\n";
  }
  if (IsFisheye(model)) {
    text += "fisheye_model: 1\n";
  }
  for (const Matrix& m : MatricesOf(model)) {
    text += std::string(m.name) + ": !!opencv-matrix\n   rows: " + std::to_string(m.rows) +
            "\n   cols: " + std::to_string(m.values.size() / static_cast<std::size_t>(m.rows)) +
            "\n   dt: d\n   data: [ " + Exact(m.values.data(), m.values.size(), ", ") + " ]\n";
  }
  return text;
}

std::string OpenCvToXml(const CameraModel& model) {
  std::string text = "<?xml version=\"1.0\"?>\n<opencv_storage>\n";
  if (HasSize(model)) {
    text += "<image_width>" + std::to_string(WidthOf(model)) + "</image_width>\n<image_height>" +
            std::to_string(HeightOf(model)) + "</image_height>\n";
  }
  if (IsFisheye(model)) {
    text += "<fisheye_model>1</fisheye_model>\n";
  }
  for (const Matrix& m : MatricesOf(model)) {
    const std::string name = m.name;
    text += "<" + name + " type_id=\"opencv-matrix\">\n  <rows>" + std::to_string(m.rows) +
            "</rows>\n  <cols>" +
            std::to_string(m.values.size() / static_cast<std::size_t>(m.rows)) +
            "</cols>\n  <dt>d</dt>\n  <data>\n    " + Exact(m.values.data(), m.values.size(), " ") +
            "</data></" + name + ">\n";
  }
  return text + "</opencv_storage>\n";
}

std::string RosToYaml(const CameraModel& model) {
  const auto& m = std::get<OpenCvModel>(model.lens);
  const Eigen::Matrix3d R_RectC = m.R_CF.transpose();
  const Eigen::Vector3d t_RectF = R_RectC * m.t_CF;
  const PinholeCamera& c = m.pinhole;
  const auto matrix = [](const char* name, int rows, const std::vector<double>& values) {
    return std::string(name) + ":\n  rows: " + std::to_string(rows) +
           "\n  cols: " + std::to_string(values.size() / static_cast<std::size_t>(rows)) +
           "\n  data: [" + Exact(values.data(), values.size(), ", ") + "]\n";
  };
  std::string text;
  if (HasSize(model)) {
    text += "image_width: " + std::to_string(c.width) +
            "\nimage_height: " + std::to_string(c.height) + "\n";
  }
  text += "camera_name: palace\n" + matrix("camera_matrix", 3, CameraMatrix(c));
  const bool fisheye = IsFisheye(model);
  text += std::string("distortion_model: ") +
          (fisheye              ? "equidistant"
           : m.coefficients > 5 ? "rational_polynomial"
                                : "plumb_bob") +
          "\n" + matrix("distortion_coefficients", 1, Coefficients(m));
  text += matrix("rectification_matrix", 3, RowByRow(R_RectC));
  text += matrix("projection_matrix", 3,
                 {c.fx_px, 0, c.cx_px, c.fx_px * t_RectF.x() + c.cx_px * t_RectF.z(), 0, c.fy_px,
                  c.cy_px, c.fy_px * t_RectF.y() + c.cy_px * t_RectF.z(), 0, 0, 1, t_RectF.z()});
  return text;
}

}  // namespace palace
