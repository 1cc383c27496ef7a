#include "engine/capture/frame_pairing.h"

#include <cmath>
#include <utility>

#include "engine/core/check.h"

namespace palace {
namespace {

double Apart_s(const TimedPicture& a, const TimedPicture& b) {
  return std::abs(SecondsBetween(a.time, b.time));
}

}  // namespace

FramePairing::FramePairing(double tolerance_s, std::size_t capacity)
    : tolerance_s_(tolerance_s), capacity_(capacity) {
  PALACE_CHECK(tolerance_s > 0 && capacity > 0, tolerance_s, capacity);
}

void FramePairing::Drop(Side side) {
  waiting_[side].pop_front();
  ++unpaired_[side];
}

std::optional<PicturePair> FramePairing::Add(Side side, TimedPicture picture) {
  if (newest_[side] && picture.time <= *newest_[side]) {
    ++unpaired_[side];
    return std::nullopt;
  }
  newest_[side] = picture.time;
  waiting_[side].push_back(std::move(picture));
  if (waiting_[side].size() > capacity_) {
    Drop(side);
  }
  auto& left = waiting_[kLeft];
  auto& right = waiting_[kRight];
  while (!left.empty() && !right.empty()) {
    const Side earlier = left.front().time <= right.front().time ? kLeft : kRight;
    const auto& early = waiting_[earlier];
    const TimedPicture& late = waiting_[1 - earlier].front();
    const bool next_is_nearer =
        early.size() > 1 && Apart_s(early[1], late) < Apart_s(early[0], late);
    if (next_is_nearer || Apart_s(early.front(), late) > tolerance_s_) {
      Drop(earlier);
      continue;
    }
    PicturePair pair{std::move(left.front()), std::move(right.front())};
    left.pop_front();
    right.pop_front();
    return pair;
  }
  return std::nullopt;
}

void FramePairing::Restart() {
  for (std::size_t side : {kLeft, kRight}) {
    waiting_[side].clear();
    newest_[side].reset();
  }
}

}  // namespace palace
