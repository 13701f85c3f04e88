// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// An abandoned sink does not run unloaded code.
#include <string>

#include <dlfcn.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include "deadline.h"
#include "temporary_directory.h"

namespace trk_bridge::test::outlet_unload_test {

TEST(OutletUnload, AnAbandonedSinkContinuesWhenItsLibraryIsUnloaded) {
  constexpr int capacity = 4096, records = capacity + 500;
  const TemporaryDirectory directory;
  const std::string fifo = directory / "fifo";
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  const int reader = ::open(fifo.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  ASSERT_EQ(::fcntl(reader, F_SETPIPE_SZ, capacity), capacity);
  void* module = ::dlopen(OUTLET_MODULE, RTLD_NOW | RTLD_LOCAL);
  ASSERT_NE(module, nullptr) << ::dlerror();
  auto* leave_stuck = reinterpret_cast<bool (*)(const char*, int)>(::dlsym(module, "leave_stuck"));
  ASSERT_TRUE(leave_stuck != nullptr && leave_stuck(fifo.c_str(), records));
  ASSERT_EQ(::dlclose(module), 0);
  // A reader now gets everything, and then the end.
  ssize_t received = 0;
  pollfd watched{reader, POLLIN, 0};
  while (::poll(&watched, 1, static_cast<int>(std::chrono::milliseconds(deadline).count())) == 1) {
    char chunk[4096];
    const ssize_t got = ::read(reader, chunk, sizeof chunk);
    if (got <= 0) break;
    received += got;
  }
  ::close(reader);
  EXPECT_EQ(received, records);
}

}  // namespace trk_bridge::test::outlet_unload_test
