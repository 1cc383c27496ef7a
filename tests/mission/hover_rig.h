// A vehicle that hovers, and is sent to other hovers.
#pragma once

#include <memory>
#include <string>

#include "engine/camera/pinhole.h"
#include "tests/mission/mission_rig.h"

namespace palace {

/// Hovers 20 m high at 9.5 m north, 2 m east of W, over flat ground that a map shows.
struct HoverRig : MissionRig {
  HoverRig() {
    auto map = std::make_shared<ElevationMap>();
    map->geometry = {120, 120, 0.5, -30, -30};
    map->height_m = GridF(120, 120, 0.0F);
    map->variance_m2 = GridF(120, 120, 1e-4F);
    map->state = Grid<CellState>(120, 120, CellState::kMeasured);
    map->frame_count = Grid<std::uint16_t>(120, 120, 1);
    elevation = map;
    decision.elevation = map;
    auto cameras = std::make_shared<StereoRig>();
    cameras->left.pinhole = cameras->right.pinhole = PinholeFromFov(640, 480, Rad(60));
    cameras->tilt_rad = -Rad(45);
    camera_rig = cameras;
    RunUntil(MissionState::kProposed);
  }
  Status Fly(const Eigen::Vector3d& way, double heading_rad,
             CommandOrigin origin = CommandOrigin::kOperator) {
    return Do(FlyTo{p_WB() + way, heading_rad}, origin);
  }
  const MissionStatus& status() const { return mission.status(); }
  std::string LastDecision() const {
    std::string last;
    for (const Event& event : mission.events()) {
      last = event.kind == EventKind::kDecision ? event.text : last;
    }
    return last;
  }
  std::shared_ptr<ElevationMap> elevation;
};

}  // namespace palace
