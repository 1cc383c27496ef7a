#include "engine/core/log.h"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

namespace palace {

void LogInfo(std::string_view text) { spdlog::info("{}", text); }
void LogWarning(std::string_view text) { spdlog::warn("{}", text); }
void LogError(std::string_view text) { spdlog::error("{}", text); }

void InitLogging(bool verbose) {
  spdlog::set_default_logger(std::make_shared<spdlog::logger>(
      "palace", std::make_shared<spdlog::sinks::stderr_color_sink_mt>()));
  spdlog::set_pattern("palace: %^%l%$: %v");
  spdlog::set_level(verbose ? spdlog::level::debug : spdlog::level::info);
}

}  // namespace palace
