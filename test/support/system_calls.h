// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Counts the system calls of a thread.
#pragma once

#include <gtest/gtest.h>
#include <sys/ptrace.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <map>
#include <optional>

namespace trk_bridge::test {

/// How often each, by its number (SYS_…).
using SystemCalls = std::map<long, int>;

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define TRK_BRIDGE_WITH_SANITIZER
#endif
#endif
/// Whether a call is of a sanitizer, which maps memory for itself whenever it needs some.
inline bool is_of_sanitizer([[maybe_unused]] long number) {
#ifdef TRK_BRIDGE_WITH_SANITIZER
  return number == SYS_mmap || number == SYS_munmap || number == SYS_madvise;
#else
  return false;
#endif
}

inline int total(const SystemCalls& calls) {
  int sum = 0;
  for (const auto& [number, count] : calls) sum += count;
  return sum;
}

/// Runs `work` in a child process: `work(counted)` prepares, calls `counted(part)`, and returns whether it succeeded.
/// Returns the system calls of `part` by the thread that runs it; none if `work` failed, or with `is_permitted` false
/// if this process may not trace.
template <typename Work>
std::optional<SystemCalls> system_calls_of(const Work& work, bool& is_permitted) {
  // Calls that do nothing, with an argument that no other code passes.
  constexpr long begin = -1234567, end = -1234568;
  constexpr int not_permitted = 3;
  is_permitted = true;
  const pid_t child = ::fork();
  if (child < 0) return {};
  if (child == 0) {
    if (::ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) != 0) ::_exit(not_permitted);
    ::raise(SIGSTOP);
    const bool well = work([](const auto& part) {
      ::syscall(SYS_getpgid, begin);
      part();
      ::syscall(SYS_getpgid, end);
    });
    ::_exit(well ? 0 : 1);
  }
  SystemCalls calls;
  bool counts = false;
  int status = 0;
  while (::waitpid(child, &status, __WALL) == child && WIFSTOPPED(status)) {
    const int signal = WSTOPSIG(status);
    const bool is_call = signal == (SIGTRAP | 0x80);
    if (is_call) {
      __ptrace_syscall_info info{};
      ::ptrace(PTRACE_GET_SYSCALL_INFO, child, sizeof info, &info);
      if (info.op == PTRACE_SYSCALL_INFO_ENTRY) {
        const auto number = static_cast<long>(info.entry.nr);
        const auto argument = static_cast<int>(info.entry.args[0]);
        const bool is_mark = number == SYS_getpgid && (argument == begin || argument == end);
        if (is_mark) counts = argument == begin;
        if (counts && !is_mark && !is_of_sanitizer(number)) ++calls[number];
      }
    } else {
      ::ptrace(PTRACE_SETOPTIONS, child, nullptr, PTRACE_O_TRACESYSGOOD | PTRACE_O_EXITKILL);
    }
    const bool is_for_child = !is_call && signal != SIGSTOP && signal != SIGTRAP;
    ::ptrace(PTRACE_SYSCALL, child, nullptr, is_for_child ? signal : 0);
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == not_permitted) is_permitted = false;
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) return {};
  return calls;
}

}  // namespace trk_bridge::test
