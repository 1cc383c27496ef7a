#include "gui/panels/review/redecide_run.h"

#include <algorithm>

namespace palace {
namespace {

using Kind = PlaybackControl::Kind;
constexpr double kLeastShare = 0.02;  // before that the pace says nothing

}  // namespace

Intents RedecideRun::Begin(const SourceStatus& source, double ui_time_s) {
  running_ = true;
  under_way_ = false;
  jumps_ = source.jumps;
  began_s_ = ui_time_s;
  elapsed_s_ = share_ = 0;
  speed_before_ = source.speed > 0 ? source.speed : 1;
  took_s_.reset();
  return {PlaybackControl{Kind::kSeek, 0}, PlaybackControl{Kind::kSpeed, 0},
          PlaybackControl{Kind::kPlay, 0}};
}

Intents RedecideRun::Stop() {
  running_ = false;
  return {PlaybackControl{Kind::kPause, 0}, PlaybackControl{Kind::kSpeed, speed_before_}};
}

Intents RedecideRun::Follow(const SourceStatus& source, double ui_time_s) {
  if (!running_) {
    return {};
  }
  elapsed_s_ = ui_time_s - began_s_;
  const bool playing = !source.paused && !source.ended && source.speed == 0;
  if (!under_way_) {
    if (!playing || source.jumps == jumps_) {
      return {};  // what was asked for is not on the screen yet
    }
    under_way_ = true;
    jumps_ = source.jumps;
  }
  const bool jumped = source.jumps != jumps_;
  share_ = source.duration_s && *source.duration_s > 0
               ? std::clamp(source.position_s / *source.duration_s, 0.0, 1.0)
               : 0;
  if (playing && !jumped) {
    return {};
  }
  running_ = false;
  if (source.ended && !jumped) {
    took_s_ = elapsed_s_;
  }
  return {PlaybackControl{Kind::kSpeed, speed_before_}};
}

std::optional<double> RedecideRun::left_s() const {
  return running_ && share_ > kLeastShare ? std::optional(elapsed_s_ * (1 - share_) / share_)
                                          : std::nullopt;
}

}  // namespace palace
