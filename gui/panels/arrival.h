// Arrival: how old is what a channel brought last, as pictures and plates say it.
#pragma once

#include <cmath>
#include <string>

#include "engine/model/snapshot.h"
#include "gui/widgets/draw.h"

namespace palace {

struct Arrival {
  std::string age = "never", rate;
  double age_s = NAN;
  ChannelHealth::State state = ChannelHealth::State::kNever;
  std::string wrong;  ///< "Repeats its picture"; empty while nothing is known to be
  std::string lost;   ///< "60 % lost"; empty up to kMostLostShare
  bool fine() const {
    return state == ChannelHealth::State::kFresh && wrong.empty() && lost.empty();
  }
  bool late() const {
    return state == ChannelHealth::State::kLate || state == ChannelHealth::State::kStale;
  }
};
Arrival ArrivalOf(const EngineSnapshot& snap, ChannelId channel, double silent_s);
/// The same of something that came by the channel `age_s` before the snapshot, whatever came since.
Arrival ArrivalOf(const EngineSnapshot& snap, ChannelId channel, double silent_s, double age_s);

/// "climbing"; "climbing, heard 2.5 s ago" of a vehicle whose word is older than the link may be.
std::string Heard(const std::string& words, double age_s);
/// Veils a picture that is stale, "1.8 s old" at the top right, and what a camera shows wrongly.
/// Shown are the pictures of the newest pair: where each camera's own still arrive and the engine
/// calls the pair too old to approve on, its reason is there, "Stereo pair stale, 5.2 s".
void DrawStale(UiFrame& ui, const Rect& image, const EngineSnapshot& snap, const Arrival& arrival);
/// "Laser 21.2 m"; empty while no fresh range is known.
std::string LaserPlate(const EngineSnapshot& snap, double silent_s);

}  // namespace palace
