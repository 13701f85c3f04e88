// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Counts the allocations of a test program. It defines malloc: only one source of a program may include it.
#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <new>

namespace trk_bridge::test {

inline std::atomic<std::uint64_t> allocations{0};

/// How often `work` allocates, including in other threads.
template <typename Work>
std::uint64_t allocations_of(const Work& work) {
  const std::uint64_t before = allocations.load();
  work();
  return allocations.load() - before;
}

}  // namespace trk_bridge::test

// Eigen calls malloc, not operator new, and operator new calls malloc: malloc sees both. glibc lets a program replace
// malloc.
extern "C" void* __libc_malloc(std::size_t size);
extern "C" void* malloc(std::size_t size) {
  trk_bridge::test::allocations.fetch_add(1, std::memory_order_relaxed);
  return __libc_malloc(size);
}

TEST(Allocation, IsSeenByThisTest) {
  void* volatile block = nullptr;
  EXPECT_EQ(trk_bridge::test::allocations_of([&block] { block = ::operator new(100); }), 1U);
  ::operator delete(block);
}
