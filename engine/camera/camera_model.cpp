#include "engine/camera/camera_model.h"

#include <cstdio>
#include <type_traits>

#include "engine/camera/cahvor.h"
#include "engine/camera/cahvore.h"
#include "engine/camera/opencv_lens.h"
#include "engine/camera/tsai.h"

namespace palace {
namespace {

/// One function a family.
template <class... Functions>
struct Each : Functions... {
  using Functions::operator()...;
};
template <class... Functions>
Each(Functions...) -> Each<Functions...>;

PinholeCamera PinholeOf(const TsaiModel& m) {
  return {m.width, m.height, m.f * m.sx / m.dpx, m.f / m.dpy, m.Cx_px, m.Cy_px};
}

/// Lengths of a CAHV part times `factor`.
void Scale(CahvorModel& m, double factor) { m.C *= factor; }

}  // namespace

std::optional<Eigen::Vector2d> ProjectCamera(const CameraModel& model,
                                             const Eigen::Vector3d& p_FQ) {
  return std::visit(Each{[&](const CahvorModel& m) { return ProjectCahvor(m, p_FQ); },
                         [&](const CahvoreModel& m) { return ProjectCahvore(m, p_FQ); },
                         [&](const TsaiModel& m) { return ProjectTsai(m, p_FQ); },
                         [&](const OpenCvModel& m) { return ProjectOpenCv(m, p_FQ); }},
                    model.lens);
}

std::optional<ProjectionJacobian> JacobianOfCamera(const CameraModel& model,
                                                   const Eigen::Vector3d& p_FQ) {
  return std::visit(Each{[&](const CahvorModel& m) { return JacobianOfCahvor(m, p_FQ); },
                         [&](const CahvoreModel& m) { return JacobianOfCahvore(m, p_FQ); },
                         [&](const TsaiModel& m) { return JacobianOfTsai(m, p_FQ); },
                         [&](const OpenCvModel& m) { return JacobianOfOpenCv(m, p_FQ); }},
                    model.lens);
}

std::optional<Eigen::Vector2d> ProjectDirection(const CameraModel& model,
                                                const Eigen::Vector3d& direction_F) {
  if (const auto* cahvore = std::get_if<CahvoreModel>(&model.lens)) {
    return ProjectDirectionCahvore(*cahvore, direction_F);
  }
  // The centre does not move: any point of the ray will do.
  return ProjectCamera(model, CentreOf(model) + direction_F);
}

std::optional<CameraRay> RayFromPixelCamera(const CameraModel& model,
                                            const Eigen::Vector2d& pixel) {
  return std::visit(Each{[&](const CahvorModel& m) { return RayFromPixelCahvor(m, pixel); },
                         [&](const CahvoreModel& m) { return RayFromPixelCahvore(m, pixel); },
                         [&](const TsaiModel& m) { return RayFromPixelTsai(m, pixel); },
                         [&](const OpenCvModel& m) { return RayFromPixelOpenCv(m, pixel); }},
                    model.lens);
}

int WidthOf(const CameraModel& model) {
  return std::visit(Each{[](const CahvoreModel& m) { return m.base.width; },
                         [](const OpenCvModel& m) { return m.pinhole.width; },
                         [](const auto& m) { return m.width; }},
                    model.lens);
}

int HeightOf(const CameraModel& model) {
  return std::visit(Each{[](const CahvoreModel& m) { return m.base.height; },
                         [](const OpenCvModel& m) { return m.pinhole.height; },
                         [](const auto& m) { return m.height; }},
                    model.lens);
}

bool HasSize(const CameraModel& model) { return WidthOf(model) > 0 && HeightOf(model) > 0; }

void SetSize(CameraModel& model, int width, int height) {
  const auto set = [&](auto& sized) {
    sized.width = width;
    sized.height = height;
  };
  std::visit(Each{[&](CahvoreModel& m) { set(m.base); }, [&](OpenCvModel& m) { set(m.pinhole); },
                  [&](auto& m) { set(m); }},
             model.lens);
}

CahvorModel LinearPartOf(const CameraModel& model) {
  CahvorModel linear = std::visit(
      Each{[](const CahvorModel& m) { return m; }, [](const CahvoreModel& m) { return m.base; },
           [](const TsaiModel& m) {
             const Eigen::Matrix3d R_CF = RotationOfTsai(m);
             return CahvFromPinhole(PinholeOf(m), R_CF, -(R_CF.transpose() * m.T));
           },
           [](const OpenCvModel& m) {
             return CahvFromPinhole(m.pinhole, m.R_CF, -(m.R_CF.transpose() * m.t_CF));
           }},
      model.lens);
  linear.O = linear.A;
  linear.R.setZero();
  return linear;
}

Eigen::Matrix3d RotationOf(const CameraModel& model) {
  return PinholeFromCahv(LinearPartOf(model)).R_CF;
}

Eigen::Vector3d CentreOf(const CameraModel& model) {
  return std::visit(
      Each{[](const CahvorModel& m) -> Eigen::Vector3d { return m.C; },
           [](const CahvoreModel& m) -> Eigen::Vector3d { return m.base.C; },
           [](const TsaiModel& m) -> Eigen::Vector3d {
             return -(RotationOfTsai(m).transpose() * m.T);
           },
           [](const OpenCvModel& m) -> Eigen::Vector3d { return -(m.R_CF.transpose() * m.t_CF); }},
      model.lens);
}

CameraModel MovedCamera(CameraModel model, const Eigen::Matrix3d& R_GF,
                        const Eigen::Vector3d& t_GF) {
  const auto move = [&](CahvorModel& m) {
    m.C = R_GF * m.C + t_GF;
    for (Eigen::Vector3d* v : {&m.A, &m.H, &m.V, &m.O}) {
      *v = R_GF * *v;
    }
  };
  std::visit(Each{[&](CahvorModel& m) { move(m); }, [&](CahvoreModel& m) { move(m.base); },
                  [&](TsaiModel& m) {
                    const Eigen::Matrix3d R_CG = RotationOfTsai(m) * R_GF.transpose();
                    m.T -= R_CG * t_GF;
                    SetRotationOfTsai(m, R_CG);
                  },
                  [&](OpenCvModel& m) {
                    m.R_CF = m.R_CF * R_GF.transpose();
                    m.t_CF -= m.R_CF * t_GF;
                  }},
             model.lens);
  return model;
}

CameraModel InUnit(CameraModel model, double unit_m) {
  const double factor = model.unit_m / unit_m;
  std::visit(Each{[&](CahvorModel& m) { Scale(m, factor); },
                  [&](CahvoreModel& m) {
                    Scale(m.base, factor);
                    m.E *= factor;
                  },
                  [&](TsaiModel& m) {
                    for (double* length : {&m.dx, &m.dy, &m.dpx, &m.dpy, &m.f}) {
                      *length *= factor;
                    }
                    m.T *= factor;
                    m.kappa1 /= factor * factor;
                  },
                  [&](OpenCvModel& m) { m.t_CF *= factor; }},
             model.lens);
  model.unit_m = unit_m;
  return model;
}

std::string FamilyOf(const CameraModel& model) {
  return std::visit(
      Each{[](const CahvorModel& m) -> std::string { return IsLinear(m) ? "CAHV" : "CAHVOR"; },
           [](const CahvoreModel& m) -> std::string {
             if (m.linearity == 1) {
               return "CAHVORE type 1 (perspective)";
             }
             if (m.linearity == 0) {
               return "CAHVORE type 2 (fisheye)";
             }
             char text[64];
             std::snprintf(text, sizeof text, "CAHVORE type 3, linearity %g", m.linearity);
             return text;
           },
           [](const TsaiModel&) -> std::string { return "Tsai"; },
           [](const OpenCvModel& m) -> std::string {
             if (m.lens == OpenCvLens::kFisheye) {
               return "fisheye (equidistant)";
             }
             return m.coefficients == 0 ? "pinhole" : "OpenCV " + std::to_string(m.coefficients);
           }},
      model.lens);
}

}  // namespace palace
