// Memory for a key is locked and may run out: an exception like that of any other allocation.
#include <sys/resource.h>

#include <array>
#include <fstream>
#include <new>
#include <optional>

#include <gtest/gtest.h>

#include "engine/trust/secret_key.h"

namespace palace {
namespace {

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
/// Makes keys until there is no room for more; ends the process with 7 when it is told so.
void MakeKeysWithoutEnd() {
  static std::array<std::optional<SecretKey>, 100000> keys;
  keys[0] = SecretKey::FromSeed(1);
  rlim_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  const rlim_t most = pages * 4096 + (8u << 20);
  const rlimit limit{most, most};
  setrlimit(RLIMIT_AS, &limit);
  try {
    for (std::optional<SecretKey>& key : keys) {
      key = SecretKey::FromSeed(1);
    }
  } catch (const std::bad_alloc&) {
    _exit(7);
  }
  _exit(1);
}

TEST(SecretKeyMemory, WithoutMemoryAKeyIsAnExceptionAndNotTheEnd) {
  EXPECT_EXIT(MakeKeysWithoutEnd(), testing::ExitedWithCode(7), "");
}
#endif

}  // namespace
}  // namespace palace
