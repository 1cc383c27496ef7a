// Built with -mavx2 (CMakeLists.txt). Includes nothing but the loops.
#include "engine/slad/slad_loops.h"
#if defined(__AVX2__)
#include "engine/slad/distance_loops.h"
#include "engine/slad/footprint_loops.h"
#include "engine/slad/lmeds_loops.h"
#include "engine/slad/moment_loops.h"
#include "engine/slad/touchdown_loops.h"
#include "engine/slad/verdict_loops.h"
#endif

namespace palace {

const SladLoops* SladLoopsBuiltForAvx2();

const SladLoops* SladLoopsBuiltForAvx2() {
#if defined(__AVX2__)
  static constexpr SladLoops loops{
      FitPlaneRow,    DiscDeviationRow, StepRow,          SettleRow,       WindowMaximumRow,
      AddMomentsRow,  SolveMomentsRow,  ColumnGapsRow,    SquareGapsRow,   NearestInRow,
      PutGearDownRow, SlopeRow,         ThesisVerdictRow, ModernVerdictRow};
  return &loops;
#else
  return nullptr;
#endif
}

}  // namespace palace
