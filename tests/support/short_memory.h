// Memory that can be made to fail on purpose, one thread's at a time. Of one file of a program
// only: it replaces operator new of the whole program.
#pragma once

#include <cstdlib>
#include <new>

namespace palace::short_memory {

/// Allocations of this thread until one fails, that one alone; negative: none does.
inline thread_local long allocations_left = -1;
inline thread_local bool failed = false;  ///< one did

}  // namespace palace::short_memory

__attribute__((noinline)) void* operator new(std::size_t size) {
  using namespace palace::short_memory;
  if (allocations_left == 0) {
    allocations_left = -1;
    failed = true;
    throw std::bad_alloc();
  }
  allocations_left -= allocations_left > 0 ? 1 : 0;
  void* memory = std::malloc(size == 0 ? 1 : size);
  if (memory == nullptr) {
    throw std::bad_alloc();
  }
  return memory;
}
__attribute__((noinline)) void operator delete(void* memory) noexcept { std::free(memory); }
__attribute__((noinline)) void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
