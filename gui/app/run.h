// Run: the loop of the program, with or without a window.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gui/app/options.h"
#include "gui/app/script.h"
#include "gui/app/session.h"

namespace palace {

/// Input, engine, user interface, commands, frame after frame, until somebody quits or the script
/// ends. Then the log is closed and the report written. Returns the exit code.
int RunStation(const AppOptions& options, Session& session,
               std::optional<std::vector<ScriptLine>> script, const std::string& script_name);

}  // namespace palace
