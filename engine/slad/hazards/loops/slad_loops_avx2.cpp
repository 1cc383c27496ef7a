// Built with -mavx2 (CMakeLists.txt). Includes nothing but the loops.
#include "engine/slad/hazards/loops/slad_loops.h"
#if defined(__AVX2__)
#include "engine/slad/hazards/loops/slad_loops_table.h"
#endif

namespace palace {

const SladLoops* SladLoopsBuiltForAvx2();

const SladLoops* SladLoopsBuiltForAvx2() {
#if defined(__AVX2__)
  return &kLoops;
#else
  return nullptr;
#endif
}

}  // namespace palace
