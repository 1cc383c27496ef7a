// What the trackers of a site say side by side, in words: of the panel and of the picture.
#pragma once

#include <string>

#include "engine/model/snapshot.h"

namespace palace {

/// "in force", "follows", "re-acquired", "drifts, limit 5 px", "LOST 1.2 s: coherence 0.42, limit
/// 0.70"; of a LOST one where it stands is coasted.
std::string TrackerStateWords(const TrackerMember& member);
/// "5 of 6 agree, within 0.6 px, ± 0.9 px"; of one that is not trusted why. The last is 3 sigma.
std::string ConsensusWords(const TrackerSetStatus& trackers);
/// Why there is nothing to show: "No site is tracked", with the reason where one is told.
std::string WhyNoTrackers(const EngineSnapshot& snap);
/// The trackers speak of the picture that is shown: of another one their places would mislead.
bool AreTrackersOfPicture(const EngineSnapshot& snap);

}  // namespace palace
