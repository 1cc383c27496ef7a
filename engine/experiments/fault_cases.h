// The cases of `evaluate faults`: what fails, what people must be told, and what must not happen.
//
// Source: reference/reliability.md 4 (F01-F25), which gives the time to detection and what blocks.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "engine/faults/fault.h"
#include "engine/model/mission/mission_ids.h"

namespace palace {

/// What a descent does about a fault.
enum class DescentMust : std::uint8_t {
  kStop,  ///< held or aborted before the commit height, or landed on ground it has seen since
  kLand,  ///< the landing goes on, and is on the site
  kEither,
};

struct FaultCase {
  const char* name;  ///< "right camera black"
  const char* row;   ///< of the table of faults: "F02"
  std::vector<Fault> faults{};
  std::vector<AlarmId> cause{};  ///< each of them names it rightly
  double within_s = 1;           ///< from the fault to such an alarm
  bool blocks = true;            ///< approval
  DescentMust descent = DescentMust::kStop;
  bool of_cameras = false;         ///< a row of the table of cameras
  bool silent = false;             ///< nobody needs to be told: nothing is wrong with what is used
  bool garbled = false;            ///< what comes may look like any other fault, too
  std::vector<AlarmId> besides{};  ///< right as well, but they do not name it
};

std::span<const FaultCase> FaultCases();
/// An alarm that says what a fault did, whatever it was: on hold, no site, vision lost.
bool IsConsequence(AlarmId id);

}  // namespace palace
