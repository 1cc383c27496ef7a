// A fault as text, on command lines, in scripts and in words for people. One form, both ways:
//
//   kind[=value][@CHANNEL][:from-to]       gps_jump=3:20-30   missing@GPS:12-   camera_black
//
// Kinds are the names of FaultKindTable, values in its units, channels the names of LCM channels
// ("CAMERA_LEFT"), times seconds of true flight. Without a value the table's default; without a
// channel all that the kind can strike; without times the whole flight; without an end until its
// end. FaultText(ParseFault(t)) says the same fault as t, numbers to the bit.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "engine/core/result.h"
#include "engine/faults/fault.h"

namespace palace {

/// Usage errors: they name the text, the part of it, and what may stand there. Checked with
/// CheckFault.
Result<Fault> ParseFault(std::string_view text);
std::string FaultText(const Fault& fault);

/// For people: "GPS jump", "camera black".
std::string FaultKindWords(FaultKind kind);
/// Of one fault, without its times: "GPS jump 3 m", "camera black on camera left".
std::string FaultWords(const Fault& fault);

/// As few digits as give the number back to the bit.
std::string ExactNumber(double value);

/// "CAMERA_LEFT": the default name of the LCM channel, whatever channels.toml calls it.
std::string FaultChannelName(ChannelId id);
/// Of the channels that the vehicle sends.
std::optional<ChannelId> FindFaultChannel(std::string_view name);
std::optional<FaultKind> FindFaultKind(std::string_view name);

}  // namespace palace
