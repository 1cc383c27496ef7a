// palacectl calibrate: pictures of a target through both cameras -> two CAHVOR models and RIG.toml.
#pragma once

namespace CLI {
class App;
}

namespace palace {

/// Adds the verb. After parsing, exit_code is 0 done and accepted, 1 failed or not accepted (the
/// files are written all the same, report.html says why), 2 bad usage.
void AddCalibrateCommand(CLI::App& app, int& exit_code);

}  // namespace palace
