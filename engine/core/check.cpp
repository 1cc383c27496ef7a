#include "engine/core/check.h"

#include <cstdio>
#include <cstdlib>

namespace palace {

void CheckFailed(const char* condition, const char* file, int line, const std::string& values) {
  std::fprintf(stderr, "%s:%d: check failed: %s%s%s\n", file, line, condition,
               values.empty() ? "" : ", values:", values.c_str());
  std::abort();
}

}  // namespace palace
