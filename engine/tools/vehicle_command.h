// palacectl vehicle: the vehicles that there are, and what a vehicle file says.
#pragma once

namespace CLI {
class App;
}

namespace palace {

/// Adds the verb. After parsing, exit_code is 0 done, 1 failed, 2 bad usage.
void AddVehicleCommand(CLI::App& app, int& exit_code);

}  // namespace palace
