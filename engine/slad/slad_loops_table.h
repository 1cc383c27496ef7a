// The loops as the instruction set of the including file has them. Included by slad_loops*.cpp
// only.
#pragma once

#include "engine/slad/distance_loops.h"
#include "engine/slad/footprint_loops.h"
#include "engine/slad/lmeds_loops.h"
#include "engine/slad/moment_loops.h"
#include "engine/slad/slad_loops.h"
#include "engine/slad/touchdown_loops.h"
#include "engine/slad/verdict_loops.h"

namespace palace {
namespace {

static_assert(FloatLanes::kCount <= kLaneSlack, "loops read and write whole lanes");

constexpr SladLoops kLoops{FitPlaneRow,      DiscDeviationRow, StepRow,         SettleRow,
                           WindowMaximumRow, AddMomentsRow,    SolveMomentsRow, ColumnGapsRow,
                           SquareGapsRow,    NearestInRow,     PutGearDownRow,  SlopeRow,
                           ThesisVerdictRow, ModernVerdictRow};

}  // namespace
}  // namespace palace
