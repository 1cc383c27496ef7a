// palace: the ground station.
#include <cstdio>

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
  return palace::RunApp(*options);
}
