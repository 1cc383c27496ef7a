#include "engine/mission/limits.h"

#include <cstdio>

namespace palace {

std::string LimitWords(const Limit& limit) {
  if (!std::isfinite(limit.value)) {
    return {};
  }
  char text[64];
  std::snprintf(text, sizeof text, "%.*f%s%s", limit.decimals, limit.value,
                *limit.unit == '\0' ? "" : " ", limit.unit);
  return text;
}

}  // namespace palace
