#include "engine/camera/camera_info.h"

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

/// A component as a person reads it: no "-0".
double Plain(double value, int decimals) {
  return std::abs(value) < 0.5 * std::pow(10, -decimals) ? 0 : value;
}

/// Three numbers of nine digits.
std::string Triple(const Eigen::Vector3d& v) {
  const std::string text = Line("%.9g, %.9g, %.9g", v.x() + 0.0, v.y() + 0.0, v.z() + 0.0);
  return text.substr(0, text.size() - 1);
}

/// Share of the picture through whose pixels the model has no ray, on a grid that ends at its
/// border.
double ShareWithoutRay(const CameraModel& model) {
  constexpr int kCells = 32;
  int without = 0;
  for (int row = 0; row <= kCells; ++row) {
    for (int column = 0; column <= kCells; ++column) {
      const Eigen::Vector2d pixel(column * (WidthOf(model) - 1.0) / kCells,
                                  row * (HeightOf(model) - 1.0) / kCells);
      without += RayFromPixelCamera(model, pixel) ? 0 : 1;
    }
  }
  return without / double{(kCells + 1) * (kCells + 1)};
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

/// How far the lens moves a corner away from the image centre, as a share of the diagonal. Wide
/// lenses move corners inwards, by any amount; outwards real ones move them by a few per cent.
double OutwardShare(const CameraModel& model) {
  const CahvorModel linear = LinearPartOf(model);
  const CahvInternals internals = InternalsOf(linear);
  const Eigen::Vector2d size(WidthOf(model) - 1, HeightOf(model) - 1);
  double share = 0;
  for (const Eigen::Vector2d& corner : {Eigen::Vector2d(0, 0), size}) {
    const auto ray = RayFromPixelCamera(model, corner);
    const auto straight = ray ? ProjectDirection({linear}, ray->direction) : std::nullopt;
    const Eigen::Vector2d centre(internals.hc_px, internals.vc_px);
    if (straight) {
      const double outward = (corner - centre).norm() - (*straight - centre).norm();
      share = std::max(share, outward / size.norm());
    }
  }
  return share;
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
      lines += Line("%-18s%-13s %.4f px (%.4f, %.4f)", label, name, moved.norm(),
                    Plain(moved.x(), 4), Plain(moved.y(), 4));
    }
  }
  return lines;
}

std::string CoefficientLines(const CameraModel& model) {
  const auto vector = [](const char* name, const Eigen::Vector3d& v, const char* unit) {
    return Line("%-18s%s%s", name, Triple(v).c_str(), unit);
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
    const std::string number =
        Line("%s%.9g", i == 0 ? "" : ", ", m.k[static_cast<std::size_t>(i)] + 0.0);
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
  text += Line("theta             %.6f deg (row shear %.6f px)", Plain(Deg(internals.theta_rad), 6),
               Plain(PinholeFromCahv(linear).shear_px, 6));
  text += CoefficientLines(model);
  if (HasSize(model)) {
    text += FieldLines(model) + DistortionLines(model);
    if (const double share = ShareWithoutRay(model); share > 0) {
      text += Line(
          "warning           %.1f %% of the picture has no ray: beyond the lens model; is "
          "the distortion right?",
          100 * share);
    }
    constexpr double kLikelyOutward = 0.25;
    if (const double share = OutwardShare(model); share > kLikelyOutward) {
      text += Line(
          "warning           corners are moved outwards by %.0f %% of the diagonal, no real "
          "lens does; is the distortion right?",
          100 * share);
    }
  }
  text += model.pose_is_known
              ? Line("centre            %s m", Triple(centre_m).c_str()) +
                    Line("axis, unit        %s", Triple(linear.A).c_str())
              : "pose              not told by the file; its frame is the camera itself\n";
  return text;
}

}  // namespace palace
