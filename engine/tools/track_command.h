// palacectl track: follows a feature through a film, a folder of pictures or a live camera.
#pragma once

namespace CLI {
class App;
}

namespace palace {

/// Adds the verb. After parsing, exit_code is 0 done, 1 failed, 2 bad usage.
void AddTrackCommand(CLI::App& app, int& exit_code);

}  // namespace palace
