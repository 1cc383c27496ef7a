// The loops as the instruction set of the including file has them. Included by slad_loops*.cpp
// only.
#pragma once

#include "engine/slad/hazards/loops/distance_loops.h"
#include "engine/slad/hazards/loops/footprint_loops.h"
#include "engine/slad/hazards/loops/lmeds_loops.h"
#include "engine/slad/hazards/loops/moment_loops.h"
#include "engine/slad/hazards/loops/slad_loops.h"
#include "engine/slad/hazards/loops/touchdown_loops.h"
#include "engine/slad/hazards/loops/verdict_loops.h"

namespace palace {
namespace {

static_assert(FloatLanes::kCount <= kLaneSlack, "loops read and write whole lanes");

constexpr SladLoops kLoops{FitPlaneRow,      DiscDeviationRow, StepRow,         DenoiseRow,
                           WindowMaximumRow, AddMomentRows,    SolveMomentsRow, RejectOutliersRow,
                           ColumnGapsRow,    SquareGapsRow,    NearestInRow,    PutGearDownRow,
                           SlopeRow,         ThesisVerdictRow, ModernVerdictRow};

}  // namespace
}  // namespace palace
