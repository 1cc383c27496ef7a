#include "engine/core/lanes/instruction_sets.h"

namespace palace {

bool Has([[maybe_unused]] InstructionSet set) {
#if defined(__x86_64__)
  return set == InstructionSet::kAvx512 ? __builtin_cpu_supports("avx512f") != 0
                                        : __builtin_cpu_supports("avx2") != 0;
#else
  return false;
#endif
}

}  // namespace palace
