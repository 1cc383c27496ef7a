// Built with -mavx2 (CMakeLists.txt). Includes nothing but the loops.
#include "engine/stereo/stereo_loops.h"
#if defined(__AVX2__)
#include "engine/stereo/stereo_loops_table.h"
#endif

namespace palace {

const StereoLoops* LoopsBuiltForAvx2();

const StereoLoops* LoopsBuiltForAvx2() {
#if defined(__AVX2__)
  return &kLoops;
#else
  return nullptr;
#endif
}

}  // namespace palace
