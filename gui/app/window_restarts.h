// WindowRestarts: when a window that stopped is opened anew, and when that is given up.
#pragma once

#include <optional>
#include <string>

#include "engine/core/result.h"
#include "engine/runtime/engine_watch.h"

namespace palace {

/// Three times, at least 5 s apart, as the engine: what fails again and again is not the graphics.
class WindowRestarts {
 public:
  /// Drawing failed, at a monotonic time. An error for people when it did so too often.
  Status Stopped(const std::string& reason, double now_s);
  /// It stopped and is not opened anew yet: nothing can be drawn, keys can be obeyed.
  bool waiting() const { return at_s_.has_value(); }
  /// True once, when its time has come.
  bool TakeTurn(double now_s);
  /// Of the newest stop.
  const std::string& reason() const { return reason_; }

 private:
  EngineWatch watch_;
  std::optional<double> at_s_;
  std::string reason_;
};

}  // namespace palace
