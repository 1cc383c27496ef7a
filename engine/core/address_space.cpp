#include "engine/core/address_space.h"

#include <sys/mman.h>
#include <sys/sysinfo.h>

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
  struct sysinfo machine {};
  if (sysinfo(&machine) == 0) {
    const std::size_t there_MiB =
        (std::size_t{machine.totalram} + machine.totalswap) * machine.mem_unit >> 20;
    if (mebibytes > there_MiB) {  // the kernel would promise it, and kill for it later
      return UnavailableError("out of memory: " + std::to_string(mebibytes) +
                              " MiB are needed, this machine has " + std::to_string(there_MiB) +
                              " MiB with its swap space; ask for less, or use a larger one");
    }
  }
  return Ok();
}

}  // namespace palace
