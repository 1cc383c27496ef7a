#include "engine/camera/conversion_targets.h"

#include <array>
#include <cmath>

#include "engine/camera/cahvor.h"
#include "engine/camera/tsai.h"

namespace palace {
namespace {

constexpr double kWideTangent = 1.2;  // folds hinder the fits of wider pictures only
constexpr double kPitch_m = 1e-5;     // a Tsai camera's pixels, where the source tells none

/// Where a fit begins: the linear part of the source.
struct Base {
  CahvPinhole pinhole;
  bool pose_is_known = true;
};

Base BaseOf(const CameraModel& source) {
  CahvorModel linear = LinearPartOf(source);
  // R0 scales the picture's middle: a family without it needs that in its focal length.
  const auto* cahvor = std::get_if<CahvorModel>(&source.lens);
  const auto* cahvore = std::get_if<CahvoreModel>(&source.lens);
  const double R0 = cahvor != nullptr ? cahvor->R[0] : cahvore != nullptr ? cahvore->base.R[0] : 0;
  Base base{PinholeFromCahv(linear), source.pose_is_known};
  base.pinhole.camera.fx_px *= 1 + R0;
  base.pinhole.camera.fy_px *= 1 + R0;
  return base;
}

/// Parameters 0..6: rotation vector, focal lengths and centre by the focal length.
constexpr Eigen::Index kPinholeParameters = 7;

CahvPinhole PinholeAt(const Base& base, const Eigen::VectorXd& x) {
  CahvPinhole pinhole = base.pinhole;
  const Eigen::Vector3d turn = x.head<3>();
  if (turn.norm() > 0) {
    pinhole.R_CF = Eigen::AngleAxisd(turn.norm(), turn.normalized()) * pinhole.R_CF;
  }
  const double f = base.pinhole.camera.fx_px;
  pinhole.camera.fx_px *= 1 + x[3];
  pinhole.camera.fy_px *= 1 + x[4];
  pinhole.camera.cx_px += f * x[5];
  pinhole.camera.cy_px += f * x[6];
  return pinhole;
}

CahvorModel CahvAt(const Base& base, const Eigen::VectorXd& x) {
  const CahvPinhole pinhole = PinholeAt(base, x);
  CahvorModel model = CahvFromPinhole(pinhole.camera, pinhole.R_CF, pinhole.p_FC);
  model.V += pinhole.shear_px * pinhole.R_CF.row(0).transpose();
  return model;
}

/// O beside A by two small tangents.
Eigen::Vector3d AxisAt(const CahvPinhole& pinhole, double right, double down) {
  return pinhole.R_CF.transpose() * Eigen::Vector3d(right, down, 1).normalized();
}

ConversionTarget CahvorTarget(const Base& base, double widest) {
  const double square = widest * widest;
  return {[base, square](const Eigen::VectorXd& x) {
            CahvorModel model = CahvAt(base, x);
            model.O = AxisAt(PinholeAt(base, x), x[7], x[8]);
            model.R = {0, x[9] / square, x[10] / (square * square)};
            return CameraModel{model, 1, base.pose_is_known};
          },
          Eigen::VectorXd::Zero(kPinholeParameters + 4), base.pinhole.camera.fx_px};
}

ConversionTarget CahvoreTarget(const Base& base, double linearity, double widest) {
  // chi grows as the tangent for linearity 1 and stays of the order of 1 for the others.
  const double square = linearity == 1 ? widest * widest : 1;
  ConversionTarget target = {[base, square](const Eigen::VectorXd& x) {
                               CahvoreModel model;
                               model.base = CahvAt(base, x);
                               model.base.O = AxisAt(PinholeAt(base, x), x[7], x[8]);
                               model.base.R = {0, x[9] / square, x[10] / (square * square)};
                               model.linearity = x[11];
                               return CameraModel{model, 1, base.pose_is_known};
                             },
                             Eigen::VectorXd::Zero(kPinholeParameters + 5),
                             base.pinhole.camera.fx_px};
  target.start[11] = linearity;
  return target;
}

ConversionTarget TsaiTarget(const Base& base) {
  return {[base](const Eigen::VectorXd& x) {
            const CahvPinhole pinhole = PinholeAt(base, x);
            const PinholeCamera& camera = pinhole.camera;
            TsaiModel model;
            model.width = camera.width;
            model.height = camera.height;
            model.sensor_columns = model.frame_columns = camera.width;
            model.dx = model.dy = model.dpx = model.dpy = kPitch_m;
            model.f = camera.fy_px * kPitch_m;
            model.sx = camera.fx_px / camera.fy_px;
            model.Cx_px = camera.cx_px;
            model.Cy_px = camera.cy_px;
            model.kappa1 = x[7] / (model.f * model.f);
            SetRotationOfTsai(model, pinhole.R_CF);
            model.T = -(pinhole.R_CF * pinhole.p_FC);
            return CameraModel{model, 1, base.pose_is_known};
          },
          Eigen::VectorXd::Zero(kPinholeParameters + 1), base.pinhole.camera.fx_px};
}

/// Powers of the radius by which k1 k2 p1 p2 k3 k4 k5 k6 s1 s2 s3 s4 move a point, less one.
constexpr std::array<int, 12> kOrders = {2, 4, 1, 1, 6, 2, 4, 6, 1, 3, 1, 3};

CameraModel OpenCvAt(const Base& base, const Eigen::VectorXd& x, OpenCvLens lens, int coefficients,
                     double widest) {
  const CahvPinhole pinhole = PinholeAt(base, x);
  OpenCvModel model;
  model.pinhole = pinhole.camera;
  model.lens = lens;
  model.coefficients = coefficients;
  for (std::size_t i = 0; i < static_cast<std::size_t>(coefficients); ++i) {
    const double scale = lens == OpenCvLens::kFisheye ? 1 : std::pow(widest, kOrders[i]);
    model.k[i] = x[kPinholeParameters + static_cast<Eigen::Index>(i)] / scale;
  }
  model.R_CF = pinhole.R_CF;
  model.t_CF = -(pinhole.R_CF * pinhole.p_FC);
  return {model, 1, base.pose_is_known};
}

ConversionTarget OpenCvTarget(const Base& base, OpenCvLens lens, int coefficients, double widest) {
  ConversionTarget target = {
      [=](const Eigen::VectorXd& x) { return OpenCvAt(base, x, lens, coefficients, widest); },
      Eigen::VectorXd::Zero(kPinholeParameters + coefficients), base.pinhole.camera.fx_px};
  target.only_refines = lens == OpenCvLens::kPolynomial && widest < kWideTangent;
  if (coefficients == 12) {
    // Prism terms imitate a turn to the second order: without a hold K and R lose their meaning.
    target.prior_weight = 1e-2;
    target.only_refines = true;
  }
  return target;
}

int CoefficientsOf(LensFamily family) {
  switch (family) {
    case LensFamily::kOpenCv4:
    case LensFamily::kFisheye:
      return 4;
    case LensFamily::kOpenCv5:
      return 5;
    case LensFamily::kOpenCv8:
      return 8;
    case LensFamily::kOpenCv12:
      return 12;
    default:
      return 0;
  }
}

bool IsPolynomialFamily(LensFamily family) {
  return family == LensFamily::kPinhole || family == LensFamily::kOpenCv4 ||
         family == LensFamily::kOpenCv5 || family == LensFamily::kOpenCv8 ||
         family == LensFamily::kOpenCv12;
}

/// Coefficients that count: those before the last that is not 0.
int CoefficientsUsed(const OpenCvModel& m) {
  int used = static_cast<int>(m.k.size());
  while (used > 0 && m.k[static_cast<std::size_t>(used - 1)] == 0) {
    --used;
  }
  return used;
}

/// A camera without distortion, if the source is one.
bool IsUndistorted(const CameraModel& source) {
  if (const auto* cahvor = std::get_if<CahvorModel>(&source.lens)) {
    return cahvor->R.isZero(0);
  }
  if (const auto* tsai = std::get_if<TsaiModel>(&source.lens)) {
    return tsai->kappa1 == 0;
  }
  if (const auto* opencv = std::get_if<OpenCvModel>(&source.lens)) {
    return opencv->lens == OpenCvLens::kPolynomial && CoefficientsUsed(*opencv) == 0;
  }
  return false;
}

}  // namespace

bool IsOfFamily(const CameraModel& model, LensFamily family) {
  if (const auto* cahvor = std::get_if<CahvorModel>(&model.lens)) {
    return family == LensFamily::kCahvor || (family == LensFamily::kCahv && IsLinear(*cahvor));
  }
  if (std::holds_alternative<CahvoreModel>(model.lens)) {
    return family == LensFamily::kCahvore;
  }
  if (std::holds_alternative<TsaiModel>(model.lens)) {
    return family == LensFamily::kTsai;
  }
  const auto& opencv = std::get<OpenCvModel>(model.lens);
  if (opencv.lens == OpenCvLens::kFisheye) {
    return family == LensFamily::kFisheye;
  }
  return IsPolynomialFamily(family) && CoefficientsOf(family) == opencv.coefficients;
}

std::optional<CameraModel> ConvertedExactly(const CameraModel& source, LensFamily family) {
  const auto* cahvor = std::get_if<CahvorModel>(&source.lens);
  const auto* opencv = std::get_if<OpenCvModel>(&source.lens);
  if (cahvor != nullptr && family == LensFamily::kCahvore) {
    return CameraModel{CahvoreModel{*cahvor, Eigen::Vector3d::Zero(), 1}, 1, source.pose_is_known};
  }
  const auto* cahvore = std::get_if<CahvoreModel>(&source.lens);
  if (cahvore != nullptr && cahvore->linearity == 1 && family == LensFamily::kCahvor) {
    return CameraModel{cahvore->base, 1, source.pose_is_known};  // far points; the pupil is told
  }
  if (opencv != nullptr && opencv->lens == OpenCvLens::kPolynomial && IsPolynomialFamily(family) &&
      CoefficientsUsed(*opencv) <= CoefficientsOf(family)) {
    OpenCvModel model = *opencv;
    model.coefficients = CoefficientsOf(family);
    return CameraModel{model, 1, source.pose_is_known};
  }
  if (!IsUndistorted(source)) {
    return std::nullopt;
  }
  const Base base = BaseOf(source);
  switch (family) {
    case LensFamily::kCahv:
    case LensFamily::kCahvor:
      return CameraModel{LinearPartOf(source), 1, source.pose_is_known};
    case LensFamily::kCahvore:
      return CameraModel{CahvoreModel{LinearPartOf(source), Eigen::Vector3d::Zero(), 1}, 1,
                         source.pose_is_known};
    case LensFamily::kTsai:
      return TsaiTarget(base).camera(Eigen::VectorXd::Zero(kPinholeParameters + 1));
    case LensFamily::kFisheye:
      return std::nullopt;
    default:
      return OpenCvAt(base, Eigen::VectorXd::Zero(kPinholeParameters + CoefficientsOf(family)),
                      OpenCvLens::kPolynomial, CoefficientsOf(family), 1);
  }
}

std::vector<ConversionTarget> ConversionTargets(const CameraModel& source, LensFamily family,
                                                double widest_tangent) {
  const Base base = BaseOf(source);
  switch (family) {
    case LensFamily::kCahv:
      return {};
    case LensFamily::kCahvor:
      return {CahvorTarget(base, widest_tangent)};
    case LensFamily::kCahvore:
      return {CahvoreTarget(base, 1, widest_tangent), CahvoreTarget(base, 0.3, 1),
              CahvoreTarget(base, -0.5, 1)};
    case LensFamily::kTsai:
      return {TsaiTarget(base)};
    case LensFamily::kFisheye:
      return {OpenCvTarget(base, OpenCvLens::kFisheye, 4, 1)};
    default:
      return {OpenCvTarget(base, OpenCvLens::kPolynomial, CoefficientsOf(family), widest_tangent)};
  }
}

std::optional<LensFamily> NestedFamily(LensFamily family) {
  switch (family) {
    case LensFamily::kOpenCv12:
      return LensFamily::kOpenCv8;
    case LensFamily::kOpenCv8:
      return LensFamily::kOpenCv5;
    case LensFamily::kOpenCv5:
      return LensFamily::kOpenCv4;
    case LensFamily::kCahvore:
      return LensFamily::kCahvor;
    case LensFamily::kOpenCv4:
    case LensFamily::kCahvor:
    case LensFamily::kTsai:
      return LensFamily::kPinhole;
    default:
      return std::nullopt;
  }
}

}  // namespace palace
