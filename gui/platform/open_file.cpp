#include "gui/platform/open_file.h"

#include <spawn.h>
#include <unistd.h>

#include <cstring>

namespace palace {

Status OpenFile(const std::string& path) {
  std::string program = "xdg-open", file = path;
  char* arguments[] = {program.data(), file.data(), nullptr};
  pid_t child = 0;
  const int failed = posix_spawnp(&child, program.c_str(), nullptr, nullptr, arguments, environ);
  return failed == 0
             ? Ok()
             : UnavailableError("Cannot open " + path + ": xdg-open: " + std::strerror(failed));
}

}  // namespace palace
