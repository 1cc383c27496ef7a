#include "gui/panels/review/run_in.h"

#include <algorithm>

namespace palace {
namespace {

using Kind = PlaybackControl::Kind;
constexpr double kBefore_s = 2;  // a map remembers ten frames, a second of most flights

}  // namespace

Intents RunIn::Begin(const SourceStatus& source, double at_s) {
  phase_ = Phase::kJumps;
  at_s_ = at_s;
  jumps_ = source.jumps;
  return {PlaybackControl{Kind::kSeek, std::max(0.0, at_s - kBefore_s)},
          PlaybackControl{Kind::kPlay, 0}};
}

Intents RunIn::Follow(const SourceStatus& source) {
  if (phase_ == Phase::kJumps && source.jumps != jumps_ && !source.paused) {
    phase_ = Phase::kPlays;
    jumps_ = source.jumps;
  }
  if (phase_ != Phase::kPlays) {
    return {};
  }
  if (source.jumps != jumps_ || source.paused || source.ended) {
    phase_ = Phase::kNone;
  } else if (source.position_s >= at_s_) {
    phase_ = Phase::kNone;
    return {PlaybackControl{Kind::kPause, 0}};
  }
  return {};
}

}  // namespace palace
