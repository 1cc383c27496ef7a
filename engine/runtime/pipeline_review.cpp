// Review: the site that the flight chose, under the limits in force.
#include <cmath>

#include "engine/model/mission/fault_events.h"
#include "engine/runtime/pipeline.h"
#include "engine/runtime/pipeline_pass.h"
#include "engine/runtime/recorded_names.h"
#include "engine/runtime/site_review.h"

namespace palace {

std::shared_ptr<const TerrainDecision> Pipeline::DecisionUnder(const Settings& settings,
                                                               Letters letters) {
  std::shared_ptr<const TerrainDecision> decision = slad_.Decide(settings, letters);
  const RecordedProposal* proposal =
      SeenFromStart(role_) ? nullptr : mission_of_record_.ProposalAt(decision->map_time);
  if (proposal == nullptr) {
    return decision;
  }
  const Settings* of_flight = mission_of_record_.SettingsAt(decision->map_time);
  return NamedByRecord(std::move(decision), *proposal,
                       of_flight != nullptr && settings.slad == of_flight->slad);
}

std::shared_ptr<const std::vector<Event>> Pipeline::EventsAt(Timestamp time) {
  auto recorded = FollowsRecord(role_) ? mission_of_record_.EventsUntil(time) : nullptr;
  return recorded ? recorded : mission_.SharedEvents();
}

void Pipeline::NoteSimulation(const Pass& pass) {
  const FrameBundle& bundle = *pass.bundle;
  for (const Event& event : FaultEvents(injected_faults_, bundle.injected_faults, bundle.time)) {
    mission_.AddEvent(event.time, event.kind, event.text);
  }
  injected_faults_ = bundle.injected_faults;
  if (const auto& simulation = pass.session.source.simulation) {
    for (const std::string& change : setup_changes_.Note(simulation->in_force, bundle.time)) {
      mission_.AddEvent(bundle.time, EventKind::kSetting, "Simulation: " + change);
    }
  }
}

void Pipeline::Redecide(Pass& pass) {
  TerrainPart& terrain = pass.snapshot->terrain.Edit();
  // A map that holds fewer frames than it held in flight says nothing of the flight.
  if (terrain.recorded && terrain.applied && (pass.new_map || pass.settings_moved) &&
      maps_to_rebuild_ == 0) {
    redecisions_.Add(
        CompareDecisions(terrain.applied->map_time, *terrain.recorded, *terrain.applied),
        from_start_);
  }
  terrain.redecided = redecisions_.Publish();
}

void Pipeline::Review(Pass& pass) {
  Redecide(pass);
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
