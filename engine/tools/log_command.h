// palacectl log info|verify|repair|cut|export|rerun LOG
#pragma once

namespace CLI {
class App;
}

namespace palace {

/// Adds the verb. After parsing, exit_code is 0 whole, 3 damaged but read, 1 nothing readable.
void AddLogCommand(CLI::App& app, int& exit_code);

}  // namespace palace
