// Run: the loop of the program, with or without a window.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/core/termination.h"
#include "gui/app/intent.h"
#include "gui/app/options.h"
#include "gui/app/script.h"
#include "gui/app/session.h"
#include "gui/widgets/ui_frame.h"

namespace palace {

/// How a session ended.
struct StationEnd {
  int exit_code = 0;
  std::optional<NextFlight> next{};       ///< what the operator asked for after it
  std::vector<ScriptLine> script_left{};  ///< lines that are for what comes next
  int width_px = 0, height_px = 0;        ///< of the window as it was; 0: it never opened
};

/// Input, engine, user interface, commands, frame after frame, until somebody quits or the script
/// ends, or a signal asks to: then the exit code is 128 and the signal. The log is closed and the
/// report written. `after_review` is offered while the session shows a record.
StationEnd RunStation(const AppOptions& options, const Termination& termination, Session& session,
                      const WayOut& after_review, std::optional<std::vector<ScriptLine>> script,
                      const std::string& script_name);

}  // namespace palace
