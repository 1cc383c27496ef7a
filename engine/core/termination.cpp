#include "engine/core/termination.h"

#include <unistd.h>

#include <utility>

namespace palace {

Termination::Termination(std::function<void()> asked) {
  sigemptyset(&signals_);
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction now {};
    sigaction(number, nullptr, &now);
    if (now.sa_handler != SIG_IGN) {
      sigaddset(&signals_, number);
    }
  }
  pthread_sigmask(SIG_BLOCK, &signals_, &before_);
  thread_ = std::jthread([this, asked = std::move(asked)](std::stop_token done) {
    const timespec tick{0, 50'000'000};
    while (!done.stop_requested()) {
      const int number = sigtimedwait(&signals_, nullptr, &tick);
      if (number <= 0) {
        continue;
      }
      if (signal_ != 0) {
        _exit(128 + number);
      }
      signal_ = number;
      if (asked) {
        asked();
      }
    }
  });
}

Termination::~Termination() {
  thread_.request_stop();
  thread_.join();
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

}  // namespace palace
