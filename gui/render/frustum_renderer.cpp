#include "gui/render/frustum_renderer.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "gui/render/vehicle_model.h"

namespace palace {
namespace {

constexpr double kFarthest_m = 80;
constexpr double kGridStep_m = 5;
constexpr double kGridReach_m = 60;
constexpr double kAboveGround_m = 0.04;  ///< rings float over the grain of the map
constexpr double kDiscRadius_m = 0.5;
constexpr int kRing = 64;

constexpr Rgba8 kWhite = RgbaFromHex(0xF2F5F8);
constexpr Rgba8 kBlack = RgbaFromHex(0x05070A, 230);

std::vector<Eigen::Vector3d> Circle(const Eigen::Vector3d& centre_W, double radius_m) {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i <= kRing; ++i) {
    const double angle = 2 * std::numbers::pi * i / kRing;
    points.push_back(centre_W + radius_m * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0));
  }
  return points;
}

void AddRing(LineBatch& batch, const View3dSite& site, double width_px, double rim_px) {
  const Eigen::Vector3d centre = site.p_WS - kAboveGround_m * Eigen::Vector3d::UnitZ();
  const std::vector<Eigen::Vector3d> ring = Circle(centre, site.clear_radius_m);
  batch.Polyline(ring, {kBlack, width_px + rim_px});
  batch.Polyline(ring, {kWhite, width_px});
}

/// A site that is not the selected one: a black disc with a white rim, as on the maps.
void AddDisc(LineBatch& batch, const View3dSite& site, double scale) {
  const Eigen::Vector3d centre = site.p_WS - kAboveGround_m * Eigen::Vector3d::UnitZ();
  const std::vector<Eigen::Vector3d> rim =
      Circle(centre, std::min(kDiscRadius_m, 0.3 * site.clear_radius_m));
  for (std::size_t i = 1; i < rim.size(); ++i) {
    batch.Triangle(centre, rim[i - 1], rim[i], kBlack);
  }
  batch.Polyline(rim, {kWhite, 1.6 * scale});
}

}  // namespace

std::vector<Eigen::Vector3d> FrustumFootprint(const PinholeCamera& camera,
                                              const RigidTransform& X_WC, double ground_height_m) {
  std::vector<Eigen::Vector3d> corners;
  const double xs[] = {-0.5, camera.width - 0.5, camera.width - 0.5, -0.5};
  const double ys[] = {-0.5, -0.5, camera.height - 0.5, camera.height - 0.5};
  for (int k = 0; k < 4; ++k) {
    const Eigen::Vector3d ray_C((xs[k] - camera.cx_px) / camera.fx_px,
                                (ys[k] - camera.cy_px) / camera.fy_px, 1);
    const Eigen::Vector3d ray_W = (X_WC.R * ray_C).normalized();
    const double drop_m = -ground_height_m - X_WC.p.z();
    double reach_m = kFarthest_m;
    if (ray_W.z() > 1e-3 && drop_m > 0) {
      reach_m = std::min(drop_m / ray_W.z(), kFarthest_m);
    }
    corners.push_back(X_WC.p + reach_m * ray_W);
  }
  return corners;
}

void AddGroundGrid(LineBatch& batch, const Eigen::Vector3d& centre_W, double ui_scale) {
  const double north0 = std::round(centre_W.x() / kGridStep_m) * kGridStep_m;
  const double east0 = std::round(centre_W.y() / kGridStep_m) * kGridStep_m;
  const int reach = static_cast<int>(kGridReach_m / kGridStep_m);
  // One piece per cell, so that each may fade by its own distance.
  const auto piece = [&](double n, double e, double dn, double de) {
    const double distance = std::hypot(n + dn / 2 - north0, e + de / 2 - east0);
    const double share = std::clamp(1.25 * (1 - distance / kGridReach_m), 0.0, 1.0);
    if (share > 0) {
      const Rgba8 colour = RgbaFromHex(0x2A323C, static_cast<std::uint8_t>(235 * share));
      batch.Line({n, e, centre_W.z()}, {n + dn, e + de, centre_W.z()}, {colour, ui_scale});
    }
  };
  for (int i = -reach; i <= reach; ++i) {
    for (int j = -reach; j < reach; ++j) {
      piece(north0 + kGridStep_m * i, east0 + kGridStep_m * j, 0, kGridStep_m);
      piece(north0 + kGridStep_m * j, east0 + kGridStep_m * i, kGridStep_m, 0);
    }
  }
}

void AddFrustum(LineBatch& batch, const View3dInput& input, double ground_height_m) {
  if (!input.X_WC || input.camera.width == 0) {
    return;
  }
  const Eigen::Vector3d apex = input.X_WC->p;
  std::vector<Eigen::Vector3d> foot =
      FrustumFootprint(input.camera, *input.X_WC, ground_height_m + kAboveGround_m);
  const Rgba8 fill = RgbaFromHex(0xAEB8C4, 13);  // two faces lie over each other: 10 % in all
  for (std::size_t k = 0; k < 4; ++k) {
    batch.Triangle(apex, foot[k], foot[(k + 1) % 4], fill);
  }
  for (const Eigen::Vector3d& corner : foot) {
    batch.Line(apex, corner, {RgbaFromHex(0x98A3AF, 225), 1.2 * input.ui_scale});
  }
  foot.push_back(foot.front());
  batch.Polyline(foot, {kWhite, 1.4 * input.ui_scale});
}

std::vector<View3dLabel> AddDropLine(LineBatch& batch, const View3dInput& input,
                                     double ground_height_m, double vehicle_size) {
  std::vector<View3dLabel> labels;
  if (!input.X_WB) {
    return labels;
  }
  const Eigen::Vector3d top = *input.X_WB * (vehicle_size * kSkidCentre_B);
  const double height_m = -top.z() - ground_height_m;
  if (!(height_m > 0.3)) {
    return labels;
  }
  const Eigen::Vector3d foot(top.x(), top.y(), -ground_height_m);
  const double scale = input.ui_scale;
  const Rgba8 grey = RgbaFromHex(0xC6CED7, 240);
  batch.Line(foot, top, {grey, 1.2 * scale, 5 * scale, 4 * scale});
  const double step_m = height_m > 12 ? 10 : height_m > 6 ? 5 : height_m > 2.2 ? 2 : 1;
  for (double tick_m = step_m; tick_m < height_m; tick_m += step_m) {
    const Eigen::Vector3d at = foot - tick_m * Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d pixel = batch.PixelFromPoint(at);
    if (pixel.z() == 0) {
      continue;
    }
    batch.ScreenTick(at, 5 * scale, {grey, 1.4 * scale});
    labels.push_back({pixel.head<2>().cast<float>(),
                      std::to_string(static_cast<int>(std::lround(tick_m))) + " m"});
  }
  return labels;
}

void AddPaths(LineBatch& batch, const View3dInput& input) {
  const auto widened = [](const std::vector<Eigen::Vector3f>& points) {
    std::vector<Eigen::Vector3d> wide;
    for (const Eigen::Vector3f& p : points) {
      wide.push_back(p.cast<double>());
    }
    return wide;
  };
  const double scale = input.ui_scale;
  batch.Polyline(widened(input.trail), {RgbaFromHex(0x5CB2FF), 2 * scale});
  batch.Polyline(widened(input.path), {kWhite, 1.6 * scale, 6 * scale, 4 * scale});
}

void AddSites(LineBatch& batch, const View3dInput& input) {
  const double scale = input.ui_scale;
  for (const View3dSite& site : input.other_sites) {
    AddDisc(batch, site, scale);
  }
  if (!input.site) {
    return;
  }
  const View3dSite& site = *input.site;
  AddRing(batch, site, 2 * scale, 2.5 * scale);
  const Eigen::Vector3d centre = site.p_WS - kAboveGround_m * Eigen::Vector3d::UnitZ();
  for (int k = 0; k < 4; ++k) {
    const double angle = std::numbers::pi / 2 * k;
    const Eigen::Vector3d out(std::cos(angle), std::sin(angle), 0);
    const Eigen::Vector3d from = centre + 0.25 * site.clear_radius_m * out;
    const Eigen::Vector3d to = centre + 0.68 * site.clear_radius_m * out;
    batch.Line(from, to, {kBlack, 4 * scale});
    batch.Line(from, to, {kWhite, 2 * scale});
  }
  if (input.site_commanded) {
    const std::vector<Eigen::Vector3d> dot = Circle(centre, 0.12 * site.clear_radius_m);
    for (std::size_t i = 1; i < dot.size(); ++i) {
      batch.Triangle(centre, dot[i - 1], dot[i], kWhite);
    }
  }
}

}  // namespace palace
