// palacectl camera: camera model files on the command line.
#pragma once

namespace CLI {
class App;
}

namespace palace {

/// Adds `camera project|backproject|convert|info|align`. Running one sets `exit_code`: 0 done,
/// 1 failed (the message names file, line and remedy), 2 bad usage.
void AddCameraCommand(CLI::App& app, int& exit_code);

}  // namespace palace
