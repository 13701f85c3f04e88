// Every way of transfer, and every misuse of it.
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "deadline.h"
#include "free_slot.h"
#include "reserved_port.h"
#include "temporary_directory.h"
#include "trk_file.h"
#include "trk_mem.h"
#include "trk_net.h"
#include "udp.h"

namespace {

using trk_bridge::test::becomes_true;
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

const trkCameraConstants constants = [] {
  trkCameraConstants c{};
  trkStringToConstants("720 576 10 10 0 0 6.4 4.8 6.5 4.9", &c);
  return c;
}();

/// As trkNetOpenRead of the document.
trkError open_read(int port, trkHandle* handle) {
#ifdef TRK_IDENTIFIED
  return trkNetOpenRead(port, handle, 1);
#else
  return trkNetOpenRead(port, handle);
#endif
}

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
      trkMemConfigure(kind | recreate);
      ASSERT_EQ(trkMemOpen(slot.number(), &writer), trkOK);
      EXPECT_EQ(trkMemClose(writer), trkOK);
    }
  }
  EXPECT_EQ(trkMemRecreate, 0x10);
}

TEST_F(Memory, recreate_replaces_it_when_all_others_have_left) {
  trkMemConfigure(trkMemDefault | trkMemRecreate);
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
  EXPECT_TRUE(becomes_true([&] {
    EXPECT_EQ(trkMemReadParams(reader, &p), trkUnavailable);
    return !slot.has_file();
  }));
  ASSERT_EQ(trkMemOpen(slot.number(), &writer), trkOK);
  ASSERT_EQ(trkMemWriteConstants(writer, &constants), trkOK);
  EXPECT_TRUE(becomes_true([&] { return trkMemReadConstants(reader, &c) == trkOK; }));
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

/// How a child of this process ends that runs `child`.
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
  const trkCameraParams sent = params(5);
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
              const trkCameraParams sent = params(1);
              for (;;) trkMemWriteParams(handle, &sent);
            }),
            3);
  EXPECT_FALSE(slot.has_file());
  EXPECT_EQ(slot.segment(), -1);
}

class Net : public ::testing::TestWithParam<int> {
 protected:
  void SetUp() override {
    ASSERT_EQ(open_read(port, &reader), trkOK);
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

TEST_P(Net, a_new_count_begins_with_the_newest) {
  send({100});
  EXPECT_EQ(paced(), 100U);
  send({5});
  EXPECT_EQ(paced(), 5U);
}

TEST_P(Net, what_comes_late_or_twice_is_put_in_its_place) {
  send({5});
  EXPECT_EQ(paced(), 5U);
  send({7, 6, 7, 8});
  EXPECT_EQ(paced(), 6U);
  send({6});
  EXPECT_EQ(paced(), 7U) << "6 was given";
  EXPECT_EQ(paced(), 8U);
  EXPECT_EQ(paced(), 0U);
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
  for (const int bad : {-1, 0, 65536, 70000}) {
    EXPECT_EQ(open_read(bad, &none), trkFailed) << bad;
    EXPECT_EQ(trkNetOpenWrite("127.0.0.1", bad, 0, &none), trkFailed) << bad;
  }
  EXPECT_EQ(open_read(port, nullptr), trkFailed);
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

#ifdef TRK_IDENTIFIED

TEST_P(Net, camera_numbers_are_passed) {
  trkCameraParams sent = params(1);
  sent.id = 7;
  ASSERT_EQ(trkNetWriteParams(writer, &sent), trkOK);
  ASSERT_EQ(trkNetReadParams(reader, &p), trkOK);
  EXPECT_EQ(p.id, 7U);
}

TEST_P(Net, old_parameters_are_skipped_or_queued) {
  send({1, 2, 3});
  EXPECT_EQ(trkNetParamsAvailable(reader), 3);
  trkNetSkipOld(0, reader);
  ASSERT_EQ(trkNetReadParams(reader, &p), trkOK);
  EXPECT_EQ(p.counter, 1U);
  EXPECT_EQ(trkNetParamsAvailable(reader), 2);
  trkNetSkipOld(1, reader);
  ASSERT_EQ(trkNetReadParams(reader, &p), trkOK);
  EXPECT_EQ(p.counter, 3U);
  EXPECT_EQ(trkNetParamsAvailable(reader), 0);
  EXPECT_EQ(trkNetParamsAvailable(writer), 0) << "it cannot be read";
  trkNetSkipOld(0, writer);
}

TEST_P(Net, the_last_constants_can_be_read_again) {
  EXPECT_EQ(trkNetReadConstants2(reader, &c), trkUnavailable);
  ASSERT_EQ(trkNetWriteConstants(writer, &constants), trkOK);
  for (int i = 0; i < 2; ++i) {
    ASSERT_EQ(trkNetReadConstants2(reader, &c), trkOK);
    EXPECT_EQ(std::memcmp(&c, &constants, sizeof c), 0);
  }
  EXPECT_EQ(trkNetReadConstants(reader, &c), trkUnavailable);
  EXPECT_EQ(trkNetReadConstants2(nullptr, &c), trkInvalidHandle);
  EXPECT_EQ(trkNetReadConstants2(reader, nullptr), trkFailed);
}

#endif

/// The binary datagram that parameters are sent as, with this in the environment.
std::string binary_datagram(const char* layout) {
  if (layout != nullptr) ::setenv("TRK_LAYOUT", layout, 1);
  const PlainSocket receiver;
  trkHandle writer = nullptr;
  EXPECT_EQ(trkNetOpenWrite("127.0.0.1", receiver.port(), 1, &writer), trkOK);
  ::unsetenv("TRK_LAYOUT");
  const trkCameraParams sent = params(9);
  EXPECT_EQ(trkNetWriteParams(writer, &sent), trkOK);
  EXPECT_EQ(trkNetClose(writer), trkOK);
  return receiver.receive().value_or("");
}

TEST(NetLayout, binary_datagrams_are_what_todays_readers_take) {
  const std::string datagram = binary_datagram(nullptr);
  std::uint32_t words[2] = {};
  ASSERT_GE(datagram.size(), 208U);
  std::memcpy(words, datagram.data() + datagram.size() - 200, sizeof words);
  EXPECT_EQ(words[0], 0U) << "the camera number comes first";
  EXPECT_EQ(words[1], unsigned{trkEuler});
  const std::string document = binary_datagram("document");
  std::memcpy(words, document.data() + document.size() - 200, sizeof words);
  EXPECT_EQ(words[0], unsigned{trkEuler});
  EXPECT_EQ(binary_datagram("identified_i386").size(), datagram.size() - 4);
}

TEST(NetLayout, an_environment_that_is_not_sound_is_a_failure) {
  trkHandle none = nullptr;
  ::setenv("TRK_LAYOUT", "upside_down", 1);
  EXPECT_EQ(trkNetOpenWrite("127.0.0.1", 4000, 1, &none), trkFailed);
  ::unsetenv("TRK_LAYOUT");
  ::setenv("MULTICAST_TTL", "far", 1);
  EXPECT_EQ(trkNetOpenWrite("239.1.2.3", 4000, 0, &none), trkFailed);
  trkHandle unicast = nullptr;
  EXPECT_EQ(trkNetOpenWrite("127.0.0.1", 4000, 0, &unicast), trkOK) << "it is for multicast";
  ::setenv("MULTICAST_TTL", "0", 1);
  EXPECT_EQ(trkNetOpenWrite("239.1.2.3", 4000, 0, &none), trkOK);
  ::unsetenv("MULTICAST_TTL");
  EXPECT_EQ(trkNetClose(unicast), trkOK);
  EXPECT_EQ(trkNetClose(none), trkOK);
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

constexpr const char* head = "DMC01\n10:20:30:12:2\n720 576 10 10 0 0 6.4 4.8 6.5 4.9\n";

TEST_F(File, what_cannot_be_read_fails_and_what_is_no_take_is_of_an_invalid_version) {
  EXPECT_EQ(trkFileOpenRead(name.c_str(), time_code, &c, &handle), trkFailed);
  EXPECT_EQ(trkFileOpenRead(directory.path().c_str(), time_code, &c, &handle), trkFailed);
  for (const char* text : {"", "DMC01\n", "DMC01\n10:20:30:12:2\n", "DMC01\n10:20:30:12:2\n720 576\n", "DMC02\n"}) {
    std::ofstream(name) << text;
    EXPECT_EQ(trkFileOpenRead(name.c_str(), time_code, &c, &handle), trkInvalidVersion) << text;
  }
  EXPECT_EQ(handle, nullptr);
  EXPECT_STREQ(time_code, "");
}

TEST_F(File, a_take_that_was_cut_gives_all_its_whole_lines) {
  std::ofstream(name) << head << "1 1 2 3 4 5 6 7 0 0 0 0 0 0 1\n1 1 2 3 4 5 6 7 0 0 0 0 0 0 2\n1 1 2 3 4 5 6";
  ASSERT_EQ(trkFileOpenRead(name.c_str(), time_code, &c, &handle), trkOK);
  ASSERT_EQ(trkFileReadParams(handle, &p), trkOK);
  ASSERT_EQ(trkFileReadParams(handle, &p), trkOK);
  EXPECT_EQ(p.counter, 2U);
  EXPECT_EQ(trkFileReadParams(handle, &p), trkUnavailable);
  EXPECT_EQ(trkFileReadParams(handle, &p), trkUnavailable);
  EXPECT_EQ(trkFileClose(handle), trkOK);
}

TEST_F(File, a_line_that_is_not_sound_costs_itself_alone) {
  std::ofstream(name) << head
                      << "1 1 2 3 4 5 6 7 0 0 0 0 0 0 1\nno record\n# a comment\n1 1 2 3 4 5 6 7 0 0 0 0 0 0 3\n";
  ASSERT_EQ(trkFileOpenRead(name.c_str(), time_code, &c, &handle), trkOK);
  ASSERT_EQ(trkFileReadParams(handle, &p), trkOK);
  EXPECT_EQ(trkFileReadParams(handle, &p), trkInvalidVersion);
  EXPECT_EQ(p.counter, 1U) << "left as it was";
  ASSERT_EQ(trkFileReadParams(handle, &p), trkOK);
  EXPECT_EQ(p.counter, 3U);
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
