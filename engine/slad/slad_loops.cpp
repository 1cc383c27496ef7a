#include "engine/slad/slad_loops.h"

#include "engine/slad/distance_loops.h"
#include "engine/slad/footprint_loops.h"
#include "engine/slad/lmeds_loops.h"
#include "engine/slad/moment_loops.h"
#include "engine/slad/touchdown_loops.h"
#include "engine/slad/verdict_loops.h"

namespace palace {

const SladLoops* SladLoopsBuiltForAvx2();  // slad_loops_avx2.cpp; null where it was not built

const SladLoops& PortableSladLoops() {
  static constexpr SladLoops loops{
      FitPlaneRow,    DiscDeviationRow, StepRow,          SettleRow,       WindowMaximumRow,
      AddMomentsRow,  SolveMomentsRow,  ColumnGapsRow,    SquareGapsRow,   NearestInRow,
      PutGearDownRow, SlopeRow,         ThesisVerdictRow, ModernVerdictRow};
  return loops;
}

const SladLoops* Avx2SladLoops() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx2") ? SladLoopsBuiltForAvx2() : nullptr;
#else
  return nullptr;
#endif
}

const SladLoops& FastestSladLoops() {
  const SladLoops* avx2 = Avx2SladLoops();
  return avx2 ? *avx2 : PortableSladLoops();
}

}  // namespace palace
