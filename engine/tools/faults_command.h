// palacectl faults: what can be injected into a simulated flight.
#pragma once

namespace CLI {
class App;
}

namespace palace {

void AddFaultsCommand(CLI::App& app, int& exit_code);

}  // namespace palace
