#include "engine/model/mission/fly_area.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/frames.h"
#include "engine/core/text.h"

namespace palace {
namespace {

constexpr double kSample_m = 0.25;  // along a way

double Cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

double FromSegment(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const Eigen::Vector2d along = b - a;
  const double length2 = along.squaredNorm();
  const double s = length2 > 0 ? std::clamp((p - a).dot(along) / length2, 0.0, 1.0) : 0.0;
  return (p - a - s * along).norm();
}

bool Touch(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
           const Eigen::Vector2d& d) {
  const double abc = Cross(b - a, c - a), abd = Cross(b - a, d - a);
  const double cda = Cross(d - c, a - c), cdb = Cross(d - c, b - c);
  if (abc * abd < 0 && cda * cdb < 0) {
    return true;
  }
  const double least = std::min(
      {FromSegment(a, c, d), FromSegment(b, c, d), FromSegment(c, a, b), FromSegment(d, a, b)});
  return least < 1e-9;
}

bool EdgesCross(const std::vector<Eigen::Vector2d>& corners) {
  const std::size_t n = corners.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = i + 2; k < n; ++k) {
      const bool neighbours = i == 0 && k == n - 1;  // they share a corner
      if (!neighbours &&
          Touch(corners[i], corners[(i + 1) % n], corners[k], corners[(k + 1) % n])) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace

std::string WhyNoArea(const FlyArea& area) {
  const std::size_t n = area.corners_W.size();
  if (n < FlyArea::kFewestCorners || n > FlyArea::kMostCorners) {
    return "An area has " + std::to_string(FlyArea::kFewestCorners) + " to " +
           std::to_string(FlyArea::kMostCorners) + " corners, not " + std::to_string(n);
  }
  for (const Eigen::Vector2d& corner : area.corners_W) {
    if (!(corner.norm() <= FlyArea::kFarthest_m)) {
      return WithNumbers("A corner lies more than %.0f m from where the flight began, or nowhere",
                         FlyArea::kFarthest_m);
    }
  }
  if (!(std::abs(area.ceiling_m) <= FlyArea::kFarthest_m)) {
    return WithNumbers("The ceiling is %.0f m, limit %.0f m", area.ceiling_m, FlyArea::kFarthest_m);
  }
  if (EdgesCross(area.corners_W)) {
    return "Its edges cross";
  }
  const double size_m2 = AreaOf_m2(area);
  return size_m2 < FlyArea::kLeast_m2
             ? WithNumbers("It is %.0f m² large, min %.0f m²", size_m2, FlyArea::kLeast_m2)
             : "";
}

double AreaOf_m2(const FlyArea& area) {
  double twice = 0;
  const std::size_t n = area.corners_W.size();
  for (std::size_t i = 0; i < n; ++i) {
    twice += Cross(area.corners_W[i], area.corners_W[(i + 1) % n]);
  }
  return std::abs(twice) / 2;
}

bool IsInside(const FlyArea& area, const Eigen::Vector2d& p) {
  bool inside = false;  // by how often a line to the east meets the edge
  const std::size_t n = area.corners_W.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector2d &a = area.corners_W[i], &b = area.corners_W[(i + 1) % n];
    if ((a.x() > p.x()) != (b.x() > p.x())) {
      const double east = a.y() + (p.x() - a.x()) / (b.x() - a.x()) * (b.y() - a.y());
      inside = inside != (p.y() < east);
    }
  }
  return inside || ToEdge_m(area, p) < 1e-9;
}

double ToEdge_m(const FlyArea& area, const Eigen::Vector2d& p) {
  double least = std::numeric_limits<double>::infinity();
  const std::size_t n = area.corners_W.size();
  for (std::size_t i = 0; i < n; ++i) {
    least = std::min(least, FromSegment(p, area.corners_W[i], area.corners_W[(i + 1) % n]));
  }
  return least;
}

double LeavesBy_m(const FlyArea& area, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  const int steps = std::max(1, static_cast<int>(std::ceil((to - from).norm() / kSample_m)));
  double most = 0;
  bool was_inside = false;
  for (int k = 0; k <= steps; ++k) {
    const Eigen::Vector2d at = from + static_cast<double>(k) / steps * (to - from);
    const bool inside = IsInside(area, at);
    was_inside = was_inside || inside;
    if (!inside && (was_inside || k == steps)) {
      most = std::max(most, ToEdge_m(area, at));
    }
  }
  return most;
}

std::string OutsideWords(const FlyArea& area, const Eigen::Vector3d& p_WB) {
  std::string out, over;
  if (!IsInside(area, p_WB.head<2>())) {
    out = WithNumbers("%.1f m outside the area", ToEdge_m(area, p_WB.head<2>()));
  }
  const double height_m = HeightFromDown(p_WB.z());
  if (height_m > area.ceiling_m) {
    over = WithNumbers("%.1f m above its ceiling", height_m - area.ceiling_m);
  }
  return out + (out.empty() || over.empty() ? "" : " and ") + over;
}

}  // namespace palace
