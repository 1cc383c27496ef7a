// FaultPlan: what fails in a simulated flight and when, from a command line and from a file.
//
// A file is TOML, one [[fault]] a fault: kind, and if wanted value, channel, from_s, to_s, as
// fault_text.h has them. Anything else in it, and more than kMostFaults, is refused; errors name
// file, line, key, value and limit, of every fault that is wrong its first one.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "engine/faults/fault.h"

namespace palace {

/// A flight has not more.
inline constexpr std::size_t kMostFaults = 100;

struct FaultPlan {
  std::vector<Fault> faults;
};

inline constexpr const char* kFaultHelp =
    "A fault of the simulated flight, kind[=value][@CHANNEL][:from-to] with seconds of flight, "
    "e.g. "
    "gps_jump=3:20-30 or missing@GPS:12-; may be repeated. Kinds: palacectl faults";
inline constexpr const char* kFaultsHelp =
    "A file of such faults (TOML, [[fault]] tables; README, \"Faults\")";

/// `name` stands for the file in messages.
Result<FaultPlan> ParseFaultPlan(std::string_view text, const std::string& name);
/// The text of such a file; numbers to the bit.
std::string FaultPlanText(const FaultPlan& plan);
/// Its text cannot be read: a usage error.
Result<FaultPlan> LoadFaultPlan(const std::string& file);
/// Of a command line, where every error is one of usage, as with settings: the file's faults, if
/// one is named, then those given as text.
Result<FaultPlan> ReadFaultPlan(const std::string& file, const std::vector<std::string>& texts);

}  // namespace palace
