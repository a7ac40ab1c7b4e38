// SPDX-License-Identifier: BSD-3-Clause
// Takes the place of the C library's allocation for the whole process, also for the libraries it uses.
#include "largest_allocation.h"

#include <atomic>

extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* block, std::size_t size);
}

namespace {

std::atomic<std::size_t> largest{0};

void note(std::size_t size) {
  std::size_t before = largest.load(std::memory_order_relaxed);
  while (size > before && !largest.compare_exchange_weak(before, size, std::memory_order_relaxed)) {
  }
}

}  // namespace

extern "C" {

void* malloc(std::size_t size) {
  note(size);
  return __libc_malloc(size);
}

void* calloc(std::size_t count, std::size_t size) {
  std::size_t bytes = 0;
  note(__builtin_mul_overflow(count, size, &bytes) ? static_cast<std::size_t>(-1) : bytes);
  return __libc_calloc(count, size);
}

void* realloc(void* block, std::size_t size) {
  note(size);
  return __libc_realloc(block, size);
}

}  // extern "C"

namespace mlsmesh::test {

void resetLargestAllocation() {
  largest = 0;
}

std::size_t largestAllocation() {
  return largest;
}

}  // namespace mlsmesh::test
