// LoopRange: a stretch of a recorded flight that is played again and again.
//
// Its ends are set where the replay stands; one that is not set is the flight's own. It turns back
// when what plays has passed the end. A jump of somebody else's is obeyed: from before the stretch
// it plays on into it.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "engine/model/source_status.h"
#include "gui/app/intent.h"

namespace palace {

class LoopRange {
 public:
  /// Sets one end, on or off; an end on the wrong side of the other replaces it.
  void Set(LoopEdge edge, double at_s);
  /// On or off; the ends stay.
  void Toggle() { on_ = !on_; }
  bool on() const { return on_; }
  /// From, to, seconds from the start of the log; nothing while it is off and has no end of its own.
  std::optional<std::pair<double, double>> Shown(double duration_s) const;
  /// Once a frame: what turns the replay back, or nothing.
  Intents Follow(const SourceStatus& source);

 private:
  std::optional<double> in_s_, out_s_;
  bool on_ = false;
  std::optional<std::uint64_t> asked_;  ///< SourceStatus::jumps when it was told to turn back
};

}  // namespace palace
