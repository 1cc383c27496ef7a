#include "gui/app/refusal_watch.h"

namespace palace {

std::string RefusalWatch::Newest(const EngineSnapshot& snapshot) {
  if (!snapshot.session->events || snapshot.session->events->empty()) {
    return {};
  }
  const std::vector<Event>& events = *snapshot.session->events;
  if (events.size() < seen_) {
    seen_ = events.size() - 1;  // the oldest were let go when the newest came
  }
  std::string newest;
  for (; seen_ < events.size(); ++seen_) {
    newest = IsRefusal(events[seen_]) ? events[seen_].text : newest;
  }
  return FollowsRecord(snapshot.session->role) ? std::string() : newest;
}

}  // namespace palace
