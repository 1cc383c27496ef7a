#include "engine/slad/hazards/loops/slad_loops.h"

#include "engine/slad/hazards/loops/slad_loops_table.h"

namespace palace {

// slad_loops_avx2.cpp, slad_loops_avx512.cpp; null where they were not built.
const SladLoops* SladLoopsBuiltForAvx2();
const SladLoops* SladLoopsBuiltForAvx512();

const SladLoops& PortableSladLoops() { return kLoops; }

const SladLoops* Avx2SladLoops() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx2") ? SladLoopsBuiltForAvx2() : nullptr;
#else
  return nullptr;
#endif
}

const SladLoops* Avx512SladLoops() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx512f") ? SladLoopsBuiltForAvx512() : nullptr;
#else
  return nullptr;
#endif
}

const SladLoops& FastestSladLoops() {
  if (const SladLoops* avx512 = Avx512SladLoops()) {
    return *avx512;
  }
  const SladLoops* avx2 = Avx2SladLoops();
  return avx2 != nullptr ? *avx2 : PortableSladLoops();
}

}  // namespace palace
