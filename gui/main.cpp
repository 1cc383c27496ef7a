// palace: the ground station.
#include <csignal>
#include <cstdio>
#include <new>

#include "engine/core/freed_memory.h"
#include "gui/app/app.h"
#include "gui/app/exit_code.h"

int main(int argc, char** argv) {
  palace::KeepFreedMemory();
  const palace::Result<palace::AppOptions> options = palace::ParseCommandLine(argc, argv);
  if (!options) {
    return palace::FailWith(options.error());
  }
  if (!options->print.empty()) {
    std::fputs(options->print.c_str(), stdout);
    return 0;
  }
  std::signal(SIGPIPE, SIG_IGN);  // a reader of our output that left ends no flight
  try {
    return palace::RunApp(*options);
  } catch (const std::bad_alloc&) {
    return palace::FailWith(palace::UnavailableError(
        "out of memory; allow this program more (ulimit -v) or end other programs"));
  }
}
