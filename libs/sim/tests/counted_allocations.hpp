// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <new>

// Counts every allocation of the program. It replaces the global operators, so one source of a
// program of its own includes it.
namespace rave::sim::testing {

/// So many until now, by all threads.
inline std::atomic<std::uint64_t> allocations{0};

}  // namespace rave::sim::testing

// Not inlined: the compiler would take malloc and delete for a pair that does not match.
// NOLINTBEGIN(misc-new-delete-overloads, misc-definitions-in-headers)
__attribute__((noinline)) void* operator new(std::size_t size) {
  ++rave::sim::testing::allocations;
  void* const memory = std::malloc(size == 0 ? 1 : size);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
__attribute__((noinline)) void operator delete(void* memory) noexcept { std::free(memory); }
__attribute__((noinline)) void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
// NOLINTEND(misc-new-delete-overloads, misc-definitions-in-headers)
