// How much memory this program may still ask for.
#pragma once

#include <cstddef>

#include "engine/core/result.h"

namespace palace {

/// kUnavailable, in one sentence with the remedy, when the address space that this program may use
/// (ulimit -v) has no room for so much more, or the whole machine has less: better said at the
/// start than found out in flight.
Status EnoughMemory(std::size_t mebibytes);

}  // namespace palace
