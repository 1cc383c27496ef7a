// The stage that a long command is at, on the terminal of somebody who waits.
#pragma once

#include <unistd.h>

#include <cstdio>
#include <string>

namespace palace {

/// One line of stderr that each stage writes anew, and that is gone at the end. Into files and
/// pipes nothing is written: nobody waits there.
class StageProgress {
 public:
  /// `verb` leads the line; it outlives this.
  explicit StageProgress(const char* verb) : verb_(verb), shown_(isatty(STDERR_FILENO) == 1) {}
  ~StageProgress() { End(); }
  StageProgress(const StageProgress&) = delete;
  StageProgress& operator=(const StageProgress&) = delete;

  void Begin(const std::string& stage) const {
    if (shown_) {
      std::fprintf(stderr, "%s%s: %s ...", kLineAnew, verb_, stage.c_str());
    }
  }
  /// Before other text is printed.
  void End() const {
    if (shown_) {
      std::fputs(kLineAnew, stderr);
    }
  }

 private:
  static constexpr const char* kLineAnew = "\r\x1b[K";

  const char* verb_;
  const bool shown_;
};

}  // namespace palace
