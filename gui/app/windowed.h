// The real window.
#pragma once

#include <optional>

#include "gui/app/options.h"
#include "gui/app/script.h"
#include "gui/app/session.h"

namespace palace {

/// Runs until the window is closed or the script ends. Returns the exit code.
int RunWindowed(const AppOptions& options, Session& session,
                std::optional<std::vector<ScriptLine>> script, const std::string& script_name);

}  // namespace palace
