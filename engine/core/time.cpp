#include "engine/core/time.h"

#include <chrono>
#include <ctime>

namespace palace {

Timestamp WallTime() {
  using namespace std::chrono;
  return {duration_cast<microseconds>(system_clock::now().time_since_epoch()).count()};
}

double MonotonicSeconds() {
  // Linux: it goes on while the machine sleeps, as the vehicle does.
  timespec now{};
  clock_gettime(CLOCK_BOOTTIME, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace palace
