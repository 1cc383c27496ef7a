// Review: the site that the flight chose, under the limits in force.
#include <cmath>

#include "engine/runtime/pipeline.h"
#include "engine/runtime/pipeline_pass.h"
#include "engine/runtime/site_review.h"

namespace palace {

void Pipeline::Review(Pass& pass) {
  EngineSnapshot& snapshot = *pass.snapshot;
  const TerrainDecision* flown = snapshot.terrain->OfRecord().get();
  const MissionStatus& mission = snapshot.flight->mission;
  const LandingSite* site = mission.armed      ? &*mission.armed
                            : flown != nullptr ? mission.BestStanding(flown->selection.sites)
                                               : nullptr;
  if (site == nullptr || !snapshot.terrain->applied || !slad_.has_map()) {
    snapshot.terrain.Edit().site_review.reset();
    return;
  }
  const bool another =
      !snapshot.terrain->site_review || snapshot.terrain->site_review->letter != site->letter;
  if (pass.new_map || pass.settings_moved || another) {
    const Settings& settings = settings_.applied();
    const auto& approach = snapshot.flight->mission.approach;
    snapshot.terrain.Edit().site_review =
        ReviewSite(*site,
                   slad_.Recheck(*snapshot.terrain->applied, *site, settings,
                                 approach ? approach->heading_rad : NAN),
                   settings.slad);
  }
}

}  // namespace palace
