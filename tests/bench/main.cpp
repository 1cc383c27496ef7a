// Memory as in the programs that are measured.
#include <benchmark/benchmark.h>

#include "engine/core/freed_memory.h"

int main(int argc, char** argv) {
  palace::KeepFreedMemory();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) {
    return 2;
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
