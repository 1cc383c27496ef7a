// The whole window without a display, stepped with the engine and driven by a script.
#pragma once

#include "gui/app/options.h"
#include "gui/app/script.h"
#include "gui/app/session.h"

namespace palace {

/// One engine pass, then one frame of the user interface, and so on: the same flight whatever the
/// machine's speed. Pixels are made only for screenshots. Returns the exit code.
int RunHeadless(const AppOptions& options, Session& session, std::vector<ScriptLine> script,
                const std::string& script_name);

}  // namespace palace
