// palacectl simulate: the vehicle and its scene as a process of their own.
#pragma once

#include "engine/simulation/simulator.h"

namespace CLI {
class App;
}

namespace palace {

/// Adds the verb. `cameras` makes the renderer of a scene; the program that links GL hands it in.
void AddSimulateCommand(CLI::App& app, int& exit_code, SceneCameraFactory cameras);

}  // namespace palace
