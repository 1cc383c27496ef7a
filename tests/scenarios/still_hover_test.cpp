// A hover over ground that does not move: what an operator looks at stands still.
#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "engine/runtime/engine.h"
#include "engine/simulation/session.h"
#include "gui/platform/offscreen_scene_camera.h"

namespace palace {
namespace {

/// What changed on the screen, map by map.
struct Unrest {
  int best_changes = 0, falls_to_search = 0, verdict_changes = 0, moved_places = 0;
  double farthest_m = 0;  ///< that a letter was from where it was first
  std::set<std::string> letters;
};

class Watcher {
 public:
  void See(const EngineSnapshot& snapshot) {
    const MissionState state = snapshot.flight->mission.state;
    unrest.falls_to_search += last_ == MissionState::kProposed && state != last_ ? 1 : 0;
    last_ = state;
    if (!snapshot.terrain->applied || snapshot.terrain->applied == map_) {
      return;
    }
    map_ = snapshot.terrain->applied;
    const std::vector<LandingSite>& sites = map_->selection.sites;
    const std::string best = sites.empty() ? "none" : sites.front().letter;
    unrest.best_changes += !best_.empty() && best != best_ ? 1 : 0;
    best_ = best;
    for (const LandingSite& site : sites) {
      unrest.letters.insert(site.letter);
      const auto [seen, is_new] = seen_.try_emplace(site.letter, site);
      unrest.verdict_changes += seen->second.confirmed != site.confirmed ? 1 : 0;
      unrest.moved_places += seen->second.p_WS.head<2>() != site.p_WS.head<2>() ? 1 : 0;
      seen->second = site;
      const auto first = first_.try_emplace(site.letter, site.p_WS.head<2>()).first->second;
      unrest.farthest_m = std::max(unrest.farthest_m, (site.p_WS.head<2>() - first).norm());
    }
  }

  Unrest unrest;

 private:
  MissionState last_ = MissionState::kNoLive;
  std::shared_ptr<const TerrainDecision> map_;
  std::string best_;
  std::map<std::string, LandingSite> seen_;
  std::map<std::string, Eigen::Vector2d> first_;
};

// Seed 1 has two maps with a false cell near the map's lower edge within ten seconds. Before sites
// were steady over maps it changed its best site four times in this half minute and 75 times in
// 230 s, fell nine times to SEARCH, and ring A wandered 1.5 m.
TEST(StillHover, HardlyMovesARingAndHardlyChangesTheBestSite) {
  constexpr double kHover_s = 30;
  const SimulatedSession session =
      OpenSimulatedSession({.seed = 1, .duration_limit_s = kHover_s}, MakeOffscreenSceneCamera)
          .value();
  EngineParts parts;
  parts.mission.session_id = session.id;
  parts.source = session.simulator;
  parts.link = session.simulator;
  Engine engine(std::move(parts), /*threaded=*/false);
  Watcher watcher;
  while (engine.Step()) {
    watcher.See(*engine.Latest());
  }
  EXPECT_EQ(engine.error(), "");
  const Unrest& unrest = watcher.unrest;
  EXPECT_LE(unrest.best_changes, 1);
  EXPECT_EQ(unrest.falls_to_search, 0);
  EXPECT_LE(unrest.moved_places, 2);  // under its letter, to a better point beside
  EXPECT_LE(unrest.farthest_m, SladSettings{}.choice.spacing_m / 4);
  EXPECT_LE(unrest.letters.size(), 10u);
  EXPECT_LE(unrest.verdict_changes, static_cast<int>(unrest.letters.size()));  // once confirmed
}

}  // namespace
}  // namespace palace
