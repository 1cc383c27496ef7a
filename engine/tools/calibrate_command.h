// palacectl calibrate: pictures of a target through both cameras -> two CAHVOR models and RIG.toml.
#pragma once

namespace CLI {
class App;
}

namespace palace {

/// Adds the verb. After parsing, exit_code is 0 done and accepted, 1 failed or not accepted (the
/// files are written all the same, report.html and the top of RIG.toml say why), 2 bad usage or a
/// folder that holds a calibration already (--overwrite).
void AddCalibrateCommand(CLI::App& app, int& exit_code);

}  // namespace palace
