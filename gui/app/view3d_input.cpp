#include "gui/app/view3d_input.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "gui/panels/fly_panels.h"
#include "gui/render/map_scale.h"

namespace palace {
namespace {

constexpr std::size_t kTrailStride = 2;

void AddTrail(const EngineSnapshot& snapshot, View3dInput& input) {
  if (!snapshot.flight->history) {
    return;
  }
  const auto& samples = *snapshot.flight->history;
  for (std::size_t i = 0; i < samples.size(); i += kTrailStride) {
    if (samples[i].estimate_p_WB.allFinite()) {
      input.trail.push_back(samples[i].estimate_p_WB.cast<float>());
    }
  }
}

}  // namespace

View3dInput MakeView3dInput(const EngineSnapshot& snapshot, std::uint64_t highlighted,
                            double ui_scale) {
  View3dInput input;
  input.ui_scale = ui_scale;
  const TerrainDecision* decision = snapshot.terrain->Shown();
  if (decision) {
    input.elevation = decision->elevation;
    input.hazards = decision->hazards;
    input.safe_distance_max_m = kClearRadiiShown * decision->settings.lander.clear_radius_m();
  }
  // The picture and the range map of one moment belong together; between maps the newest serves.
  if (snapshot.sensors->left_rectified && snapshot.terrain->range) {
    input.picture = snapshot.sensors->left_rectified;
    input.picture_camera = snapshot.terrain->range->camera;
    input.picture_X_WC = snapshot.sensors->X_WC;
    input.camera = snapshot.terrain->range->camera;
    input.X_WC = snapshot.sensors->X_WC;
  }
  if (snapshot.sensors->pose) {
    RigidTransform X_WB = snapshot.sensors->pose->X_WB;
    const NavigationStatus& nav = snapshot.flight->navigation;
    if (nav.OnVision() && nav.vision.running) {
      X_WB.p = nav.InForce().estimate.p_WB;
    }
    input.X_WB = X_WB;
    input.rotor_diameter_m = snapshot.session->settings.slad.lander.rotor_diameter_m;
  }
  const LandingSite* shown = SiteInView(snapshot, highlighted);
  if (shown) {
    input.site = View3dSite{shown->p_WS, shown->clear_radius_m};
    input.ground_height_m = HeightFromDown(shown->p_WS.z());
    input.site_commanded = IsCommanded(snapshot.flight->mission);
    const std::vector<Eigen::Vector3d>& way_W = snapshot.flight->mission.way_W;
    if (!way_W.empty()) {
      std::transform(way_W.begin(), way_W.end(), std::back_inserter(input.path),
                     [](const Eigen::Vector3d& p_W) { return p_W.cast<float>(); });
    } else if (input.X_WB && !snapshot.flight->mission.approach) {
      input.path = {input.X_WB->p.cast<float>(), shown->p_WS.cast<float>()};
    }
  }
  const TerrainDecision* known = SitesInForce(snapshot);
  if (known && !snapshot.flight->mission.armed) {
    for (const LandingSite& site : known->selection.sites) {
      if (!shown || site.id != shown->id) {
        input.other_sites.push_back({site.p_WS, site.clear_radius_m});
      }
    }
  }
  AddTrail(snapshot, input);
  return input;
}

void FrameView3d(const View3dInput& input, OrbitCamera& camera) {
  if (!input.X_WB) {
    return;
  }
  const Eigen::Vector3d vehicle = input.X_WB->p;
  Eigen::Vector3d ground =
      input.site ? input.site->p_WS : Eigen::Vector3d(vehicle.x(), vehicle.y(), 0);
  double radius_m = 5;
  if (input.elevation) {
    const GridGeometry& g = input.elevation->geometry;
    ground.x() = (g.north_min_m + g.north_max_m()) / 2;
    ground.y() = (g.east_min_m + g.east_max_m()) / 2;
    radius_m = std::max(3.0, 0.5 * std::max(g.rows, g.cols) * g.cell_m);
  }
  // Where a way round to another side comes down is to be seen as the ground is; where a straight
  // one begins is near the vehicle.
  if (input.path.size() > 2) {
    const Eigen::Vector3d begins = input.path[1].cast<double>();
    if ((begins - vehicle).norm() > radius_m) {
      radius_m = std::max(radius_m, (begins - ground).head<2>().norm());
    }
  }
  camera.Frame(vehicle, ground, radius_m, EulerFromRotation(input.X_WB->R).yaw_rad);
}

}  // namespace palace
