#include "gui/app/app.h"

#include <optional>

#include "engine/core/log.h"
#include "gui/app/exit_code.h"
#include "gui/app/run.h"
#include "gui/app/script.h"
#include "gui/app/session.h"

namespace palace {
int RunApp(const AppOptions& options) {
  InitLogging(options.verbose);
  std::optional<std::vector<ScriptLine>> script;
  std::string script_name = options.script_file;
  if (!options.script_file.empty()) {
    Result<std::vector<ScriptLine>> lines = LoadScript(options.script_file);
    if (!lines) {
      return FailWith(lines.error());
    }
    script = std::move(*lines);
  } else if (options.headless) {
    script_name = "the default script";
    const bool mission = options.source == SourceChoice::kSimulation;
    Result<std::vector<ScriptLine>> lines =
        ParseScript(mission ? DefaultMissionScript() : DefaultViewScript(), script_name);
    PALACE_CHECK(lines.ok(), lines.error().message);
    script = std::move(*lines);
  }
  Result<Session> session = OpenSession(options, /*threaded=*/!options.headless);
  if (!session) {
    return FailWith(session.error());
  }
  return RunStation(options, *session, std::move(script), script_name);
}

}  // namespace palace
