// Reading OpenCV's camera files (FileStorage YAML and XML) and ROS camera_info.
#include <algorithm>
#include <cmath>

#include "engine/camera/files/camera_file_formats.h"
#include "engine/core/rotation_vector.h"

namespace palace {
namespace {

constexpr double kRotationTolerance = 1e-3;  // files may hold six digits

/// A matrix is "name.data" (or "name" where a list follows at once).
std::string DataKey(const KeyedText& text, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    for (const std::string& key : {name + ".data", name}) {
      if (text.Has(key)) {
        return key;
      }
    }
  }
  return {};
}

/// The numbers of a matrix, as many as its rows and cols tell where it has them.
Result<std::vector<double>> ReadMatrix(const KeyedText& text, const std::string& key,
                                       std::size_t least, std::size_t most) {
  constexpr int kMostRows = 1 << 15;
  auto values = text.Numbers(key, least, most);
  const std::string name = key.substr(0, key.rfind(".data"));
  if (!values || (!text.Has(name + ".rows") && !text.Has(name + ".cols"))) {
    return values;
  }
  const auto rows = text.Count(name + ".rows", 0, kMostRows);
  if (!rows) {
    return rows.error();
  }
  const auto columns = text.Count(name + ".cols", 0, kMostRows);
  if (!columns) {
    return columns.error();
  }
  if (static_cast<std::size_t>(*rows) * static_cast<std::size_t>(*columns) != values->size()) {
    return text.Wrong(key, "holds " + std::to_string(values->size()) + " numbers, rows x cols = " +
                               std::to_string(*rows) + " x " + std::to_string(*columns) +
                               " promise others; is the file cut short?");
  }
  return values;
}

/// fx, fy, cx, cy of a 3x3 camera matrix.
Status ReadCameraMatrix(const KeyedText& text, const std::string& key, PinholeCamera& camera) {
  const auto K = ReadMatrix(text, key, 9, 9);
  if (!K) {
    return K.error();
  }
  const std::vector<double>& k = *K;
  if (!(k[0] > 0) || !(k[4] > 0)) {
    return text.Wrong(key,
                      "the focal lengths (1,1) and (2,2) must be positive; is the camera "
                      "calibrated?");
  }
  if (k[3] != 0 || k[6] != 0 || k[7] != 0 || k[8] != 1) {
    return text.Wrong(key, "must have the form fx 0 cx, 0 fy cy, 0 0 1");
  }
  if (std::abs(k[1]) > 1e-9 * k[0]) {
    return text.Wrong(
        key, "holds a skew of " + std::to_string(k[1]) + " px at (1,2); OpenCV's camera has none");
  }
  camera.fx_px = k[0];
  camera.fy_px = k[4];
  camera.cx_px = k[2];
  camera.cy_px = k[5];
  return Ok();
}

/// A missing distortion is unknown, not 0: files cut short lack it too.
Status ReadDistortion(const KeyedText& text, const std::vector<std::string>& names,
                      OpenCvModel& model) {
  const std::string key = DataKey(text, names);
  if (key.empty()) {
    return text.Missing(names.front(),
                        "a file cut short lacks it too; write 5 zeros (4 for a fisheye) for a lens "
                        "without distortion");
  }
  const auto values = ReadMatrix(text, key, 0, 14);
  if (!values) {
    return values.error();
  }
  const std::size_t count = values->size();
  const bool fisheye = model.lens == OpenCvLens::kFisheye;
  const bool known =
      fisheye ? count == 4 : count == 4 || count == 5 || count == 8 || count == 12 || count == 14;
  if (!known) {
    return text.Wrong(key, "has " + std::to_string(count) + " coefficients, it must have " +
                               (fisheye ? "4 for a fisheye" : "4, 5, 8, 12 or 14") +
                               "; write zeros for a lens without distortion");
  }
  std::copy(values->begin(), values->end(), model.k.begin());
  const bool all_zero =
      std::all_of(values->begin(), values->end(), [](double k) { return k == 0; });
  model.coefficients = all_zero && !fisheye ? 0 : static_cast<int>(count);
  return Ok();
}

/// A rotation matrix, or an axis times angle of 3 numbers (OpenCV's Rodrigues vector).
Status ReadRotation(const KeyedText& text, const std::string& key, Eigen::Matrix3d& R) {
  const auto values = ReadMatrix(text, key, 3, 9);
  if (!values) {
    return values.error();
  }
  if (values->size() == 3) {
    R = RotationFromVector(Eigen::Map<const Eigen::Vector3d>(values->data()));
    return Ok();
  }
  if (values->size() != 9) {
    return text.Wrong(key, "a rotation has 9 numbers, or 3 as a vector");
  }
  R = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(values->data());
  return TakeRotation(text, key, R);
}

Status ReadPose(const KeyedText& text, OpenCvModel& model, bool& known) {
  const std::string rotation = DataKey(text, {"R", "rotation_matrix"});
  const std::string translation = DataKey(text, {"T", "t", "translation_vector"});
  if (rotation.empty() && translation.empty()) {
    known = false;
    return Ok();
  }
  if (rotation.empty() || translation.empty()) {
    return text.Missing(rotation.empty() ? "R" : "T",
                        "a pose needs R and T; give both or neither (a file cut short lacks one)");
  }
  if (Status status = ReadRotation(text, rotation, model.R_CF); !status) {
    return status;
  }
  const auto t = ReadMatrix(text, translation, 3, 3);
  if (!t) {
    return t.error();
  }
  model.t_CF = Eigen::Map<const Eigen::Vector3d>(t->data());
  known = true;
  return Ok();
}

Result<PictureSize> ReadOpenCvSize(const KeyedText& text) {
  for (const auto& [width, height] : {std::pair{"image_width", "image_height"},
                                      {"image_Width", "image_Height"},
                                      {"imageWidth", "imageHeight"},
                                      {"width", "height"}}) {
    if (text.Has(width) || text.Has(height)) {
      return ReadSize(text, width, height);
    }
  }
  const std::string key = DataKey(text, {"imageSize", "image_size", "imagesize", "size"});
  return key.empty() ? Result<PictureSize>(PictureSize{}) : ReadSides(text, key);
}

}  // namespace

Status TakeRotation(const KeyedText& text, const std::string& key, Eigen::Matrix3d& R) {
  const double error = (R * R.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(error < kRotationTolerance) || !(R.determinant() > 0)) {
    return text.Wrong(key, "is no rotation: R R^T must be the identity within 0.001, det R = 1");
  }
  if (!(error < 1e-14)) {
    R = Eigen::Quaterniond(R).normalized().toRotationMatrix();
  }
  return Ok();
}

Result<CameraModel> ReadOpenCv(const KeyedText& text, const CameraFileOptions& options) {
  const std::string single = DataKey(
      text, {"camera_matrix", "cameraMatrix", "Camera_Matrix", "camera_Matrix", "K", "intrinsics"});
  const std::string of_left = DataKey(text, {"M1", "K1", "cameraMatrix1", "camera_matrix_1"});
  const std::string of_right = DataKey(text, {"M2", "K2", "cameraMatrix2", "camera_matrix_2"});
  OpenCvModel model;
  const std::string fisheye = text.Word("fisheye_model");
  if (text.Has("fisheye_model") && fisheye.empty()) {
    return text.Wrong("fisheye_model", "must be 0 or 1");
  }
  const std::string lens = text.Word("distortion_model");
  if ((!fisheye.empty() && fisheye != "0") || lens == "equidistant" || lens == "fisheye") {
    model.lens = OpenCvLens::kFisheye;
  }
  std::string matrix = single;
  std::vector<std::string> distortion = {"distortion_coefficients",
                                         "distCoeffs",
                                         "Distortion_Coefficients",
                                         "dist_coeffs",
                                         "dist_coeff",
                                         "D"};
  const bool is_pair = single.empty() && !of_left.empty() && !of_right.empty();
  const bool is_right = is_pair && options.side == StereoSide::kRight;
  if (is_pair) {
    if (!options.side) {
      return InvalidError(text.file() + ": holds two cameras (" + of_left + ", " + of_right +
                          "); choose one with --camera left or right");
    }
    matrix = is_right ? of_right : of_left;
    const std::string number = is_right ? "2" : "1";
    distortion = {"D" + number, "distCoeffs" + number, "distortion_coefficients_" + number};
  } else if (matrix.empty()) {
    matrix = of_left.empty() ? of_right : of_left;
    const std::string number = of_left.empty() ? "2" : "1";
    distortion = {"D" + number, "distCoeffs" + number, "distortion_coefficients_" + number};
    if (!matrix.empty() && options.side &&
        (*options.side == StereoSide::kRight) != of_left.empty()) {
      return text.Missing(of_left.empty() ? "M1" : "M2",
                          "the file holds " + matrix +
                              ", the other camera of a pair; take the other file, or fetch this "
                              "one anew if it is cut short");
    }
  }
  if (matrix.empty()) {
    return text.Missing("camera_matrix",
                        "OpenCV's camera files name it camera_matrix, "
                        "cameraMatrix, M1 or M2");
  }
  if (Status status = ReadCameraMatrix(text, matrix, model.pinhole); !status) {
    return status.error();
  }
  if (Status status = ReadDistortion(text, distortion, model); !status) {
    return status.error();
  }
  const auto size = ReadOpenCvSize(text);
  if (!size) {
    return size.error();
  }
  bool pose_is_known = false;
  if (Status status = ReadPose(text, model, pose_is_known); !status) {
    return status.error();
  }
  if (is_pair && !is_right) {  // R, T take the left camera's frame to the right one's
    model.R_CF.setIdentity();
    model.t_CF.setZero();
  }
  CameraModel camera{model, 1, pose_is_known};
  SetSize(camera, size->width, size->height);
  return WithInternals(text, InternalsKeys::In(matrix), camera);
}

Result<CameraModel> ReadRos(const KeyedText& text) {
  OpenCvModel model;
  const std::string K = DataKey(text, {"camera_matrix", "K", "k"});
  if (K.empty()) {
    return text.Missing("camera_matrix", "a camera_info file needs it");
  }
  if (Status status = ReadCameraMatrix(text, K, model.pinhole); !status) {
    return status.error();
  }
  const std::string lens = text.Word("distortion_model");
  if (lens == "equidistant" || lens == "fisheye") {
    model.lens = OpenCvLens::kFisheye;
  } else if (!lens.empty() && lens != "plumb_bob" && lens != "rational_polynomial" &&
             lens != "none") {
    return text.Wrong("distortion_model",
                      "PALACE reads plumb_bob, rational_polynomial and equidistant");
  }
  const std::vector<std::string> distortion = {"distortion_coefficients", "D", "d"};
  const KeyedValue* coefficients = text.Find(DataKey(text, distortion));
  const bool has_none = text.Has("distortion_model") && (lens.empty() || lens == "none") &&
                        coefficients != nullptr && coefficients->text == "[]";
  if (Status status = has_none ? Ok() : ReadDistortion(text, distortion, model); !status) {
    return status.error();
  }
  const auto size = text.Has("image_width") ? ReadSize(text, "image_width", "image_height")
                                            : ReadSize(text, "width", "height");
  if (!size) {
    return size.error();
  }
  // F is the rectified frame of the pair's left camera: x_rect = R p_C, P = K' [I | t_rect].
  const std::string R = DataKey(text, {"rectification_matrix", "R", "r"});
  const std::string P = DataKey(text, {"projection_matrix", "P", "p"});
  if (R.empty() || P.empty()) {
    return text.Missing(R.empty() ? "rectification_matrix" : "projection_matrix",
                        "a camera_info file tells the pose by it; fetch it anew if it is cut "
                        "short, or write the identity and K with a column of zeros");
  }
  Eigen::Matrix3d R_RectC = Eigen::Matrix3d::Identity();
  if (Status status = ReadRotation(text, R, R_RectC); !status) {
    return status.error();
  }
  const auto values = ReadMatrix(text, P, 12, 12);
  if (!values) {
    return values.error();
  }
  const Eigen::Matrix<double, 3, 4> projection =
      Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(values->data());
  if (!(projection(0, 0) > 0) || !(projection(1, 1) > 0) || projection(2, 2) != 1) {
    return text.Wrong(P,
                      "must have the form fx 0 cx Tx, 0 fy cy Ty, 0 0 1 0 with positive fx, fy; is "
                      "the camera calibrated?");
  }
  const Eigen::Vector3d t_RectF = projection.leftCols<3>().inverse() * projection.col(3);
  model.R_CF = R_RectC.transpose();
  model.t_CF = R_RectC.transpose() * t_RectF;
  const bool is_moved = !R_RectC.isIdentity(0) || !t_RectF.isZero(0);
  CameraModel camera{model, 1, is_moved};
  SetSize(camera, size->width, size->height);
  return WithInternals(text, InternalsKeys::In(K), camera);
}

}  // namespace palace
