#include "engine/core/address_space.h"

#include <sys/mman.h>

#include <string>

namespace palace {

Status EnoughMemory(std::size_t mebibytes) {
  const std::size_t bytes = mebibytes << 20;
  void* room = mmap(nullptr, bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (room == MAP_FAILED) {
    return UnavailableError("out of memory: no room for " + std::to_string(mebibytes) +
                            " MiB more; allow this program more (ulimit -v) or end other programs");
  }
  munmap(room, bytes);
  return Ok();
}

}  // namespace palace
