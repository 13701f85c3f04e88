// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Transfer by shared memory, and all its misuses.
#include <algorithm>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <sys/shm.h>
#include <sys/wait.h>
#include <unistd.h>

#include "c_records.h"
#include "deadline.h"
#include "free_slot.h"
#include "trk_file.h"
#include "trk_mem.h"
#include "trk_net.h"

namespace trk_bridge::c_api::memory_test {

using trk_bridge::test::becomes_true;
using trk_bridge::test::constants_in_c;
using trk_bridge::test::FreeSlot;
using trk_bridge::test::no_handles;
using trk_bridge::test::params_in_c;
using trk_bridge::test::text_of;

class Memory : public ::testing::Test {
 protected:
  ~Memory() override {
    trkMemConfigure(trkMemDefault);
    trkMemCloseAll();
  }
  FreeSlot slot;
  trkHandle writer = nullptr, reader = nullptr;
  trkCameraParams p{};
  trkCameraConstants c{};
};

TEST_F(Memory, passes_parameters_and_constants) {
  ASSERT_EQ(trkMemOpen(slot.number(), &writer), trkOK);
  ASSERT_EQ(trkMemOpen(slot.number(), &reader), trkOK);
  EXPECT_EQ(trkMemReadParams(reader, &p), trkUnavailable);
  EXPECT_EQ(trkMemReadConstants(reader, &c), trkUnavailable);
  const trkCameraParams sent = params_in_c(5);
  ASSERT_EQ(trkMemWriteConstants(writer, &constants_in_c), trkOK);
  ASSERT_EQ(trkMemWriteParams(writer, &sent), trkOK);
  ASSERT_EQ(trkMemReadParams(reader, &p), trkOK);
  EXPECT_EQ(text_of(p), text_of(sent));
  EXPECT_EQ(trkMemReadParams(reader, &p), trkUnavailable);
  ASSERT_EQ(trkMemReadConstants(reader, &c), trkOK);
  EXPECT_EQ(text_of(c), text_of(constants_in_c));
  EXPECT_EQ(trkMemReadConstants(reader, &c), trkUnavailable);
  ASSERT_EQ(trkMemWriteConstants(writer, &constants_in_c), trkOK);
  EXPECT_EQ(trkMemReadConstants(reader, &c), trkOK) << "a set that is written again is new";
}

TEST_F(Memory, numbers_that_are_not_finite_are_neither_written_nor_read) {
  ASSERT_EQ(trkMemOpen(slot.number(), &writer), trkOK);
  ASSERT_EQ(trkMemOpen(slot.number(), &reader), trkOK);
  // Like another program: the record and its counter, byte for byte, into a segment of 544 bytes.
  auto* const segment = static_cast<char*>(::shmat(slot.segment(), nullptr, 0));
  ASSERT_NE(segment, reinterpret_cast<char*>(-1));
  constexpr std::size_t counter_at = 12, params_at = 16, params_size = 200, transform_at = 8, numbers_size = 23 * 8;
  const auto write_as_it_is = [&](const trkCameraParams& params) {
    std::uint16_t count = 0;
    std::memcpy(&count, segment + counter_at, sizeof count);
    ++count;
    char* const record = segment + params_at + (count & 1U) * params_size;
    const unsigned head[] = {0, params.format};
    std::memcpy(record, head, sizeof head);
    std::memcpy(record + transform_at, &params.t, numbers_size);
    const std::uint64_t counter = params.counter;
    std::memcpy(record + transform_at + numbers_size, &counter, sizeof counter);
    std::memcpy(segment + counter_at, &count, sizeof count);
  };
  struct Case {
    unsigned format;
    std::vector<std::size_t> selected;  // the numbers from the transform on that its format has
  };
  std::vector<std::size_t> euler = {0, 1, 2, 3, 4, 5, 16, 17, 18, 19, 20, 21, 22}, matrix(23);
  std::iota(matrix.begin(), matrix.end(), 0U);
  for (const auto& [format, selected] : {Case{trkEuler, euler}, Case{trkMatrix, matrix}}) {
    for (std::size_t i = 0; i < 23; ++i) {
      for (const double number : {std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity()}) {
        trkCameraParams bad = params_in_c(5);
        bad.format = format;
        if (format == trkMatrix) bad.t = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
        std::memcpy(reinterpret_cast<char*>(&bad.t) + i * sizeof number, &number, sizeof number);
        const bool is_selected = std::count(selected.begin(), selected.end(), i) > 0;
        EXPECT_EQ(trkMemWriteParams(writer, &bad), is_selected ? trkFailed : trkOK) << i;
        EXPECT_EQ(trkMemReadParams(reader, &p), is_selected ? trkUnavailable : trkOK) << i;
        write_as_it_is(bad);
        EXPECT_EQ(trkMemReadParams(reader, &p), is_selected ? trkInvalidVersion : trkOK) << i;
        EXPECT_TRUE(is_selected || p.t.m[i / 4][i % 4] == 0) << "what the format does not select";
      }
    }
  }
  ::shmdt(segment);
}

TEST_F(Memory, the_last_close_removes_it) {
  ASSERT_EQ(trkMemOpen(slot.number(), &writer), trkOK);
  ASSERT_EQ(trkMemOpen(slot.number(), &reader), trkOK);
  EXPECT_EQ(trkMemClose(writer), trkOK);
  EXPECT_TRUE(slot.has_file());
  EXPECT_EQ(trkMemClose(reader), trkOK);
  EXPECT_FALSE(slot.has_file());
  EXPECT_EQ(slot.segment(), -1);
}

TEST_F(Memory, all_are_closed_at_once_any_number_of_times) {
  ASSERT_EQ(trkMemOpen(slot.number(), &writer), trkOK);
  ASSERT_EQ(trkMemOpen(slot.number(), &reader), trkOK);
  trkMemCloseAll();
  trkMemCloseAll();
  EXPECT_FALSE(slot.has_file());
  EXPECT_EQ(trkMemClose(writer), trkInvalidHandle);
}

TEST_F(Memory, configures_every_documented_flag) {
  for (const unsigned kind : {unsigned{trkMemDefault}, unsigned{trkMemSysV}, unsigned{trkMemArena}}) {
    for (const unsigned recreate : {0U, unsigned{trkMemRecreate}}) {
      trkMemConfigure(kind | recreate);
      ASSERT_EQ(trkMemOpen(slot.number(), &writer), trkOK);
      EXPECT_EQ(trkMemClose(writer), trkOK);
    }
  }
  EXPECT_EQ(trkMemRecreate, 0x10);
}

TEST_F(Memory, recreate_replaces_it_when_all_others_have_detached) {
  trkMemConfigure(trkMemDefault | trkMemRecreate);
  ASSERT_EQ(trkMemOpen(slot.number(), &writer), trkOK);
  ASSERT_EQ(trkMemOpen(slot.number(), &reader), trkOK);
  const trkCameraParams sent = params_in_c(1);
  ASSERT_EQ(trkMemWriteConstants(writer, &constants_in_c), trkOK);
  ASSERT_EQ(trkMemWriteParams(writer, &sent), trkOK);
  const int before = slot.segment();
  ASSERT_EQ(trkMemClose(reader), trkOK);
  ASSERT_EQ(trkMemWriteParams(writer, &sent), trkOK);
  EXPECT_NE(slot.segment(), before);
  ASSERT_EQ(trkMemOpen(slot.number(), &reader), trkOK);
  EXPECT_EQ(trkMemReadConstants(reader, &c), trkOK) << "the contents are included";
}

std::size_t size_of(const FreeSlot& slot) {
  shmid_ds state{};
  return ::shmctl(slot.segment(), IPC_STAT, &state) == 0 ? state.shm_segsz : 0;
}

struct LayoutOfEnvironment {
  ~LayoutOfEnvironment() { ::unsetenv("TRK_LAYOUT"); }
};

TEST_F(Memory, has_the_layout_of_current_programs_unless_the_environment_sets_another) {
  ASSERT_EQ(trkMemOpen(slot.number(), &writer), trkOK);
  EXPECT_EQ(size_of(slot), 544U);
  trkMemCloseAll();
  const LayoutOfEnvironment restored;
  for (const auto& [word, size] : std::vector<std::pair<const char*, std::size_t>>{
           {"document", 528}, {"identified_i386", 524}, {"document_i386", 508}, {"auto", 544}}) {
    ::setenv("TRK_LAYOUT", word, 1);
    ASSERT_EQ(trkMemOpen(slot.number(), &writer), trkOK) << word;
    EXPECT_EQ(size_of(slot), size) << word;
    trkMemCloseAll();
  }
  for (const char* word : {"", "documant", "identified_llp64"}) {
    ::setenv("TRK_LAYOUT", word, 1);
    ::testing::internal::CaptureStderr();
    EXPECT_EQ(trkMemOpen(slot.number(), &writer), trkFailed) << word;
    EXPECT_NE(::testing::internal::GetCapturedStderr().find(std::string("TRK_LAYOUT=") + word), std::string::npos);
    EXPECT_FALSE(slot.has_file());
  }
}

TEST_F(Memory, passes_the_same_in_every_layout) {
  const LayoutOfEnvironment restored;
  for (const char* const word : {"document", "document_i386", "identified", "identified_i386"}) {
    ::setenv("TRK_LAYOUT", word, 1);
    ASSERT_EQ(trkMemOpen(slot.number(), &writer), trkOK) << word;
    // A reader attaches to what there is, in any environment.
    ::unsetenv("TRK_LAYOUT");
    ASSERT_EQ(trkMemOpen(slot.number(), &reader), trkOK) << word;
    trkCameraConstants constants = constants_in_c;
    trkCameraParams sent = params_in_c(5);
#ifdef TRK_IDENTIFIED
    // The document's records have no id.
    constants.id = sent.id = std::string(word).rfind("document", 0) == 0 ? 0 : 3;
#endif
    ASSERT_EQ(trkMemWriteConstants(writer, &constants), trkOK) << word;
    ASSERT_EQ(trkMemWriteParams(writer, &sent), trkOK) << word;
    ASSERT_EQ(trkMemReadConstants(reader, &c), trkOK) << word;
    EXPECT_EQ(text_of(c), text_of(constants)) << word;
    ASSERT_EQ(trkMemReadParams(reader, &p), trkOK) << word;
    EXPECT_EQ(text_of(p), text_of(sent)) << word;
    sent.k1 = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(trkMemWriteParams(writer, &sent), trkFailed) << word;
    trkMemCloseAll();
  }
}

TEST_F(Memory, a_reader_alone_detaches_and_reattaches) {
  ASSERT_EQ(trkMemOpen(slot.number(), &reader), trkOK);
  EXPECT_TRUE(becomes_true([&] {
    EXPECT_EQ(trkMemReadParams(reader, &p), trkUnavailable);
    return !slot.has_file();
  }));
  ASSERT_EQ(trkMemOpen(slot.number(), &writer), trkOK);
  ASSERT_EQ(trkMemWriteConstants(writer, &constants_in_c), trkOK);
  EXPECT_TRUE(becomes_true([&] { return trkMemReadConstants(reader, &c) == trkOK; }));
  EXPECT_EQ(text_of(c), text_of(constants_in_c));
}

TEST_F(Memory, memory_that_is_not_trk_is_of_an_invalid_version) {
  const int id = slot.make_segment(300);
  EXPECT_EQ(trkMemOpen(slot.number(), &writer), trkInvalidVersion);
  EXPECT_EQ(slot.segment(), id);
}

TEST_F(Memory, misuse_gives_the_documents_codes) {
  EXPECT_EQ(trkMemOpen(-1, &writer), trkFailed);
  EXPECT_EQ(trkMemOpen(62, &writer), trkFailed);
  EXPECT_EQ(trkMemOpen(slot.number(), nullptr), trkFailed);
  EXPECT_FALSE(slot.has_file());
  for (const trkHandle handle : no_handles) {
    EXPECT_EQ(trkMemReadParams(handle, &p), trkInvalidHandle);
    EXPECT_EQ(trkMemReadConstants(handle, &c), trkInvalidHandle);
    EXPECT_EQ(trkMemWriteParams(handle, &p), trkInvalidHandle);
    EXPECT_EQ(trkMemWriteConstants(handle, &c), trkInvalidHandle);
    EXPECT_EQ(trkMemClose(handle), trkInvalidHandle);
  }
  ASSERT_EQ(trkMemOpen(slot.number(), &writer), trkOK);
  EXPECT_EQ(trkMemReadParams(writer, nullptr), trkFailed);
  EXPECT_EQ(trkMemReadConstants(writer, nullptr), trkFailed);
  EXPECT_EQ(trkMemWriteParams(writer, nullptr), trkFailed);
  EXPECT_EQ(trkMemWriteConstants(writer, nullptr), trkFailed);
  trkCameraParams bad = params_in_c(1);
  bad.format = trkEuler | trkVertical | trkDiagonal;
  EXPECT_EQ(trkMemWriteParams(writer, &bad), trkFailed);
  bad = params_in_c(1);
  bad.fov = std::numeric_limits<double>::infinity();
  EXPECT_EQ(trkMemWriteParams(writer, &bad), trkFailed);
  EXPECT_EQ(trkNetReadParams(writer, &p), trkInvalidHandle) << "another kind";
  EXPECT_EQ(trkFileClose(writer), trkInvalidHandle) << "another kind";
  EXPECT_EQ(trkMemClose(writer), trkOK);
  EXPECT_EQ(trkMemClose(writer), trkInvalidHandle);
  const trkHandle stale = writer;
  ASSERT_EQ(trkMemOpen(slot.number(), &writer), trkOK);
  EXPECT_NE(writer, stale) << "a stale handle is never mistaken for a new one";
  EXPECT_EQ(trkMemWriteParams(stale, &p), trkInvalidHandle);
}

/// The exit status of a child process that runs `child`.
template <typename Child>
int exit_status_of(Child&& child) {
  const pid_t process = ::fork();
  if (process == 0) child();
  int status = -1;
  ::waitpid(process, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

TEST_F(Memory, the_exit_of_a_child_leaves_the_parents_memory) {
  ASSERT_EQ(trkMemOpen(slot.number(), &writer), trkOK);
  const trkCameraParams sent = params_in_c(5);
  ASSERT_EQ(trkMemOpen(slot.number(), &reader), trkOK);
  EXPECT_EQ(exit_status_of([] { std::exit(7); }), 7);
  EXPECT_EQ(exit_status_of([&] {
              trkMemClose(writer);
              trkMemCloseAll();
              std::exit(8);
            }),
            8);
  EXPECT_TRUE(slot.has_file());
  EXPECT_EQ(trkMemWriteParams(writer, &sent), trkOK);
  EXPECT_EQ(trkMemReadParams(reader, &p), trkOK);
}

TEST_F(Memory, a_signal_handler_that_ends_the_program_within_a_call_removes_the_memory) {
  const int number = slot.number();
  EXPECT_EQ(exit_status_of([number] {
              static trkHandle handle;
              if (trkMemOpen(number, &handle) != trkOK) std::_Exit(1);
              std::signal(SIGALRM, [](int) {
                trkMemCloseAll();
                std::exit(3);
              });
              ::ualarm(20'000, 0);
              const trkCameraParams sent = params_in_c(1);
              for (;;) trkMemWriteParams(handle, &sent);
            }),
            3);
  EXPECT_FALSE(slot.has_file());
  EXPECT_EQ(slot.segment(), -1);
}

}  // namespace trk_bridge::c_api::memory_test
