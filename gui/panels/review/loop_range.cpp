#include "gui/panels/review/loop_range.h"

namespace palace {

void LoopRange::Set(LoopEdge edge, double at_s) {
  if (edge == LoopEdge::kIn) {
    in_s_ = at_s;
    out_s_ = out_s_ && *out_s_ <= at_s ? std::nullopt : out_s_;
  } else {
    out_s_ = at_s;
    in_s_ = in_s_ && *in_s_ >= at_s ? std::nullopt : in_s_;
  }
}

std::optional<std::pair<double, double>> LoopRange::Shown(double duration_s) const {
  return on_ || in_s_ || out_s_
             ? std::optional(std::pair(in_s_.value_or(0), out_s_.value_or(duration_s)))
             : std::nullopt;
}

Intents LoopRange::Follow(const SourceStatus& source) {
  using Kind = PlaybackControl::Kind;
  if (asked_ == source.jumps) {
    return {};  // what was asked for is not on the screen yet
  }
  asked_.reset();
  const bool past_end = out_s_ && source.position_s >= *out_s_;
  if (!on_ || !source.can_seek || !(source.ended || (past_end && !source.paused))) {
    return {};
  }
  asked_ = source.jumps;
  return {PlaybackControl{Kind::kSeek, in_s_.value_or(0)}, PlaybackControl{Kind::kPlay, 0}};
}

}  // namespace palace
