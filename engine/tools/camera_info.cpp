#include "engine/tools/camera_info.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <optional>

#include "engine/camera/cahvor.h"
#include "engine/core/units.h"

namespace palace {
namespace {

std::string Line(const char* format, ...) __attribute__((format(printf, 1, 2)));
std::string Line(const char* format, ...) {
  std::array<char, 256> text{};
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text.data(), text.size(), format, arguments);
  va_end(arguments);
  return std::string(text.data()) + "\n";
}

/// Angle between the rays of two pixels, degrees.
std::optional<double> AngleBetween(const CameraModel& model, const Eigen::Vector2d& a,
                                   const Eigen::Vector2d& b) {
  const auto ray_a = RayFromPixelCamera(model, a);
  const auto ray_b = RayFromPixelCamera(model, b);
  if (!ray_a || !ray_b) {
    return std::nullopt;
  }
  return Deg(std::atan2(ray_a->direction.cross(ray_b->direction).norm(),
                        ray_a->direction.dot(ray_b->direction)));
}

/// A field of view through the middle of the picture: the two halves, which may pass 180 degrees.
std::string FieldText(const CameraModel& model, const Eigen::Vector2d& a,
                      const Eigen::Vector2d& b) {
  const Eigen::Vector2d middle = (a + b) / 2;
  const auto half_a = AngleBetween(model, a, middle);
  const auto half_b = AngleBetween(model, middle, b);
  if (!half_a || !half_b) {
    return "undefined, the border lies beyond the lens model";
  }
  const std::string text = Line("%.3f deg", *half_a + *half_b);
  return text.substr(0, text.size() - 1);
}

std::string FieldLines(const CameraModel& model) {
  const double w = WidthOf(model);
  const double h = HeightOf(model);
  const double x = (w - 1) / 2;
  const double y = (h - 1) / 2;
  return Line("field of view     horizontal %s, edge to edge",
              FieldText(model, {-0.5, y}, {w - 0.5, y}).c_str()) +
         Line("                  vertical   %s",
              FieldText(model, {x, -0.5}, {x, h - 0.5}).c_str()) +
         Line("                  diagonal   %s",
              FieldText(model, {-0.5, -0.5}, {w - 0.5, h - 0.5}).c_str());
}

/// How far the lens moves the corners' rays from where the linear part would put them.
std::string DistortionLines(const CameraModel& model) {
  const CameraModel linear{LinearPartOf(model)};
  const double right = WidthOf(model) - 1;
  const double bottom = HeightOf(model) - 1;
  std::string lines;
  for (const auto& [name, corner] : {std::pair{"top left", Eigen::Vector2d(0, 0)},
                                     {"top right", Eigen::Vector2d(right, 0)},
                                     {"bottom left", Eigen::Vector2d(0, bottom)},
                                     {"bottom right", Eigen::Vector2d(right, bottom)}}) {
    const char* label = lines.empty() ? "distortion" : "";
    const auto ray = RayFromPixelCamera(model, corner);
    const auto straight = ray ? ProjectDirection(linear, ray->direction) : std::nullopt;
    if (!ray) {
      lines += Line("%-18s%-13s no ray: beyond the lens model", label, name);
    } else if (!straight) {
      lines += Line("%-18s%-13s ray beyond 90 deg: no linear camera sees it", label, name);
    } else {
      const Eigen::Vector2d moved = corner - *straight;
      lines +=
          Line("%-18s%-13s %.4f px (%.4f, %.4f)", label, name, moved.norm(), moved.x(), moved.y());
    }
  }
  return lines;
}

std::string CoefficientLines(const CameraModel& model) {
  const auto vector = [](const char* name, const Eigen::Vector3d& v, const char* unit) {
    return Line("%-18s%.9g, %.9g, %.9g%s", name, v.x(), v.y(), v.z(), unit);
  };
  if (const auto* m = std::get_if<CahvorModel>(&model.lens)) {
    return IsLinear(*m) ? "" : vector("O, unit", m->O, "") + vector("R, no unit", m->R, "");
  }
  if (const auto* m = std::get_if<CahvoreModel>(&model.lens)) {
    return vector("O, unit", m->base.O, "") + vector("R, no unit", m->base.R, "") +
           vector("E", m->E, " m") + Line("linearity         %.9g", m->linearity);
  }
  if (const auto* m = std::get_if<TsaiModel>(&model.lens)) {
    return Line("f                 %.9g mm", m->f / (0.001 / model.unit_m)) +
           Line("kappa1            %.9g 1/mm^2", m->kappa1 * std::pow(0.001 / model.unit_m, 2)) +
           Line("sx                %.9g", m->sx);
  }
  const auto& m = std::get<OpenCvModel>(model.lens);
  std::string text = "coefficients      ";
  for (int i = 0; i < m.coefficients; ++i) {
    const std::string number = Line("%s%.9g", i == 0 ? "" : ", ", m.k[static_cast<std::size_t>(i)]);
    text += number.substr(0, number.size() - 1);
  }
  return text + (m.coefficients == 0 ? "none\n" : "\n");
}

}  // namespace

std::string CameraInfoText(const CameraModel& model) {
  const CahvorModel linear = LinearPartOf(model);
  const CahvInternals internals = InternalsOf(linear);
  const Eigen::Vector3d centre_m = CentreOf(model) * model.unit_m;
  std::string text = Line("family            %s", FamilyOf(model).c_str());
  text += HasSize(model) ? Line("size              %d x %d px", WidthOf(model), HeightOf(model))
                         : "size              not told by the file; give --size WIDTHxHEIGHT\n";
  text += Line("unit of length    %s", model.unit_m == 1 ? "m" : "mm");
  text += Line("focal length      hs %.6f px, vs %.6f px", internals.hs_px, internals.vs_px);
  text += Line("image centre      hc %.6f px, vc %.6f px", internals.hc_px, internals.vc_px);
  text += Line("theta             %.6f deg (row shear %.6f px)", Deg(internals.theta_rad),
               PinholeFromCahv(linear).shear_px);
  text += CoefficientLines(model);
  if (HasSize(model)) {
    text += FieldLines(model) + DistortionLines(model);
  }
  text +=
      model.pose_is_known
          ? Line("centre            %.9g, %.9g, %.9g m", centre_m.x(), centre_m.y(), centre_m.z()) +
                Line("axis, unit        %.9g, %.9g, %.9g", linear.A.x(), linear.A.y(), linear.A.z())
          : "pose              not told by the file; its frame is the camera itself\n";
  return text;
}

}  // namespace palace
