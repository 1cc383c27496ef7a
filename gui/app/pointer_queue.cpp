#include "gui/app/pointer_queue.h"

#include <algorithm>

namespace palace {

void PointerQueue::Add(const std::vector<PointerEvent>& events) {
  events_.insert(events_.end(), events.begin(), events.end());
}

std::optional<PointerState> PointerQueue::Take() {
  if (events_.empty()) {
    return std::nullopt;
  }
  const auto change = std::find_if(events_.begin(), events_.end(),
                                   [](const PointerEvent& event) { return event.button >= 0; });
  const PointerEvent last = change != events_.end() ? *change : events_.back();
  if (last.button >= 0) {
    down_[static_cast<std::size_t>(last.button)] = last.down;
  }
  events_.erase(events_.begin(), change != events_.end() ? change + 1 : change);
  return PointerState{{last.x, last.y}, down_};
}

}  // namespace palace
