#include "engine/slad/hazards/loops/slad_loops.h"

#include "engine/core/lanes/instruction_sets.h"
#include "engine/slad/hazards/loops/slad_loops_table.h"

namespace palace {

// slad_loops_avx2.cpp, slad_loops_avx512.cpp; null where they were not built.
const SladLoops* SladLoopsBuiltForAvx2();
const SladLoops* SladLoopsBuiltForAvx512();

const SladLoops& PortableSladLoops() { return kLoops; }

const SladLoops* Avx2SladLoops() {
  return Has(InstructionSet::kAvx2) ? SladLoopsBuiltForAvx2() : nullptr;
}

const SladLoops* Avx512SladLoops() {
  return Has(InstructionSet::kAvx512) ? SladLoopsBuiltForAvx512() : nullptr;
}

const SladLoops& FastestSladLoops() {
  if (const SladLoops* avx512 = Avx512SladLoops()) {
    return *avx512;
  }
  const SladLoops* avx2 = Avx2SladLoops();
  return avx2 != nullptr ? *avx2 : PortableSladLoops();
}

}  // namespace palace
