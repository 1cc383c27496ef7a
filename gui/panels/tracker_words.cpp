#include "gui/panels/tracker_words.h"

#include "gui/widgets/number_text.h"

namespace palace {

std::string TrackerStateWords(const TrackerMember& member) {
  const std::string force = member.in_force ? "in force" : "";
  if (!member.followed()) {
    return force + (force.empty() ? "" : ", ") + FollowWord(member.state) + " " +
           Duration(member.lost_s) + (member.why_lost.empty() ? "" : ": " + member.why_lost);
  }
  const std::string how = member.drifts
                              ? "drifts, limit " + Fixed(TrackerSetStatus::kDrift_px, 0) + " px"
                          : member.state == FollowState::kReacquired ? FollowWord(member.state)
                          : member.in_force                          ? ""
                                                                     : "follows";
  return force + (force.empty() || how.empty() ? "" : ", ") + how;
}

std::string ConsensusWords(const TrackerSetStatus& trackers) {
  const TrackerConsensus& consensus = trackers.consensus;
  const std::string sigma = "± " + Fixed(3 * consensus.sigma_px, 1) + " px";
  if (!consensus.trusted) {
    return "Not trusted: " + consensus.why_not_trusted + ", " + sigma;
  }
  return std::to_string(consensus.agreeing) + " of " + std::to_string(trackers.members.size()) +
         " agree, within " + Fixed(consensus.spread_px, 1) + " px, " + sigma;
}

std::string WhyNoTrackers(const EngineSnapshot& snap) {
  const std::string& why = snap.flight->tracker.why_not_locked;
  return why.empty() ? "No site is tracked" : "No site is tracked: " + why;
}

bool AreTrackersOfPicture(const EngineSnapshot& snap) {
  return snap.sensors->frame && snap.flight->trackers.time == snap.sensors->frame->time;
}

}  // namespace palace
