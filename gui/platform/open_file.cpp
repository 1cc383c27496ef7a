#include "gui/platform/open_file.h"

#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>
#include <thread>

namespace palace {
namespace {

/// How a program of its own starts: with none of the signals held back that the station waits for.
class FreshStart {
 public:
  FreshStart() {
    posix_spawnattr_init(&attributes_);
    sigset_t signals;
    sigemptyset(&signals);
    posix_spawnattr_setsigmask(&attributes_, &signals);
    for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) {
      sigaddset(&signals, number);
    }
    posix_spawnattr_setsigdefault(&attributes_, &signals);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  }
  ~FreshStart() { posix_spawnattr_destroy(&attributes_); }
  FreshStart(const FreshStart&) = delete;
  FreshStart& operator=(const FreshStart&) = delete;
  const posix_spawnattr_t* get() const { return &attributes_; }

 private:
  posix_spawnattr_t attributes_{};
};

/// Takes its end from it, whenever that is, so that no dead entry stays behind.
void Reap(pid_t child) {
  try {
    std::thread([child] {
      while (waitpid(child, nullptr, 0) < 0 && errno == EINTR) {
      }
    }).detach();
  } catch (const std::system_error&) {
    // Then it stays in the list of processes until the station ends.
  }
}

}  // namespace

Status OpenFile(const std::string& path) {
  std::string program = "xdg-open", file = path;
  char* arguments[] = {program.data(), file.data(), nullptr};
  pid_t child = 0;
  const FreshStart fresh;
  const int failed =
      posix_spawnp(&child, program.c_str(), nullptr, fresh.get(), arguments, environ);
  if (failed != 0) {
    return UnavailableError("Cannot open " + path + ": xdg-open: " + std::strerror(failed));
  }
  Reap(child);
  return Ok();
}

}  // namespace palace
