// palacectl trust: the key files of stations and vehicles.
#pragma once

namespace CLI {
class App;
}

namespace palace {

/// Adds the verb. After parsing, exit_code is 0 done, 1 failed, 2 bad usage.
void AddTrustCommand(CLI::App& app, int& exit_code);

}  // namespace palace
