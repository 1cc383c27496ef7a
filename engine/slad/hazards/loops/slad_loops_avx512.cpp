// Built with -mavx512f (CMakeLists.txt). Includes nothing but the loops.
#include "engine/slad/hazards/loops/slad_loops.h"
#if defined(__AVX512F__)
#include "engine/slad/hazards/loops/slad_loops_table.h"
#endif

namespace palace {

const SladLoops* SladLoopsBuiltForAvx512();

const SladLoops* SladLoopsBuiltForAvx512() {
#if defined(__AVX512F__)
  return &kLoops;
#else
  return nullptr;
#endif
}

}  // namespace palace
