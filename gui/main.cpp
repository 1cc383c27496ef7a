// palace: the ground station.
#include <cstdio>

#include "engine/core/freed_memory.h"
#include "gui/app/app.h"

int main(int argc, char** argv) {
  palace::KeepFreedMemory();
  const palace::Result<palace::AppOptions> options = palace::ParseCommandLine(argc, argv);
  if (!options) {
    std::fprintf(stderr, "palace: %s\n", options.error().message.c_str());
    return options.error().code == palace::ErrorCode::kUsage ? 2 : 1;
  }
  if (!options->print.empty()) {
    std::fputs(options->print.c_str(), stdout);
    return options->exit_code;
  }
  return palace::RunApp(*options);
}
