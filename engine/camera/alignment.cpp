#include "engine/camera/alignment.h"

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "engine/camera/cahvor.h"
#include "engine/core/text.h"

namespace palace {
namespace {

constexpr double kSteepest_rad = 75 * std::numbers::pi / 180;  // 15 degrees off the image plane
// Beyond it the common image plane is too steep for both.
constexpr double kFarthestApart_rad = 2 * kSteepest_rad;

/// The image plane of a camera: unit normal, directions of rows and columns, and the pixel on the
/// normal. Rows and columns are perpendicular only if theta is -90 degrees; along a row y stays, so
/// the row direction is perpendicular to V', not along H'.
struct ImagePlane {
  Eigen::Vector3d normal;
  Eigen::Vector3d row;
  Eigen::Vector3d column;
  Eigen::Vector2d centre;
};

ImagePlane PlaneOf(const CameraModel& camera) {
  const CahvorModel linear = LinearPartOf(camera);
  Eigen::Matrix3d pixel_from_ray;
  pixel_from_ray << linear.H.transpose(), linear.V.transpose(), linear.A.transpose();
  const Eigen::Matrix3d ray_from_pixel = pixel_from_ray.inverse();
  return {linear.A,
          ray_from_pixel.col(0).normalized(),
          ray_from_pixel.col(1).normalized(),
          {linear.A.dot(linear.H), linear.A.dot(linear.V)}};
}

/// A side of the picture, and the directions of the new picture it is measured by.
struct Side {
  Eigen::Vector3d normal;
  Eigen::Vector3d outward;  ///< along rows or columns, towards the side
  Eigen::Vector3d other;    ///< the other of the two
  std::array<Eigen::Vector2d, 2> corners;
  Eigen::Vector2d middle;  ///< opposite the image centre
};

/// Tangent of the side's limiting ray along `outward`.
Result<double> LimitOf(const CameraModel& camera, const Side& side, FieldOfView field) {
  // Rays are first moved along `other` into the plane of normal and outward. The two directions may
  // be oblique: `across` is perpendicular to outward, `sine` the sine between them.
  Eigen::Vector3d across = side.normal.cross(side.outward).normalized();
  if (across.dot(side.other) < 0) {
    across = -across;
  }
  const double sine = side.outward.cross(side.other).norm();
  std::array<Eigen::Vector2d, 3> pixels = {side.corners[0], side.corners[1], side.middle};
  const bool middle_is_on_side = (side.middle.array() >= side.corners[0].array()).all() &&
                                 (side.middle.array() <= side.corners[1].array()).all();
  double limit = 0;
  for (std::size_t i = 0; i < (middle_is_on_side ? 3U : 2U); ++i) {
    const auto ray = RayFromPixelCamera(camera, pixels[i]);
    if (!ray) {
      return InvalidError("the border pixel (" + std::to_string(pixels[i].x()) + ", " +
                          std::to_string(pixels[i].y()) +
                          ") lies beyond the range of the lens model; correct the model or cut the "
                          "picture");
    }
    const Eigen::Vector3d& u = ray->direction;
    const double forward = u.dot(side.normal);
    const double sideways =
        u.dot(side.outward) - u.dot(across) / sine * side.other.dot(side.outward);
    const bool too_steep = !(forward >= std::cos(kSteepest_rad) * std::hypot(forward, sideways));
    const double tangent = too_steep ? std::tan(kSteepest_rad) : sideways / forward;
    const bool further = field == FieldOfView::kInside ? tangent < limit : tangent > limit;
    if (i == 0 || further) {
      limit = tangent;
    }
  }
  return limit;
}

/// Tangents of the new picture's borders, each counted towards its own side.
struct Extents {
  double left = 0;
  double right = 0;
  double top = 0;
  double bottom = 0;
};

Result<Extents> ExtentsOf(const CameraModel& camera, const Eigen::Vector3d& row,
                          const Eigen::Vector3d& column, const Eigen::Vector3d& normal,
                          FieldOfView field) {
  const double right = WidthOf(camera) - 1;
  const double bottom = HeightOf(camera) - 1;
  const Eigen::Vector2d centre = PlaneOf(camera).centre;
  const Side sides[] = {
      {normal, -row, column, {{{0, 0}, {0, bottom}}}, {0, centre.y()}},
      {normal, row, column, {{{right, 0}, {right, bottom}}}, {right, centre.y()}},
      {normal, -column, row, {{{0, 0}, {right, 0}}}, {centre.x(), 0}},
      {normal, column, row, {{{0, bottom}, {right, bottom}}}, {centre.x(), bottom}}};
  Extents extents;
  double* const limits[] = {&extents.left, &extents.right, &extents.top, &extents.bottom};
  for (std::size_t i = 0; i < 4; ++i) {
    const auto limit = LimitOf(camera, sides[i], field);
    if (!limit) {
      return limit.error();
    }
    *limits[i] = *limit;
  }
  return extents;
}

/// CAHV with columns 0 and width - 1, rows 0 and height - 1 on the extents; `row` and `column` may
/// be oblique.
Result<CahvorModel> CahvFromExtents(const Eigen::Vector3d& centre, const Eigen::Vector3d& row,
                                    const Eigen::Vector3d& column, const Eigen::Vector3d& normal,
                                    const Extents& extents, const PictureSize& size) {
  CahvorModel model;
  model.width = size.width;
  model.height = size.height;
  model.C = centre;
  model.A = row.cross(column).normalized();
  if (model.A.dot(normal) < 0) {
    model.A = -model.A;
  }
  model.O = model.A;
  const double across = extents.left + extents.right;
  const double down = extents.top + extents.bottom;
  if (!(across > 0) || !(down > 0) || !std::isfinite(across + down)) {
    return InvalidError("the views do not overlap");
  }
  // x stays along columns and y along rows: H' is perpendicular to the columns, V' to the rows.
  const auto solve = [&](const Eigen::Vector3d& along, const Eigen::Vector3d& other, double near,
                         double extent, int pixels) {
    const Eigen::Vector3d gradient = (along - along.dot(other) * other).normalized();
    const double scale = (pixels - 1) / (along.dot(gradient) * extent);
    const double at_axis = near * scale * along.dot(gradient);
    return Eigen::Vector3d(scale * gradient + at_axis * model.A);
  };
  model.H = solve(row, column, extents.left, across, size.width);
  model.V = solve(column, row, extents.top, down, size.height);
  return model;
}

Status CheckSize(const CameraModel& camera, const char* which) {
  if (WidthOf(camera) < 2 || HeightOf(camera) < 2) {
    return InvalidError(std::string(which) +
                        "camera model tells no picture size of 2 x 2 px or "
                        "more; add a Dimensions line or give --size");
  }
  return Ok();
}

PictureSize SizeOr(PictureSize size, const CameraModel& camera) {
  return {size.width > 0 ? size.width : WidthOf(camera),
          size.height > 0 ? size.height : HeightOf(camera)};
}

/// JPL's rule for linear models: mean scales and centres on axes as in kNormals.
AlignedPair Average(const CameraModel& left, const CameraModel& right, const PictureSize& size) {
  const CahvorModel a = LinearPartOf(left);
  const CahvorModel b = LinearPartOf(right);
  const CahvInternals of_a = InternalsOf(a);
  const CahvInternals of_b = InternalsOf(b);
  Eigen::Vector3d row = (b.C - a.C).normalized();
  if (!(row.dot(a.H) > 0)) {
    row = -row;
  }
  const Eigen::Vector3d mean = (a.A + b.A) / 2;
  CahvorModel model;
  model.width = size.width;
  model.height = size.height;
  model.A = (mean - mean.dot(row) * row).normalized();
  model.O = model.A;
  model.H = (of_a.hs_px + of_b.hs_px) / 2 * row + (of_a.hc_px + of_b.hc_px) / 2 * model.A;
  model.V =
      (of_a.vs_px + of_b.vs_px) / 2 * model.A.cross(row) + (of_a.vc_px + of_b.vc_px) / 2 * model.A;
  AlignedPair pair{model, model};
  pair.left.C = a.C;
  pair.right.C = b.C;
  return pair;
}

}  // namespace

Result<CahvorModel> LinearizeCamera(const CameraModel& camera, FieldOfView field,
                                    PictureSize size) {
  if (Status status = CheckSize(camera, "the "); !status) {
    return status.error();
  }
  const ImagePlane plane = PlaneOf(camera);
  const auto extents = ExtentsOf(camera, plane.row, plane.column, plane.normal, field);
  if (!extents) {
    return extents.error();
  }
  return CahvFromExtents(CentreOf(camera), plane.row, plane.column, plane.normal, *extents,
                         SizeOr(size, camera));
}

Result<AlignedPair> AlignPair(const CameraModel& left, const CameraModel& right,
                              const AlignmentOptions& options) {
  if (options.form != AlignmentForm::kAverage) {
    for (const Status& status : {CheckSize(left, "the left "), CheckSize(right, "the right ")}) {
      if (!status) {
        return status.error();
      }
    }
  }
  const Eigen::Vector3d baseline = CentreOf(right) - CentreOf(left);
  if (!(baseline.norm() > 0) || !baseline.allFinite()) {
    return InvalidError("the two cameras stand in one place; a stereo pair needs a baseline");
  }
  const ImagePlane a = PlaneOf(left);
  const ImagePlane b = PlaneOf(right);
  const double apart_rad = std::atan2(a.normal.cross(b.normal).norm(), a.normal.dot(b.normal));
  if (!(apart_rad <= kFarthestApart_rad)) {
    return InvalidError(WithNumbers(
        "the cameras look in nearly opposite directions: their axes are %.1f degrees apart, the "
        "limit is %.0f; are both poses told in one frame?",
        apart_rad * 180 / std::numbers::pi, kFarthestApart_rad * 180 / std::numbers::pi));
  }
  const Eigen::Vector3d mean_normal = a.normal + b.normal;
  if (!(mean_normal.cross(baseline.normalized()).norm() > 1e-6)) {
    return InvalidError("the cameras look along their baseline; such a pair has no common rows");
  }
  const PictureSize size = SizeOr(options.size, left);
  if (options.form == AlignmentForm::kAverage) {
    return Average(left, right, size);
  }
  Eigen::Vector3d row = baseline.normalized();
  Eigen::Vector3d column;
  Eigen::Vector3d normal;
  // A "right" camera on the left side: rows still point right in the picture.
  if (options.form == AlignmentForm::kNormals) {
    row = row.dot(a.row + b.row) < 0 ? Eigen::Vector3d(-row) : row;
    normal = row.cross(mean_normal).cross(row).normalized();
    column = row.cross(normal).normalized();
    column = column.dot(a.column + b.column) < 0 ? Eigen::Vector3d(-column) : column;
  } else {
    row = row.dot(a.row) < 0 ? Eigen::Vector3d(-row) : row;
    column = row.cross(a.column + b.column).cross(row).normalized();
    normal = row.cross(column).normalized();
    normal = normal.dot(a.normal) < 0 ? Eigen::Vector3d(-normal) : normal;
  }
  const auto of_left = ExtentsOf(left, row, column, normal, options.field);
  if (!of_left) {
    return InvalidError("left camera: " + of_left.error().message);
  }
  const auto of_right = ExtentsOf(right, row, column, normal, options.field);
  if (!of_right) {
    return InvalidError("right camera: " + of_right.error().message);
  }
  const auto common = [&](double x, double y) {
    return options.field == FieldOfView::kInside ? std::min(x, y) : std::max(x, y);
  };
  const Extents extents = {
      common(of_left->left, of_right->left), common(of_left->right, of_right->right),
      common(of_left->top, of_right->top), common(of_left->bottom, of_right->bottom)};
  const auto model = CahvFromExtents(CentreOf(left), row, column, normal, extents, size);
  if (!model) {
    return InvalidError("the two cameras cannot be aligned: " + model.error().message);
  }
  AlignedPair pair{*model, *model};
  pair.right.C = CentreOf(right);
  return pair;
}

double WorstRowError(const AlignedPair& pair) {
  const double baseline = (pair.right.C - pair.left.C).norm();
  double worst = 0;
  for (int i = 0; i <= 20; ++i) {
    for (int j = 0; j <= 20; ++j) {
      const auto ray = RayFromPixelCahvor(
          pair.left, {i * (pair.left.width - 1) / 20.0, j * (pair.left.height - 1) / 20.0});
      for (const double range : {2.0, 20.0, 200.0}) {
        const Eigen::Vector3d p = ray->origin + range * baseline * ray->direction;
        const auto a = ProjectCahvor(pair.left, p);
        const auto b = ProjectCahvor(pair.right, p);
        if (a && b) {
          worst = std::max(worst, std::abs(a->y() - b->y()));
        }
      }
    }
  }
  return worst;
}

}  // namespace palace
