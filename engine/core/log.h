// Log lines for people: info, warning, error. Never per frame.
#pragma once

#include <string_view>

namespace palace {

void LogInfo(std::string_view text);
void LogWarning(std::string_view text);
void LogError(std::string_view text);
/// Sends every line to stderr without time stamps, as command-line tools do.
void InitLogging(bool verbose);

}  // namespace palace
