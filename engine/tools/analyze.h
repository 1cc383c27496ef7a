// palacectl analyze: one stereo pair, elevation model or point cloud -> maps and landing site.
#pragma once

#include <CLI/CLI.hpp>

namespace palace {

/// Adds the verb with its options. Running it sets `exit_code`: 0 done, 1 failed, 2 bad usage.
void AddAnalyzeCommand(CLI::App& app, int& exit_code);

}  // namespace palace
