#include "engine/stereo/stereo_loops.h"

#include "engine/core/lanes/instruction_sets.h"
#include "engine/stereo/stereo_loops_table.h"

namespace palace {

const StereoLoops* LoopsBuiltForAvx2();  // stereo_loops_avx2.cpp; null where it was not built

const StereoLoops& PortableLoops() { return kLoops; }

const StereoLoops* Avx2Loops() {
  return Has(InstructionSet::kAvx2) ? LoopsBuiltForAvx2() : nullptr;
}

const StereoLoops& FastestLoops() {
  const StereoLoops* avx2 = Avx2Loops();
  return avx2 != nullptr ? *avx2 : PortableLoops();
}

}  // namespace palace
