#include "engine/mission/limits.h"

#include <cstdio>
#include <string_view>

namespace palace {

std::string LimitWords(const Limit& limit) {
  if (!std::isfinite(limit.value)) {
    return {};
  }
  char text[64];
  // The degree sign follows its digit.
  const bool apart = *limit.unit != '\0' && std::string_view(limit.unit) != "°";
  std::snprintf(text, sizeof text, "%.*f%s%s", limit.decimals, limit.value, apart ? " " : "",
                limit.unit);
  return text;
}

}  // namespace palace
