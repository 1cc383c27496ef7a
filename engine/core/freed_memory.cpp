#include "engine/core/freed_memory.h"

#include <cstdlib>  // says whether this is glibc

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace palace {

void KeepFreedMemory() {
#if defined(__GLIBC__)
  constexpr int kMiB = 1 << 20;
  // The largest threshold that glibc allows on 64 bits.
  if (mallopt(M_MMAP_THRESHOLD, 32 * kMiB) == 1) {
    mallopt(M_TRIM_THRESHOLD, 256 * kMiB);
  }
#endif
}

}  // namespace palace
