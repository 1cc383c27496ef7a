// Built with -mavx2 (CMakeLists.txt). Includes nothing but the loops.
#if defined(__AVX2__)
#include "engine/stereo/refinement_loops.h"
#include "engine/stereo/semi_global_loops.h"
#endif
#include "engine/stereo/stereo_loops.h"

namespace palace {

const StereoLoops* LoopsBuiltForAvx2();

const StereoLoops* LoopsBuiltForAvx2() {
#if defined(__AVX2__)
  static constexpr StereoLoops loops{
      CensusRow, MatchRow, AggregateDown, AggregateAlong, ChooseRow, SmoothAlong, SmoothDown,
      SplineRow, WarpRow,  Slide,         SumAlong,       FitRow,    FinishRow};
  return &loops;
#else
  return nullptr;
#endif
}

}  // namespace palace
