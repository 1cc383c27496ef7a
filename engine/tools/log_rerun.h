// palacectl log rerun: a log through the pipeline again, without a window, into tables and maps.
#pragma once

#include <CLI/CLI.hpp>

namespace palace {

/// Adds the verb below `log`. Exit 0 done, 1 nothing readable, 2 bad usage, 3 a damaged log.
void AddLogRerun(CLI::App& log, int& exit_code);

}  // namespace palace
