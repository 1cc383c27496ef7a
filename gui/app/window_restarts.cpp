#include "gui/app/window_restarts.h"

namespace palace {

Status WindowRestarts::Stopped(const std::string& reason, double now_s) {
  reason_ = reason;
  at_s_ = watch_.Stopped("Window", reason, now_s);
  return at_s_ ? Ok()
               : UnavailableError("Window stopped: " + reason + ". It was opened anew " +
                                  std::to_string(EngineWatch::kMostRestarts) +
                                  " times: start the station again");
}

bool WindowRestarts::TakeTurn(double now_s) {
  if (!at_s_ || now_s < *at_s_) {
    return false;
  }
  at_s_.reset();
  watch_.Started(now_s);
  return true;
}

}  // namespace palace
