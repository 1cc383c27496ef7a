// RunIn: going to a moment of a recorded flight with a map that has been built up by then. It jumps
// to shortly before, plays, and stops there; a pause, or a jump of somebody else's, ends it.
#pragma once

#include <cstdint>

#include "engine/model/source_status.h"
#include "gui/app/intent.h"

namespace palace {

class RunIn {
 public:
  /// To `at_s` from the start of the log.
  Intents Begin(const SourceStatus& source, double at_s);
  /// Once a frame: the pause at the end, or nothing.
  Intents Follow(const SourceStatus& source);
  bool running() const { return phase_ != Phase::kNone; }

 private:
  enum class Phase { kNone, kJumps, kPlays } phase_ = Phase::kNone;
  double at_s_ = 0;
  std::uint64_t jumps_ = 0;  ///< SourceStatus::jumps: before it, and once it plays
};

}  // namespace palace
