#include "engine/experiments/ground_field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "engine/camera/pinhole.h"
#include "engine/world/ray_scene.h"

namespace palace {
namespace {

constexpr int kSamples = 2;            // rays a pixel, both ways: four
constexpr double kFinest_m = 0.01;     // of the ground's light
constexpr double kBeyondDisc_m = 1.5;  // so that slopes and steps at its rim are known
constexpr double kCoarse_m = 0.1, kEvery_m = 0.5;
constexpr int kRimPoints = 8;
constexpr double kFarthest_m = 60;

double FieldOfView(const PinholeCamera& camera) {
  return 2 * std::atan(camera.width / 2.0 / camera.fx_px);
}

HoverView HoverOf(const World& world, const ViewPlan& plan, double pose_errors) {
  HoverView view;
  view.ground_height_m = GroundSeen(world, plan);
  view.height_m = view.ground_height_m + plan.height_m;
  view.tilt_rad = plan.tilt_rad;
  view.field_of_view_rad = FieldOfView(plan.camera);
  view.width_px = plan.camera.width;
  view.height_px = plan.camera.height;
  view.baseline_m = plan.baseline_m;
  view.attitude_error_rad = pose_errors * plan.attitude_error_rad;
  view.position_error_m = pose_errors * plan.position_error_m;
  return view;
}

/// The middle, a ring half-way out and one at the rim of the navigation error.
std::vector<Eigen::Vector2d> Touchdowns(const Eigen::Vector2d& place_m, double nav_error_m) {
  std::vector<Eigen::Vector2d> places = {place_m};
  for (const double radius_m : {nav_error_m / 2, nav_error_m}) {
    for (int k = 0; k < kRimPoints; ++k) {
      const double turn = 2 * std::numbers::pi * k / kRimPoints;
      places.push_back(place_m + radius_m * Eigen::Vector2d(std::cos(turn), std::sin(turn)));
    }
  }
  return places;
}

SiteTruth TruthOfTouchdown(const DiscTruth& disc, const TruthLimits& limits) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  if (!disc.known) {
    return {kNever, "unknown"};
  }
  if (disc.water_share > 0) {
    return {kNever, "water"};
  }
  if (disc.moving_share > 0) {
    return {kNever, "moving"};
  }
  SiteTruth worst{disc.slope_deg / limits.slope_deg, "slope"};
  for (const SiteTruth& other : {SiteTruth{disc.deviation_m / limits.deviation_m, "deviation"},
                                 SiteTruth{disc.step_m / limits.step_m, "step"}}) {
    worst = other.worst_of_limit > worst.worst_of_limit ? other : worst;
  }
  return worst;
}

/// Every point of the disc's rim, at its own ground, lies in the pictures of both cameras.
bool InBothPictures(const World& world, const ViewPlan& plan, const RigidTransform& X_WC,
                    const Eigen::Vector2d& place_m, double radius_m) {
  for (int k = 0; k < kRimPoints; ++k) {
    const double turn = 2 * std::numbers::pi * k / kRimPoints;
    const double north_m = place_m.x() + radius_m * std::cos(turn),
                 east_m = place_m.y() + radius_m * std::sin(turn);
    const Eigen::Vector3d p_C =
        X_WC.Inverse() * Eigen::Vector3d(north_m, east_m, -SurfaceHeight(world, north_m, east_m));
    for (const double shift_m : {0.0, plan.baseline_m}) {
      const auto pixel = ProjectPinhole(plan.camera, p_C - shift_m * Eigen::Vector3d::UnitX());
      if (!pixel || !InPicture(plan.camera, *pixel)) {
        return false;
      }
    }
  }
  return true;
}

/// Of level ground that the pictures show, no farther than kFarthest_m.
TruthArea AreaInView(const ViewPlan& plan, double ground_m) {
  const RigidTransform X_WC = plan.X_WC(ground_m);
  TruthArea area{
      .north_min_m = 0, .north_max_m = 0, .east_min_m = 0, .east_max_m = 0, .cell_m = kCoarse_m};
  for (const double x : {0.0, plan.camera.width - 1.0}) {
    for (const double y : {0.0, plan.camera.height - 1.0}) {
      const Eigen::Vector3d ray_W = X_WC.R * RayFromPixel(plan.camera, {x, y});
      const double s = ray_W.z() > 1e-3 ? plan.height_m / ray_W.z() : kFarthest_m;
      const Eigen::Vector2d shift_m = s * ray_W.head<2>();
      area.north_min_m = std::min(area.north_min_m, std::max(-kFarthest_m, shift_m.x()));
      area.north_max_m = std::max(area.north_max_m, std::min(kFarthest_m, shift_m.x()));
      area.east_min_m = std::min(area.east_min_m, std::max(-kFarthest_m, shift_m.y()));
      area.east_max_m = std::max(area.east_max_m, std::min(kFarthest_m, shift_m.y()));
    }
  }
  return area;
}

}  // namespace

Result<std::vector<FieldFrame>> LookAtGround(const World& world, const ViewPlan& plan,
                                             double pose_errors, const StereoSettings& settings,
                                             std::uint64_t seed, KeptPictures kept) {
  std::optional<RayScene> scene;  // dear; kept pictures need none
  std::uint64_t exposures = 0;
  const auto take = [&](const RigidTransform& X_WCamera, bool right, double time_s) {
    // Noise of its own for each pair.
    exposures += right ? 0 : 1;
    return kept.Next(plan.camera.width, plan.camera.height, [&] {
      if (!scene) {
        scene.emplace(world, std::max(kFinest_m, plan.height_m / plan.camera.fx_px));
      }
      return ExposeAs(plan, scene->Grey(plan.camera, X_WCamera, kSamples, time_s), right,
                      1000 * seed + exposures);
    });
  };
  return LookFromHover(HoverOf(world, plan, pose_errors), plan.camera, take, settings, seed);
}

SiteTruth::Verdict SiteTruth::verdict() const {
  return worst_of_limit <= 1         ? Verdict::kWithin
         : worst_of_limit <= kUnsafe ? Verdict::kOver
         : worst_of_limit <= kGross  ? Verdict::kUnsafe
                                     : Verdict::kGrosslyUnsafe;
}

const char* SiteVerdictName(SiteTruth::Verdict verdict) {
  static constexpr const char* kNames[kSiteVerdictCount] = {"within", "over", "unsafe", "gross"};
  return kNames[static_cast<int>(verdict)];
}

SiteTruth TruthOfSite(const World& world, const Eigen::Vector2d& place_m, const Lander& lander,
                      const TruthLimits& limits, double time_s) {
  const double reach_m = lander.clear_radius_m() + kBeyondDisc_m;
  const GroundTruth truth = TruthOf(world,
                                    {.north_min_m = place_m.x() - reach_m,
                                     .north_max_m = place_m.x() + reach_m,
                                     .east_min_m = place_m.y() - reach_m,
                                     .east_max_m = place_m.y() + reach_m},
                                    time_s);
  SiteTruth worst;
  for (const Eigen::Vector2d& touchdown_m : Touchdowns(place_m, lander.nav_error_m)) {
    const SiteTruth one =
        TruthOfTouchdown(TruthOfDisc(truth, touchdown_m, lander.radius_m()), limits);
    worst = one.worst_of_limit > worst.worst_of_limit ? one : worst;
  }
  return worst;
}

bool SeenWhole(const World& world, const ViewPlan& plan, const Eigen::Vector2d& place_m,
               double radius_m) {
  return InBothPictures(world, plan, plan.X_WC(GroundSeen(world, plan)), place_m, radius_m);
}

bool SeesSafeDisc(const World& world, const ViewPlan& plan, double radius_m,
                  const TruthLimits& limits, double share) {
  const double ground_m = GroundSeen(world, plan);
  const SafePlaces places = FindSafePlaces(TruthOf(world, AreaInView(plan, ground_m)), radius_m,
                                           limits.Scaled(share), kEvery_m);
  const RigidTransform X_WC = plan.X_WC(ground_m);
  for (int row = 0; row < places.safe.rows(); ++row) {
    for (int col = 0; col < places.safe.cols(); ++col) {
      const Cell cell{row, col};
      if (places.safe.at(cell) != 0 &&
          InBothPictures(
              world, plan, X_WC,
              Eigen::Vector2d(places.geometry.NorthOfRow(row), places.geometry.EastOfCol(col)),
              radius_m)) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace palace
