// The entry that libFuzzer calls. One program a target: PALACE_FUZZ_TARGET is its name.
#include <cstddef>
#include <string_view>

#include "tests/fuzz/fuzz_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const palace::FuzzTarget target = [] {
    for (const palace::FuzzTarget& each : palace::FuzzTargets()) {
      if (each.name == std::string_view(PALACE_FUZZ_TARGET)) {
        return each;
      }
    }
    __builtin_trap();  // CMakeLists.txt names a target that is not there
  }();
  target.run({data, size});
  return 0;
}
