#include "engine/stereo/stereo_loops.h"

#include "engine/stereo/refinement_loops.h"
#include "engine/stereo/semi_global_loops.h"

namespace palace {

const StereoLoops* LoopsBuiltForAvx2();  // stereo_loops_avx2.cpp; null where it was not built

const StereoLoops& PortableLoops() {
  static constexpr StereoLoops loops{
      CensusRow, MatchRow, AggregateDown, AggregateAlong, ChooseRow, SmoothAlong, SmoothDown,
      SplineRow, WarpRow,  Slide,         SumAlong,       FitRow,    FinishRow};
  return loops;
}

const StereoLoops* Avx2Loops() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx2") ? LoopsBuiltForAvx2() : nullptr;
#else
  return nullptr;
#endif
}

const StereoLoops& FastestLoops() {
  const StereoLoops* avx2 = Avx2Loops();
  return avx2 ? *avx2 : PortableLoops();
}

}  // namespace palace
