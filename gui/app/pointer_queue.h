// Presses and releases of the mouse, each told where it happened.
#pragma once

#include <optional>
#include <vector>

#include "gui/platform/window.h"

namespace palace {

/// A frame that takes long sees several events at once. Read as a state, a press would count where
/// the pointer has gone to since, on another button, or be lost with its release. So a frame sees
/// at most one change of a button, with the pointer where it was then; what came later waits for
/// the next frames.
class PointerQueue {
 public:
  void Add(const std::vector<PointerEvent>& events);
  bool waiting() const { return !events_.empty(); }
  /// Of the next frame: the first change of a button that waits, else where the pointer moved to
  /// last; nothing when no event waits.
  std::optional<PointerEvent> Take();

 private:
  std::vector<PointerEvent> events_;
};

}  // namespace palace
