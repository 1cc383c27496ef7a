// palacectl worlds: the simulated worlds by name, and pictures of them.
#pragma once

namespace CLI {
class App;
}

namespace palace {

/// Adds the verb. After parsing, exit_code is 0 done, 1 failed, 2 bad usage.
void AddWorldsCommand(CLI::App& app, int& exit_code);

}  // namespace palace
