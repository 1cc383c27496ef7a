// Termination: SIGINT, SIGTERM and SIGHUP as a wish to end, taken in order instead of by dying.
#pragma once

#include <signal.h>

#include <atomic>
#include <functional>
#include <thread>

namespace palace {

/// Make it before any other thread starts: the signals are blocked in all of them and waited for
/// here, so that no handler interrupts anything. The first asks; a second one ends the program at
/// once, for somebody who cannot wait. What is ignored already (nohup) stays ignored.
class Termination {
 public:
  /// `asked` is called once, on a thread of its own.
  explicit Termination(std::function<void()> asked = {});
  /// Gives the signals back their old meaning.
  ~Termination();
  Termination(const Termination&) = delete;
  Termination& operator=(const Termination&) = delete;

  /// Of the signal that came; 0 while none did.
  int signal() const { return signal_.load(); }
  bool asked() const { return signal() != 0; }
  /// 128 and the signal, as a shell calls the end by it; 0 when none came.
  int exit_code() const { return asked() ? 128 + signal() : 0; }

 private:
  sigset_t signals_;
  sigset_t before_;
  std::atomic<int> signal_{0};
  std::jthread thread_;
};

}  // namespace palace
