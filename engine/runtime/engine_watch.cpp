#include "engine/runtime/engine_watch.h"

#include <algorithm>

#include "engine/core/text.h"

namespace palace {
namespace {
constexpr const char* kLastResort = " WAVE OFF works; the vehicle should hold by itself.";
}  // namespace

void EngineWatch::Begin(double now_s) {
  const std::lock_guard lock(mutex_);
  busy_since_s_ = now_s;
}

void EngineWatch::End() {
  const std::lock_guard lock(mutex_);
  busy_since_s_.reset();
}

std::optional<double> EngineWatch::Stopped(const std::string& what, const std::string& reason,
                                           double now_s) {
  const std::lock_guard lock(mutex_);
  stopped_ = true;
  why_ = what + " stopped: " + reason + ".";
  next_start_s_.reset();
  if (restarts_ < kMostRestarts) {
    next_start_s_ = last_start_s_ ? std::max(now_s, *last_start_s_ + kBetweenRestarts_s) : now_s;
  }
  return next_start_s_;
}

void EngineWatch::Started(double now_s) {
  const std::lock_guard lock(mutex_);
  stopped_ = false;
  ++restarts_;
  last_start_s_ = now_s;
}

std::string EngineWatch::Complaint(double now_s) const {
  const std::lock_guard lock(mutex_);
  if (stopped_ && next_start_s_) {
    return why_ +
           WithNumbers(" It starts again in %.0f s.", std::max(0.0, *next_start_s_ - now_s)) +
           kLastResort;
  }
  if (stopped_) {
    return why_ +
           WithNumbers(" It was started again %.0f times: restart the station.",
                       static_cast<double>(restarts_)) +
           kLastResort;
  }
  if (busy_since_s_ && now_s - *busy_since_s_ > kSilence_s) {
    return WithNumbers("Engine has not answered for %.1f s, limit %.0f s.", now_s - *busy_since_s_,
                       kSilence_s) +
           kLastResort;
  }
  return {};
}

std::string EngineWatch::LastStop() const {
  const std::lock_guard lock(mutex_);
  return why_.empty() ? why_
                      : why_ + WithNumbers(" Started again, %.0f of %.0f times.",
                                           static_cast<double>(restarts_),
                                           static_cast<double>(kMostRestarts));
}

}  // namespace palace
