#include "engine/capture/playback_turns.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace palace {

PlaybackTurns::PlaybackTurns(PictureTimes times, std::int64_t count, AtEnd at_end)
    : times_(std::move(times)), at_end_(at_end), count_(count), count_found_(false) {
  PALACE_CHECK(count >= 0, count);
}

std::optional<std::int64_t> PlaybackTurns::Wait(std::stop_token stop) {
  std::unique_lock lock(mutex_);
  for (;;) {
    if (!changed_.wait(lock, stop, [&] { return !paused_ || steps_ > 0; })) {
      return std::nullopt;
    }
    if (count_found_ && next_index_ >= count_ && at_end_ != AtEnd::kRunOn) {
      if (at_end_ == AtEnd::kRestart && count_ > 0) {
        next_index_ = 0;
        continue;
      }
      ended_ = true;
      steps_ = 0;
      if (at_end_ != AtEnd::kWait ||
          !changed_.wait(lock, stop, [&] { return next_index_ < count_; })) {
        return std::nullopt;
      }
      continue;
    }
    ended_ = false;
    const double now = MonotonicSeconds();
    if (steps_ > 0 || speed_ <= 0 || now >= due_s_) {
      steps_ = std::max(0, steps_ - 1);
      const double period = speed_ > 0 ? times_.Gap(next_index_) / speed_ : 0;
      // Keep the beat when in time; start a new one after a pause or when the engine is slower.
      const bool starts = due_s_ == 0;
      const double late = starts ? 0 : now - due_s_;
      due_s_ = (!starts && late < period ? due_s_ : now) + period;
      speed_reached_ = late < period || period == 0 ? speed_ : period / late * speed_;
      shown_index_ = next_index_++;
      return shown_index_;
    }
    // Woken early by Control: look again at what it changed.
    const auto wait = std::chrono::duration<double>(std::min(due_s_ - now, 1.0));
    const double due = due_s_;
    changed_.wait_for(lock, stop, wait,
                      [&] { return paused_ || steps_ > 0 || due_s_ != due || speed_ <= 0; });
    if (stop.stop_requested()) {
      return std::nullopt;
    }
  }
}

void PlaybackTurns::EndsAt(std::int64_t count) {
  const std::lock_guard lock(mutex_);
  count_ = count;
  count_found_ = true;
  shown_index_ = std::min(shown_index_, count - 1);
  if (next_index_ > count) {
    next_index_ = count;
  }
}

void PlaybackTurns::FillStatus(SourceStatus& status) const {
  const std::lock_guard lock(mutex_);
  status.paused = paused_;
  status.ended = ended_;
  status.speed = speed_;
  status.speed_reached = speed_reached_;
  status.start = kRecordedStart;
  status.position_s = times_.At(std::max<std::int64_t>(0, shown_index_));
  status.frame_index = static_cast<std::uint64_t>(shown_index_ + 1);
  if (count_ > 0) {
    status.duration_s = times_.At(count_);
  }
  if (count_ > 0 && at_end_ == AtEnd::kRunOn) {  // the last picture stays while time goes on
    status.duration_s = std::max(*status.duration_s, status.position_s);
    status.frame_index = std::min(status.frame_index, static_cast<std::uint64_t>(count_));
  }
  status.can_seek = true;
  status.frame_count = static_cast<std::uint64_t>(count_);
}

void PlaybackTurns::Control(const PlaybackControl& control) {
  const std::lock_guard lock(mutex_);
  switch (control.kind) {
    case PlaybackControl::Kind::kPlay:
      due_s_ = paused_ ? 0 : due_s_;
      paused_ = false;
      break;
    case PlaybackControl::Kind::kPause:
      paused_ = true;
      steps_ = 0;
      break;
    case PlaybackControl::Kind::kStepForward:
      paused_ = true;
      ++steps_;
      break;
    case PlaybackControl::Kind::kStepBack:
      paused_ = true;
      next_index_ = std::max<std::int64_t>(0, shown_index_ - 1);
      steps_ = 1;
      break;
    case PlaybackControl::Kind::kSeek:
      if (std::isfinite(control.value)) {
        constexpr std::int64_t kFarthest = 1'000'000'000'000;
        const double last_s = times_.At(count_ > 0 ? count_ - 1 : kFarthest);
        next_index_ = times_.Nearest(std::clamp(control.value, 0.0, last_s));
        ended_ = false;
        due_s_ = 0;
        steps_ = paused_ ? 1 : 0;  // a seek while paused shows the picture it went to
      }
      break;
    case PlaybackControl::Kind::kSpeed:
      if (std::isfinite(control.value) && control.value >= 0) {
        speed_ = control.value;
        due_s_ = 0;
      }
      break;
    case PlaybackControl::Kind::kRunTo:  // of a simulation
      break;
  }
  changed_.notify_all();
}

}  // namespace palace
