// Rows of `evaluate velocity-estimate`, and how the table of them is read.
//
// `case`: "loop", a flight of velocity_flight.h; "track", of the first trial five times a second;
// "mission", one of handover_flight.h.
#pragma once

#include "engine/experiments/experiment.h"
#include "engine/experiments/handover_flight.h"
#include "engine/experiments/velocity_flight.h"

namespace palace {

std::vector<std::string> VelocityColumns();
TrialRow RowOf(const VelocityMethod& method, const LoopIntegral& integral,
               const VelocityFlight& flight);
TrialRow RowOf(const HandoverFlight& flight);
/// Velocity north, as Figures 5.1 and 5.2 show one.
TrialRow TrackRowOf(const VelocityMethod& method, const LoopIntegral& integral,
                    const VelocityFlight::Sample& sample);

/// The integral gains that are flown: that of the vehicle's file, frozen where limited, and others
/// both ways.
std::span<const LoopIntegral> LoopIntegrals();

inline constexpr double kMostHover_mps = 0.04;
inline constexpr double kMostStep_mps = 0.05;

/// Its flights go into tracks.
bool IsTracked(const LoopIntegral& integral);

/// Passed when our velocity in the hover is never off by more than kMostHover_mps rms on an axis,
/// at the vehicle's own gain, nor that of the vision filter of a mission, and when at no hand-over
/// of a mission the error of the velocity that is sent changes by more than kMostStep_mps from one
/// message to the next. A flight or mission without such a figure does not pass.
ExperimentReport VelocityReport(const TrialTable& table);

}  // namespace palace
