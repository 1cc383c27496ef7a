// palacectl capture: stereo pairs from the cameras of RIG.toml as PNG files.
#pragma once

namespace CLI {
class App;
}

namespace palace {

/// Adds the verb. After parsing, exit_code is 0 done, 1 failed, 2 bad usage.
void AddCaptureCommand(CLI::App& app, int& exit_code);

}  // namespace palace
