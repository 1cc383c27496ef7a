// Where the vehicle is against the site: heights, distances, time left. In W (north, east, down),
// by the estimate in force, of the skid centre; NaN where something is not known.
#pragma once

#include <optional>
#include <vector>

#include "engine/flight/approach_plan.h"
#include "engine/flight/flight_path.h"
#include "engine/mission/mission_inputs.h"
#include "engine/mission/mission_memory.h"

namespace palace {

/// Metres above the armed site, up-positive; NaN when none is armed.
double HeightAboveSite(const MissionMemory& memory);

/// Below the commit height: the last verdict stands; pictures and maps may end here. A look commits
/// to nothing.
bool IsCommitted(const MissionMemory& memory);

/// The site, of its clear sides those alone whose way down, from where it begins, leads over ground
/// that was looked at (status.seen): what no camera saw may be a roof. As it is where nobody keeps
/// count of looks, or the vehicle's place is not known.
LandingSite OverSeenGround(const MissionMemory& memory, LandingSite site);

/// Freezes the approach of the armed site, once, as soon as the vehicle's place is known.
void PlanApproach(MissionMemory& memory);

/// The courses that the armed site may be approached on by the newest map, clockwise by where they
/// come from; the straight one where it was clear when it was judged last, from where the vehicle
/// is now. Empty: none is armed, or its approach not planned yet.
std::vector<ApproachCourse> CoursesOpen(const MissionMemory& memory);

/// Fills headings of the status, for the armed site on the newest map.
void PublishHeadings(MissionMemory& memory);

/// Plans the approach of the armed site on that course, which the next map judges.
void TurnTo(MissionMemory& memory, const ApproachCourse& course);

/// The vehicle flies round to where a turned approach begins, away from the site or past it: until
/// it is there and looks at the site nothing is tracked, and vision does not take over.
bool GoesRound(const MissionMemory& memory);

/// The way to the site: the approved one, else the one that would be approved, which is planned
/// anew here where none is armed: that needs the vehicle's place.
FlightPath PathTo(const MissionMemory& memory, const LandingSite& site);

/// The armed site, else the one that leads; null when there is none.
const LandingSite* SiteInQuestion(const MissionMemory& memory);

/// Fills height, distance, time left and the place on the path of the status, to that site. Returns
/// the way to it, so that it is planned once a step; empty where none is known.
std::optional<FlightPath> PublishGeometry(MissionMemory& memory);

/// How far the laser's spot lies from the map's height there, in metres.
double LaserMismatch(const MissionInputs& inputs);

/// Horizontal distance of skid centre and site, by the estimate; empty when unknown.
std::optional<double> TouchdownMiss(const MissionMemory& memory);
/// The same by the simulator's truth.
std::optional<double> TrueTouchdownMiss(const MissionMemory& memory, const MissionInputs& inputs);

}  // namespace palace
