// How the program ends on an error: said on the terminal, and in its exit code.
#pragma once

#include <cstdio>

#include "engine/core/result.h"

namespace palace {

/// Prints the error; 2 where the command line is at fault, else 1.
inline int FailWith(const Error& error) {
  std::fprintf(stderr, "palace: %s\n", error.message.c_str());
  return error.code == ErrorCode::kUsage ? 2 : 1;
}

}  // namespace palace
