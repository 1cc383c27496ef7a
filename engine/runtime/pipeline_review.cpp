// Review: the site that the flight chose, under the limits in force.
#include <cmath>

#include "engine/runtime/pipeline.h"
#include "engine/runtime/pipeline_pass.h"
#include "engine/runtime/site_review.h"

namespace palace {

void Pipeline::Review(Pass& pass) {
  EngineSnapshot& snapshot = *pass.snapshot;
  const TerrainDecision* flown =
      snapshot.recorded ? snapshot.recorded.get() : snapshot.applied.get();
  const LandingSite* site = snapshot.mission.armed ? &*snapshot.mission.armed
                            : flown != nullptr && !flown->selection.sites.empty()
                                ? &flown->selection.sites.front()
                                : nullptr;
  if (site == nullptr || !snapshot.applied || !terrain_.has_map()) {
    snapshot.site_review.reset();
    return;
  }
  const bool another = !snapshot.site_review || snapshot.site_review->letter != site->letter;
  if (pass.new_map || pass.settings_moved || another) {
    const Settings& settings = settings_.applied();
    const auto& approach = snapshot.mission.approach;
    snapshot.site_review = ReviewSite(*site,
                                      terrain_.Recheck(*snapshot.applied, *site, settings,
                                                       approach ? approach->heading_rad : NAN),
                                      settings.slad);
  }
}

}  // namespace palace
