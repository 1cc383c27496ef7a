// App: from the command line to the exit code.
#pragma once

#include "gui/app/intent.h"
#include "gui/app/options.h"

namespace palace {

/// 0 done, 1 failed, 2 bad usage. Every failure is one message on stderr.
int RunApp(const AppOptions& options);

/// Of the station that follows one started with `options`: the same flight again, or a look at its
/// log, which is no new flight and records nothing.
AppOptions OptionsOfNext(AppOptions options, const NextFlight& next);

}  // namespace palace
