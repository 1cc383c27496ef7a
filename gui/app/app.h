// App: from the command line to the exit code.
#pragma once

#include "gui/app/options.h"

namespace palace {

/// 0 done, 1 failed, 2 bad usage. Every failure is one message on stderr.
int RunApp(const AppOptions& options);

}  // namespace palace
