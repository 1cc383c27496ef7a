// The loops as the instruction set of the including file has them. Included by stereo_loops*.cpp
// only.
#pragma once

#include "engine/stereo/refinement_loops.h"
#include "engine/stereo/semi_global_loops.h"
#include "engine/stereo/stereo_loops.h"

namespace palace {
namespace {

constexpr StereoLoops kLoops{CensusRow,   MatchRow,   AggregateDown, AggregateAlong, ChooseRow,
                             SmoothAlong, SmoothDown, SplineRow,     WarpRow,        Slide,
                             SumAlong,    FitRow,     FinishRow};

}  // namespace
}  // namespace palace
