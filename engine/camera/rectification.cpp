#include "engine/camera/rectification.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "engine/camera/alignment.h"
#include "engine/camera/cahvor.h"
#include "engine/camera/grey_view.h"
#include "engine/core/text.h"
#include "engine/model/rig_limits.h"

namespace palace {

/// Where each rectified pixel lies in the raw picture; (-1e4, -1e4) where it has no place.
struct StereoRectifier::Maps {
  cv::Mat left_x;
  cv::Mat left_y;
  cv::Mat right_x;
  cv::Mat right_y;
};

namespace {

bool HasDistortion(const RigCamera& camera) {
  return std::any_of(camera.distortion.begin(), camera.distortion.end(),
                     [](double k) { return k != 0; });
}

/// Also of aligned cameras, whose focal length and distance no rig file tells.
Status Check(const std::string& why, const char* what) {
  return why.empty() ? Ok()
                     : Status(InvalidError(std::string("rig: ") + what + " has " + why +
                                           "; check RIG.toml"));
}

void PlumbBobMaps(const RigCamera& raw, const PinholeCamera& rectified, cv::Mat& x, cv::Mat& y) {
  const PinholeCamera& p = raw.pinhole;
  const cv::Matx33d K(p.fx_px, 0, p.cx_px, 0, p.fy_px, p.cy_px, 0, 0, 1);
  const cv::Matx33d K_new(rectified.fx_px, 0, rectified.cx_px, 0, rectified.fy_px, rectified.cy_px,
                          0, 0, 1);
  const cv::Vec<double, 5> k(raw.distortion.data());
  cv::initUndistortRectifyMap(K, k, cv::Matx33d::eye(), K_new, {rectified.width, rectified.height},
                              CV_32FC1, x, y);
}

/// The camera with its centre, and its pupil for good, at the origin: projecting a point then is
/// projecting a direction.
CameraModel Centred(const CameraModel& camera) {
  CameraModel centred = MovedCamera(camera, Eigen::Matrix3d::Identity(), -CentreOf(camera));
  if (auto* cahvore = std::get_if<CahvoreModel>(&centred.lens)) {
    cahvore->E.setZero();
  }
  return centred;
}

void ModelMaps(const CameraModel& raw, const CahvorModel& aligned, cv::Mat& x, cv::Mat& y) {
  constexpr float kNowhere = -1e4F;
  x.create(aligned.height, aligned.width, CV_32FC1);
  y.create(aligned.height, aligned.width, CV_32FC1);
  const CameraModel camera = Centred(raw);
  // Rays of a linear camera are linear in the pixel.
  const Eigen::Vector3d origin = LinearRayCahv(aligned, {0, 0});
  const Eigen::Vector3d along_row = LinearRayCahv(aligned, {1, 0}) - origin;
  const Eigen::Vector3d along_column = LinearRayCahv(aligned, {0, 1}) - origin;
  cv::parallel_for_({0, aligned.height}, [&](const cv::Range& rows) {
    for (int row = rows.start; row < rows.end; ++row) {
      const Eigen::Vector3d start = origin + row * along_column;
      float* x_row = x.ptr<float>(row);
      float* y_row = y.ptr<float>(row);
      for (int col = 0; col < aligned.width; ++col) {
        const auto pixel = ProjectCamera(camera, start + col * along_row);
        x_row[col] = pixel ? static_cast<float>(pixel->x()) : kNowhere;
        y_row[col] = pixel ? static_cast<float>(pixel->y()) : kNowhere;
      }
    }
  });
}

std::shared_ptr<const ImageU8> Resample(const ImageU8& raw, const cv::Mat& x, const cv::Mat& y) {
  auto out = std::make_shared<ImageU8>(x.cols, x.rows);
  const cv::Mat source = GreyView(raw);
  cv::Mat target(out->height(), out->width(), CV_8UC1, out->pixels().data());
  // Cubic: linear weights blur by an amount that depends on the fraction, which biases disparity.
  cv::remap(source, target, x, y, cv::INTER_CUBIC, cv::BORDER_CONSTANT, cv::Scalar(0));
  return out;
}

}  // namespace

Result<StereoRectifier> StereoRectifier::Make(const StereoRig& rig) {
  const std::optional<CameraModel>& left = rig.left.model;
  const std::optional<CameraModel>& right = rig.right.model;
  if (left.has_value() != right.has_value()) {
    return InvalidError(
        "rig: one camera has a model_file and the other has not; give both or none");
  }
  StereoRectifier rectifier;
  if (left) {
    const auto aligned = AlignPair(*left, *right);
    if (!aligned) {
      return InvalidError("rig: " + aligned.error().message);
    }
    const CahvPinhole pinhole = PinholeFromCahv(aligned->left);
    if ((CentreOf(*right) - CentreOf(*left)).dot(pinhole.R_CF.row(0)) < 0) {
      return InvalidError(
          "rig: the right camera stands to the left of the left one; exchange [left] and [right]");
    }
    rectifier.camera_ = pinhole.camera;
    rectifier.baseline_m_ = (CentreOf(*right) - CentreOf(*left)).norm();
    for (const Status& status :
         {Check(WhyNoPinhole(pinhole.camera), "the aligned pair"),
          Check(WhyNoPictureSize(aligned->right.width, aligned->right.height), "the aligned pair"),
          Check(WhyNoBaseline(rectifier.baseline_m_), "the pair of models")}) {
      if (!status) {
        return status.error();
      }
    }
    rectifier.R_C_Rect_ = RotationOf(*left) * pinhole.R_CF.transpose();
    rectifier.left_width_ = WidthOf(*left);
    rectifier.left_height_ = HeightOf(*left);
    rectifier.right_width_ = WidthOf(*right);
    rectifier.right_height_ = HeightOf(*right);
    auto maps = std::make_shared<Maps>();
    ModelMaps(*left, aligned->left, maps->left_x, maps->left_y);
    ModelMaps(*right, aligned->right, maps->right_x, maps->right_y);
    rectifier.maps_ = std::move(maps);
    return rectifier;
  }
  for (const Status& status : {Check(WhyNoPinhole(rig.left.pinhole), "the left camera"),
                               Check(WhyNoPinhole(rig.right.pinhole), "the right camera"),
                               Check(WhyNoBaseline(rig.baseline_m), "the pair")}) {
    if (!status) {
      return status.error();
    }
  }
  rectifier.camera_ = rig.left.pinhole;
  rectifier.baseline_m_ = rig.baseline_m;
  rectifier.left_width_ = rig.left.pinhole.width;
  rectifier.left_height_ = rig.left.pinhole.height;
  rectifier.right_width_ = rig.right.pinhole.width;
  rectifier.right_height_ = rig.right.pinhole.height;
  // A rig that calls itself rectified is only so with one pinhole and no distortion.
  if (HasDistortion(rig.left) || HasDistortion(rig.right) ||
      !(rig.left.pinhole == rig.right.pinhole)) {
    auto maps = std::make_shared<Maps>();
    PlumbBobMaps(rig.left, rectifier.camera_, maps->left_x, maps->left_y);
    PlumbBobMaps(rig.right, rectifier.camera_, maps->right_x, maps->right_y);
    rectifier.maps_ = std::move(maps);
  }
  return rectifier;
}

Result<RectifiedPair> StereoRectifier::Rectify(const StereoFrame& frame) const {
  const auto check = [](const ImageU8& image, int width, int height, const char* side) -> Status {
    if (image.width() == width && image.height() == height) {
      return Ok();
    }
    return InvalidError(std::string("rectification: the ") + side + " picture is " +
                        SizeText(image.width(), image.height()) + ", the rig's camera is " +
                        SizeText(width, height) + "; check RIG.toml");
  };
  for (const Status& status : {check(frame.left, left_width_, left_height_, "left"),
                               check(frame.right, right_width_, right_height_, "right")}) {
    if (!status) {
      return status.error();
    }
  }
  if (!maps_) {
    return RectifiedPair{std::make_shared<const ImageU8>(frame.left),
                         std::make_shared<const ImageU8>(frame.right)};
  }
  return RectifiedPair{Resample(frame.left, maps_->left_x, maps_->left_y),
                       Resample(frame.right, maps_->right_x, maps_->right_y)};
}

const PinholeCamera& StereoRectifier::camera() const { return camera_; }
double StereoRectifier::baseline_m() const { return baseline_m_; }
const Eigen::Matrix3d& StereoRectifier::R_C_Rect() const { return R_C_Rect_; }
RigidTransform StereoRectifier::X_BC(const StereoRig& rig) const {
  RigidTransform X_BC = rig.X_BC();
  X_BC.R = X_BC.R * R_C_Rect_;
  return X_BC;
}

}  // namespace palace
