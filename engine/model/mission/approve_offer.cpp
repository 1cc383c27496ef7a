#include "engine/model/mission/approve_offer.h"

#include <cstdio>

#include "engine/core/rounding.h"

namespace palace {

std::string WhyScreenOld(double silent_s) {
  if (silent_s <= kScreenOld_s) {
    return {};
  }
  char text[64];
  std::snprintf(text, sizeof text, "Screen %.1f s behind, limit %.1f s", -TenthsDown(-silent_s),
                kScreenOld_s);
  return text;
}

}  // namespace palace
