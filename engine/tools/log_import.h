// palacectl log import: pictures, poses and IMU of other people's data as a log.
#pragma once

#include <CLI/CLI.hpp>

namespace palace {

/// Adds the verb to `log`. Exit code 0 done, 1 failed, 2 bad usage, 3 something was left out.
void AddLogImport(CLI::App& log, int& exit_code);

}  // namespace palace
