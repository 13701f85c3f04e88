// Every way of transfer, and every misuse of it.
#include <trk/trk_file.h>
#include <trk/trk_mem.h>
#include <trk/trk_net.h>

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "deadline.h"
#include "free_slot.h"
#include "reserved_port.h"
#include "temporary_directory.h"
#include "udp.h"

namespace {

using trk_bridge::test::FreeSlot;
using trk_bridge::test::PlainSocket;
using trk_bridge::test::ReservedPort;

trkCameraParams params(unsigned long counter) {
  trkCameraParams p{};
  p.format = trkEuler;
  p.t.e = {1, 2, 3, 4, 5, 6};
  p.fov = 7;
  p.counter = counter;
  return p;
}

constexpr trkCameraConstants constants{720, 576, 10, 10, 0, 0, 6.4, 4.8, 6.5, 4.9};

const trkHandle garbage[] = {nullptr, reinterpret_cast<trkHandle>(1), reinterpret_cast<trkHandle>(-1),
                             reinterpret_cast<trkHandle>(0x74726B01)};

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
  const trkCameraParams sent = params(5);
  ASSERT_EQ(trkMemWriteConstants(writer, &constants), trkOK);
  ASSERT_EQ(trkMemWriteParams(writer, &sent), trkOK);
  ASSERT_EQ(trkMemReadParams(reader, &p), trkOK);
  EXPECT_EQ(std::memcmp(&p, &sent, sizeof p), 0);
  EXPECT_EQ(trkMemReadParams(reader, &p), trkUnavailable);
  ASSERT_EQ(trkMemReadConstants(reader, &c), trkOK);
  EXPECT_EQ(std::memcmp(&c, &constants, sizeof c), 0);
  EXPECT_EQ(trkMemReadConstants(reader, &c), trkUnavailable);
  ASSERT_EQ(trkMemWriteConstants(writer, &constants), trkOK);
  EXPECT_EQ(trkMemReadConstants(reader, &c), trkOK) << "written again is new again";
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
      ASSERT_EQ(trkMemConfigure(kind | recreate), trkOK) << kind;
      ASSERT_EQ(trkMemOpen(slot.number(), &writer), trkOK);
      EXPECT_EQ(trkMemClose(writer), trkOK);
    }
  }
  EXPECT_EQ(trkMemConfigure(trkMemSysV | trkMemArena), trkFailed);
  EXPECT_EQ(trkMemConfigure(0x80), trkFailed);
}

TEST_F(Memory, recreate_replaces_it_when_all_others_have_left) {
  ASSERT_EQ(trkMemConfigure(trkMemDefault | trkMemRecreate), trkOK);
  ASSERT_EQ(trkMemOpen(slot.number(), &writer), trkOK);
  ASSERT_EQ(trkMemOpen(slot.number(), &reader), trkOK);
  const trkCameraParams sent = params(1);
  ASSERT_EQ(trkMemWriteConstants(writer, &constants), trkOK);
  ASSERT_EQ(trkMemWriteParams(writer, &sent), trkOK);
  const int before = slot.segment();
  ASSERT_EQ(trkMemClose(reader), trkOK);
  ASSERT_EQ(trkMemWriteParams(writer, &sent), trkOK);
  EXPECT_NE(slot.segment(), before);
  ASSERT_EQ(trkMemOpen(slot.number(), &reader), trkOK);
  EXPECT_EQ(trkMemReadConstants(reader, &c), trkOK) << "the contents came along";
}

std::size_t size_of(const FreeSlot& slot) {
  shmid_ds state{};
  return ::shmctl(slot.segment(), IPC_STAT, &state) == 0 ? state.shm_segsz : 0;
}

TEST_F(Memory, is_made_for_every_program_of_today_unless_the_environment_says_otherwise) {
  ASSERT_EQ(trkMemOpen(slot.number(), &writer), trkOK);
  EXPECT_EQ(size_of(slot), 544U);
  trkMemCloseAll();
  struct Environment {
    ~Environment() { ::unsetenv("TRK_LAYOUT"); }
  } const restored;
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

TEST_F(Memory, a_reader_that_is_alone_lets_go_and_comes_back) {
  ASSERT_EQ(trkMemOpen(slot.number(), &reader), trkOK);
  const auto end = std::chrono::steady_clock::now() + trk_bridge::test::deadline;
  while (slot.has_file() && std::chrono::steady_clock::now() < end) {
    ASSERT_EQ(trkMemReadParams(reader, &p), trkUnavailable);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_FALSE(slot.has_file());
  ASSERT_EQ(trkMemOpen(slot.number(), &writer), trkOK);
  ASSERT_EQ(trkMemWriteConstants(writer, &constants), trkOK);
  trkError error = trkUnavailable;
  while (error == trkUnavailable && std::chrono::steady_clock::now() < end) error = trkMemReadConstants(reader, &c);
  EXPECT_EQ(error, trkOK);
  EXPECT_EQ(std::memcmp(&c, &constants, sizeof c), 0);
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
  for (const trkHandle handle : garbage) {
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
  trkCameraParams bad = params(1);
  bad.format = trkEuler | trkVertical | trkDiagonal;
  EXPECT_EQ(trkMemWriteParams(writer, &bad), trkFailed);
  bad = params(1);
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

class Net : public ::testing::TestWithParam<int> {
 protected:
  void SetUp() override {
    ASSERT_EQ(trkNetOpenRead(port, &reader), trkOK);
    ASSERT_EQ(trkNetOpenWrite("127.0.0.1", port, GetParam(), &writer), trkOK);
  }
  void TearDown() override {
    EXPECT_EQ(trkNetClose(reader), trkOK);
    EXPECT_EQ(trkNetClose(writer), trkOK);
  }
  void send(std::initializer_list<unsigned long> counters) {
    for (const unsigned long counter : counters) {
      const trkCameraParams sent = params(counter);
      ASSERT_EQ(trkNetWriteParams(writer, &sent), trkOK);
    }
  }
  /// The counter of what is read; 0: unavailable.
  unsigned long paced(int passed = 1, int tolerated = 2) {
    const trkError error = trkNetBufReadParams(reader, &p, passed, tolerated);
    if (error == trkUnavailable) return 0;
    EXPECT_EQ(error, trkOK);
    return p.counter;
  }

  const ReservedPort reserved;
  const std::uint16_t port = reserved.number();
  trkHandle writer = nullptr, reader = nullptr;
  trkCameraParams p{};
  trkCameraConstants c{};
};

TEST_P(Net, the_newest_parameters_are_read) {
  EXPECT_EQ(trkNetReadParams(reader, &p), trkUnavailable);
  EXPECT_EQ(trkNetReadConstants(reader, &c), trkUnavailable);
  ASSERT_EQ(trkNetWriteConstants(writer, &constants), trkOK);
  send({1, 2, 3});
  ASSERT_EQ(trkNetReadParams(reader, &p), trkOK);
  const trkCameraParams expected = params(3);
  EXPECT_EQ(std::memcmp(&p, &expected, sizeof p), 0);
  EXPECT_EQ(trkNetReadParams(reader, &p), trkUnavailable);
  ASSERT_EQ(trkNetReadConstants(reader, &c), trkOK);
  EXPECT_EQ(std::memcmp(&c, &constants, sizeof c), 0);
  EXPECT_EQ(trkNetReadConstants(reader, &c), trkUnavailable);
}

TEST_P(Net, every_call_sends_constants) {
  for (int i = 0; i < 3; ++i) {
    ASSERT_EQ(trkNetWriteConstants(writer, &constants), trkOK);
    EXPECT_EQ(trkNetReadConstants(reader, &c), trkOK) << i;
  }
}

TEST_P(Net, a_malformed_datagram_costs_itself_alone) {
  send({1});
  PlainSocket().send(std::string("DMC01\0PA1 garbage", 17), "127.0.0.1", port);
  PlainSocket().send("", "127.0.0.1", port);
  send({2});
  ASSERT_EQ(trkNetReadParams(reader, &p), trkOK);
  EXPECT_EQ(p.counter, 2U);
  EXPECT_EQ(trkNetReadParams(reader, &p), trkInvalidVersion);
  EXPECT_EQ(p.counter, 2U) << "nothing half-parsed";
  EXPECT_EQ(trkNetReadParams(reader, &p), trkUnavailable);
}

TEST_P(Net, jitter_is_buffered) {
  send({10});
  EXPECT_EQ(paced(), 10U);
  EXPECT_EQ(paced(), 0U) << "nothing new";
  send({11, 12});
  EXPECT_EQ(paced(), 11U);
  EXPECT_EQ(paced(), 12U) << "from the store";
  send({13, 14, 15});
  EXPECT_EQ(paced(2), 14U);
  EXPECT_EQ(paced(2), 15U) << "16 has not come: the newest";
}

TEST_P(Net, a_delay_does_not_build_up) {
  send({1});
  EXPECT_EQ(paced(1, 2), 1U);
  send({2, 3, 4});
  EXPECT_EQ(paced(1, 2), 2U) << "4 is not beyond 2 + 2";
  send({5, 6});
  EXPECT_EQ(paced(1, 2), 6U) << "6 is beyond 3 + 2";
  EXPECT_EQ(paced(1, 2), 0U);
}

TEST_P(Net, a_gap_is_counted_over) {
  send({1});
  EXPECT_EQ(paced(), 1U);
  send({3, 4});
  EXPECT_EQ(paced(), 3U) << "2 was wanted and is lost";
  EXPECT_EQ(paced(), 4U) << "3 is wanted and was given";
}

TEST_P(Net, a_new_count_and_disorder_begin_with_the_newest) {
  send({100});
  EXPECT_EQ(paced(), 100U);
  send({5});
  EXPECT_EQ(paced(), 5U);
  send({7, 6, 8});
  EXPECT_EQ(paced(), 8U);
}

TEST_P(Net, the_ring_holds_sixteen) {
  send({1});
  EXPECT_EQ(paced(), 1U);
  for (unsigned long i = 2; i <= 16; ++i) send({i});
  EXPECT_EQ(paced(1, 100), 2U) << "15 in store";
  send({17, 18});
  EXPECT_EQ(paced(1, 100), 18U) << "16 in store: full";
}

TEST_P(Net, misuse_gives_the_documents_codes) {
  trkHandle none = nullptr;
  for (const int bad : {-1, 0, 65536}) {
    EXPECT_EQ(trkNetOpenRead(bad, &none), trkFailed) << bad;
    EXPECT_EQ(trkNetOpenWrite("127.0.0.1", bad, 0, &none), trkFailed) << bad;
  }
  EXPECT_EQ(trkNetOpenRead(port, nullptr), trkFailed);
  EXPECT_EQ(trkNetOpenWrite(nullptr, port, 0, &none), trkFailed);
  EXPECT_EQ(trkNetOpenWrite("", port, 0, &none), trkFailed);
  EXPECT_EQ(trkNetOpenWrite("127.0.0.1", port, 0, nullptr), trkFailed);
  EXPECT_EQ(none, nullptr);
  const trkCameraParams sent = params(1);
  std::vector<trkHandle> bad_readers(std::begin(garbage), std::end(garbage));
  bad_readers.push_back(writer);
  for (const trkHandle handle : bad_readers) {
    EXPECT_EQ(trkNetReadParams(handle, &p), trkInvalidHandle);
    EXPECT_EQ(trkNetBufReadParams(handle, &p, 1, 2), trkInvalidHandle);
    EXPECT_EQ(trkNetReadConstants(handle, &c), trkInvalidHandle);
  }
  for (const trkHandle handle : garbage) EXPECT_EQ(trkNetClose(handle), trkInvalidHandle);
  EXPECT_EQ(trkNetWriteParams(reader, &sent), trkInvalidHandle);
  EXPECT_EQ(trkNetWriteConstants(reader, &constants), trkInvalidHandle);
  EXPECT_EQ(trkNetReadParams(reader, nullptr), trkFailed);
  EXPECT_EQ(trkNetReadConstants(reader, nullptr), trkFailed);
  EXPECT_EQ(trkNetBufReadParams(reader, nullptr, 1, 2), trkFailed);
  EXPECT_EQ(trkNetBufReadParams(reader, &p, -1, 2), trkFailed);
  EXPECT_EQ(trkNetBufReadParams(reader, &p, 1, -2), trkFailed);
  EXPECT_EQ(trkNetWriteParams(writer, nullptr), trkFailed);
  EXPECT_EQ(trkNetWriteConstants(writer, nullptr), trkFailed);
  EXPECT_EQ(trkMemReadParams(reader, &p), trkInvalidHandle);
}

INSTANTIATE_TEST_SUITE_P(Encodings, Net, ::testing::Values(0, 1));

class File : public ::testing::Test {
 protected:
  trk_bridge::test::TemporaryDirectory directory;
  std::string name = directory.path() + "/take.trk";
  trkHandle handle = nullptr;
  char time_code[trkTimeCodeSize] = "";
  trkCameraParams p{};
  trkCameraConstants c{};
};

TEST_F(File, passes_a_take) {
  std::ofstream(name) << "an older file";
  ASSERT_EQ(trkFileOpenWrite(name.c_str(), "10:20:30:12:2", &constants, &handle), trkOK);
  for (unsigned long i = 1; i <= 3; ++i) {
    const trkCameraParams sent = params(i);
    ASSERT_EQ(trkFileWriteParams(handle, &sent), trkOK);
  }
  EXPECT_EQ(trkFileReadParams(handle, &p), trkInvalidHandle) << "it is for writing";
  ASSERT_EQ(trkFileClose(handle), trkOK);
  ASSERT_EQ(trkFileOpenRead(name.c_str(), time_code, &c, &handle), trkOK);
  EXPECT_STREQ(time_code, "10:20:30:12:2");
  EXPECT_EQ(std::memcmp(&c, &constants, sizeof c), 0);
  for (unsigned long i = 1; i <= 3; ++i) {
    ASSERT_EQ(trkFileReadParams(handle, &p), trkOK);
    const trkCameraParams expected = params(i);
    EXPECT_EQ(std::memcmp(&p, &expected, sizeof p), 0);
  }
  EXPECT_EQ(trkFileReadParams(handle, &p), trkUnavailable);
  EXPECT_EQ(trkFileWriteParams(handle, &p), trkInvalidHandle) << "it is for reading";
  EXPECT_EQ(trkFileClose(handle), trkOK);
  EXPECT_EQ(trkFileClose(handle), trkInvalidHandle);
}

TEST_F(File, what_cannot_be_read_fails_and_what_is_no_take_is_of_an_invalid_version) {
  EXPECT_EQ(trkFileOpenRead(name.c_str(), time_code, &c, &handle), trkFailed);
  EXPECT_EQ(trkFileOpenRead(directory.path().c_str(), time_code, &c, &handle), trkFailed);
  std::ofstream(name) << "DMC01\n10:20:30:12:2\n720 576 10 10 0 0 6.4 4.8 6.5 4.9\n1 1 2 3\n";
  ASSERT_EQ(trkFileOpenRead(name.c_str(), time_code, &c, &handle), trkOK);
  EXPECT_EQ(trkFileReadParams(handle, &p), trkInvalidVersion);
  EXPECT_EQ(trkFileReadParams(handle, &p), trkUnavailable);
  EXPECT_EQ(trkFileClose(handle), trkOK);
  std::ofstream(name) << "DMC01\n10:20:30:12:3\n720 576 10 10 0 0 6.4 4.8 6.5 4.9\n";
  handle = nullptr;
  time_code[0] = '\0';
  EXPECT_EQ(trkFileOpenRead(name.c_str(), time_code, &c, &handle), trkInvalidVersion);
  EXPECT_EQ(handle, nullptr);
  EXPECT_STREQ(time_code, "");
}

TEST_F(File, lines_are_read_as_they_are_asked_for) {
  const std::string line = "1 1 2 3 4 5 6 7 0 0 0 0 0 0 ";
  std::ofstream(name) << "DMC01\n10:20:30:12:2\n720 576 10 10 0 0 6.4 4.8 6.5 4.9\n"
                      << line << "1\n"
                      << line << "oops\n"
                      << line << "3\n"
                      << line;
  ASSERT_EQ(trkFileOpenRead(name.c_str(), time_code, &c, &handle), trkOK);
  EXPECT_EQ(trkFileReadParams(handle, &p), trkOK);
  EXPECT_EQ(trkFileReadParams(handle, &p), trkInvalidVersion) << "once";
  EXPECT_EQ(trkFileReadParams(handle, &p), trkOK);
  EXPECT_EQ(p.counter, 3U);
  EXPECT_EQ(trkFileReadParams(handle, &p), trkUnavailable) << "the last line is cut";
  EXPECT_EQ(trkFileReadParams(handle, &p), trkUnavailable);
  EXPECT_EQ(trkFileClose(handle), trkOK);
}

TEST_F(File, misuse_gives_the_documents_codes) {
  EXPECT_EQ(trkFileOpenRead(nullptr, time_code, &c, &handle), trkFailed);
  EXPECT_EQ(trkFileOpenRead(name.c_str(), nullptr, &c, &handle), trkFailed);
  EXPECT_EQ(trkFileOpenRead(name.c_str(), time_code, nullptr, &handle), trkFailed);
  EXPECT_EQ(trkFileOpenRead(name.c_str(), time_code, &c, nullptr), trkFailed);
  EXPECT_EQ(trkFileOpenWrite(nullptr, "10:20:30:12:2", &constants, &handle), trkFailed);
  EXPECT_EQ(trkFileOpenWrite(name.c_str(), nullptr, &constants, &handle), trkFailed);
  EXPECT_EQ(trkFileOpenWrite(name.c_str(), "ten past five", &constants, &handle), trkFailed);
  EXPECT_EQ(trkFileOpenWrite(name.c_str(), "10:20:30:12:2", nullptr, &handle), trkFailed);
  EXPECT_EQ(trkFileOpenWrite(name.c_str(), "10:20:30:12:2", &constants, nullptr), trkFailed);
  EXPECT_EQ(trkFileOpenWrite("/nowhere/at/all.trk", "10:20:30:12:2", &constants, &handle), trkFailed);
  for (const trkHandle bad : garbage) {
    EXPECT_EQ(trkFileReadParams(bad, &p), trkInvalidHandle);
    EXPECT_EQ(trkFileWriteParams(bad, &p), trkInvalidHandle);
    EXPECT_EQ(trkFileClose(bad), trkInvalidHandle);
  }
}

}  // namespace
