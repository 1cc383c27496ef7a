#include "gui/app/pointer_queue.h"

#include <algorithm>

namespace palace {

void PointerQueue::Add(const std::vector<PointerEvent>& events) {
  events_.insert(events_.end(), events.begin(), events.end());
}

std::optional<PointerEvent> PointerQueue::Take() {
  if (events_.empty()) {
    return std::nullopt;
  }
  const auto change = std::find_if(events_.begin(), events_.end(),
                                   [](const PointerEvent& event) { return event.button >= 0; });
  const PointerEvent next = change != events_.end() ? *change : events_.back();
  events_.erase(events_.begin(), change != events_.end() ? change + 1 : change);
  return next;
}

}  // namespace palace
