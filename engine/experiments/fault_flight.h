// One flight under one fault, as `evaluate faults` tells it.
//
//   armed    the fault begins when a site is armed; the operator tries to approve from 4 s to 8 s
//            after it, selecting again where that is offered
//   descent  the fault begins 4 s into the descent; flown until 3 s after it ended, or 70 s
//
// "Measured ground" is held against the truth: a third of a grid of pixels must know its depth, and
// know it within 0.3 m or 5 % of what the ray meets from where the camera truly is.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/experiments/fault_cases.h"
#include "engine/model/mission/mission_status.h"
#include "engine/model/settings/settings.h"
#include "engine/simulation/simulator.h"

namespace palace {

enum class FaultPhase : std::uint8_t { kArmed, kDescent };
const char* FaultPhaseName(FaultPhase phase);

struct RaisedAlarm {
  AlarmId id = AlarmId::kHold;
  double after_s = NAN;
  std::string text{};
};

struct FaultOutcome {
  bool struck = false;                       ///< the flight came so far that the fault began
  std::vector<RaisedAlarm> raised{};         ///< each id once, that did not stand before, in order
  bool approved = false;                     ///< armed: after the fault
  std::string blocked_by{};                  ///< armed: why not, 4 s after it
  MissionState end = MissionState::kNoLive;  ///< descent: HOLD, ABORTING, LANDED, or as it was
  double end_s = NAN;                        ///< after the fault
  std::string why{};                         ///< of that state
  double miss_m = NAN;                       ///< true, when landed
  double ground_s = NAN;                     ///< newest measured ground, after the fault
  double unseen_m = NAN;  ///< landed: true height of the skids when ground was measured last
  bool recorded = false;  ///< every alarm raised, and the end, are events in the record
};

struct FaultFlight {
  std::string scenario = "runway";
  double wind_mps = 3;
  std::uint64_t seed = 1;
  Settings settings{};
};

Result<FaultOutcome> FlyUnderFault(const FaultFlight& flight, const FaultCase& fault,
                                   FaultPhase phase, const SceneCameraFactory& camera);

/// What the outcome falls short of, in words; empty when it is as the case asks.
std::vector<std::string> Shortfalls(const FaultCase& fault, FaultPhase phase,
                                    const FaultOutcome& outcome);

}  // namespace palace
