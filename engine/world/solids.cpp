#include "engine/world/solids.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "engine/core/check.h"

namespace palace {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kSides = 24;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Points where three faces meet inside all others.
std::vector<Vector3d> CornersOf(const std::vector<HalfSpace>& faces) {
  constexpr double kOnFace_m = 1e-7;
  std::vector<Vector3d> corners;
  for (std::size_t a = 0; a < faces.size(); ++a) {
    for (std::size_t b = a + 1; b < faces.size(); ++b) {
      const Vector3d edge = faces[a].normal.cross(faces[b].normal);
      for (std::size_t c = b + 1; c < faces.size(); ++c) {
        const double volume = edge.dot(faces[c].normal);
        if (std::abs(volume) < 1e-9) {
          continue;
        }
        const Vector3d corner =
            (faces[a].offset * faces[b].normal.cross(faces[c].normal) +
             faces[b].offset * faces[c].normal.cross(faces[a].normal) + faces[c].offset * edge) /
            volume;
        const bool known = std::any_of(corners.begin(), corners.end(), [&](const Vector3d& other) {
          return (other - corner).squaredNorm() < kOnFace_m * kOnFace_m;
        });
        if (!known && std::all_of(faces.begin(), faces.end(), [&](const HalfSpace& face) {
              return face.normal.dot(corner) <= face.offset + kOnFace_m * face.normal.norm();
            })) {
          corners.push_back(corner);
        }
      }
    }
  }
  return corners;
}

/// Distance of flat sides from the axis, so that they lie as far inside the circle as their edges
/// lie outside.
double FlatSideRadius(double radius_m) {
  const double share = std::cos(std::numbers::pi / kSides);
  return radius_m * 2 * share / (1 + share);
}

/// Corners seen from above, around their convex hull (Andrew 1979).
std::vector<Vector2d> OutlineFromAbove(const Solid& solid) {
  std::vector<std::pair<double, double>> points;
  for (const Vector3d& corner : solid.corners) {
    points.emplace_back(corner.x(), corner.y());
  }
  std::sort(points.begin(), points.end());
  std::vector<Vector2d> outline;
  const auto turns_left = [&](const Vector2d& p) {
    const Vector2d along = outline.back() - outline[outline.size() - 2];
    const Vector2d on = p - outline.back();
    return along.x() * on.y() - along.y() * on.x() > 0;
  };
  for (const bool back : {false, true}) {
    const std::size_t kept = outline.size();
    for (const auto& [north, east] : points) {
      const Vector2d p(north, east);
      while (outline.size() >= kept + 2 && !turns_left(p)) {
        outline.pop_back();
      }
      outline.push_back(p);
    }
    outline.pop_back();
    if (!back) {
      std::reverse(points.begin(), points.end());
    }
  }
  return outline;
}

}  // namespace

Solid MakeSolid(std::vector<HalfSpace> faces) {
  Solid solid{std::move(faces)};
  solid.corners = CornersOf(solid.faces);
  PALACE_CHECK(!solid.corners.empty(), solid.faces.size());
  return solid;
}

Solid MakeBox(double north_m, double east_m, double size_north_m, double size_east_m,
              double height_m) {
  return MakeSolid({{{1, 0, 0}, north_m + size_north_m / 2},
                    {{-1, 0, 0}, -(north_m - size_north_m / 2)},
                    {{0, 1, 0}, east_m + size_east_m / 2},
                    {{0, -1, 0}, -(east_m - size_east_m / 2)},
                    {{0, 0, 1}, 0},
                    {{0, 0, -1}, height_m}});
}

Solid MakeWedge(double north_m, double east_m, double length_m, double width_m, double slope_rad) {
  const double foot_m = north_m - length_m / 2;
  const double rise = std::tan(slope_rad);
  std::vector<HalfSpace> faces = MakeBox(north_m, east_m, length_m, width_m, rise * length_m).faces;
  // Below the ramp: -z <= rise (x - foot).
  faces.push_back({{-rise, 0, -1}, -rise * foot_m});
  return MakeSolid(std::move(faces));
}

Solid MakeCone(double north_m, double east_m, double foot_radius_m, double top_radius_m,
               double height_m) {
  std::vector<HalfSpace> faces = {{{0, 0, 1}, 0}, {{0, 0, -1}, height_m}};
  const double foot = FlatSideRadius(foot_radius_m);
  const double shrink = (foot - FlatSideRadius(top_radius_m)) / height_m;  // per metre of height
  for (int i = 0; i < kSides; ++i) {
    const double azimuth = 2 * std::numbers::pi * i / kSides;
    const double north = std::cos(azimuth), east = std::sin(azimuth);
    // Distance from the axis <= foot - shrink * height, and height = -z.
    faces.push_back({{north, east, -shrink}, foot + north * north_m + east * east_m});
  }
  return MakeSolid(std::move(faces));
}

Solid MakeRod(const Vector3d& from_W, const Vector3d& to_W, double diameter_m) {
  constexpr int kRodSides = 8;
  const Vector3d along = (to_W - from_W).normalized();
  const Vector3d side = along.unitOrthogonal();
  const Vector3d up = along.cross(side);
  std::vector<HalfSpace> faces = {{along, along.dot(to_W)}, {-along, -along.dot(from_W)}};
  for (int i = 0; i < kRodSides; ++i) {
    const double angle = 2 * std::numbers::pi * i / kRodSides;
    const Vector3d normal = std::cos(angle) * side + std::sin(angle) * up;
    faces.push_back({normal, normal.dot(from_W) + diameter_m / 2});
  }
  return MakeSolid(std::move(faces));
}

std::vector<Solid> MakeTrafficCone(double north_m, double east_m, double height_m) {
  constexpr double kFootWidth = 0.5, kFootHeight = 0.05, kBodyWidth = 0.36, kTipWidth = 0.08;
  constexpr double kBlack = 45, kOrange = 150, kWhite = 225;
  constexpr double kCollarFrom = 0.6, kCollarTo = 0.85;  // of the height
  Solid foot = MakeBox(north_m, east_m, kFootWidth * height_m, kFootWidth * height_m,
                       kFootHeight * height_m);
  foot.tone_grey = kBlack;
  Solid body =
      MakeCone(north_m, east_m, kBodyWidth * height_m / 2, kTipWidth * height_m / 2, height_m);
  body.tone_grey = kOrange;
  // The collar is a slice of the body, a hair wider.
  Solid collar = MakeCone(north_m, east_m, kBodyWidth * height_m / 2 + 1e-3,
                          kTipWidth * height_m / 2 + 1e-3, height_m);
  collar.faces[0].offset = -kCollarFrom * height_m;
  collar.faces[1].offset = kCollarTo * height_m;
  collar = MakeSolid(std::move(collar.faces));
  collar.tone_grey = kWhite;
  return {foot, body, collar};
}

Solid Moved(const Solid& solid, double turn_rad, const Vector3d& shift_W) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(turn_rad, Vector3d::UnitZ()).toRotationMatrix();
  Solid moved;
  moved.tone_grey = solid.tone_grey;
  for (const HalfSpace& face : solid.faces) {
    const Vector3d normal = turn * face.normal;
    moved.faces.push_back({normal, face.offset + normal.dot(shift_W)});
  }
  for (const Vector3d& corner : solid.corners) {
    moved.corners.push_back(turn * corner + shift_W);
  }
  return moved;
}

double EnterSolid(const Solid& solid, const Vector3d& p, const Vector3d& r) {
  double enter = 0;
  double leave = kInfinity;
  for (const HalfSpace& face : solid.faces) {
    const double outside = face.normal.dot(p) - face.offset;
    const double rate = face.normal.dot(r);
    if (rate < 0) {
      enter = std::max(enter, -outside / rate);
    } else if (rate > 0) {
      leave = std::min(leave, -outside / rate);
    } else if (outside > 0) {
      return kInfinity;
    }
    if (enter >= leave) {
      return kInfinity;
    }
  }
  return enter;
}

double DistanceFromAbove(const Solid& solid, double north_m, double east_m) {
  const std::vector<Vector2d> outline = OutlineFromAbove(solid);
  const Vector2d p(north_m, east_m);
  double nearest = kInfinity;
  bool inside = true;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector2d& a = outline[i];
    const Vector2d along = outline[(i + 1) % outline.size()] - a;
    const Vector2d off = p - a;
    inside = inside && along.x() * off.y() - along.y() * off.x() >= 0;
    const double s = std::clamp(off.dot(along) / along.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (off - s * along).norm());
  }
  return inside && outline.size() > 2 ? 0 : nearest;
}

}  // namespace palace
