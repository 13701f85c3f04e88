// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Transfer by network, and all its misuses.
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "c_records.h"
#include "reserved_port.h"
#include "trk_mem.h"
#include "trk_net.h"
#include "udp.h"

namespace trk_bridge::c_api::network_test {

using trk_bridge::test::constants_in_c;
using trk_bridge::test::no_handles;
using trk_bridge::test::params_in_c;
using trk_bridge::test::PlainSocket;
using trk_bridge::test::ReservedPort;
using trk_bridge::test::text_of;

/// Like trkNetOpenRead of the document.
trkError open_read(int port, trkHandle* handle) {
#ifdef TRK_IDENTIFIED
  return trkNetOpenRead(port, handle, 1);
#else
  return trkNetOpenRead(port, handle);
#endif
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
      const trkCameraParams sent = params_in_c(counter);
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
  ASSERT_EQ(trkNetWriteConstants(writer, &constants_in_c), trkOK);
  send({1, 2, 3});
  ASSERT_EQ(trkNetReadParams(reader, &p), trkOK);
  const trkCameraParams expected = params_in_c(3);
  EXPECT_EQ(text_of(p), text_of(expected));
  EXPECT_EQ(trkNetReadParams(reader, &p), trkUnavailable);
  ASSERT_EQ(trkNetReadConstants(reader, &c), trkOK);
  EXPECT_EQ(text_of(c), text_of(constants_in_c));
  EXPECT_EQ(trkNetReadConstants(reader, &c), trkUnavailable);
}

TEST_P(Net, every_call_sends_constants) {
  for (int i = 0; i < 3; ++i) {
    ASSERT_EQ(trkNetWriteConstants(writer, &constants_in_c), trkOK);
    EXPECT_EQ(trkNetReadConstants(reader, &c), trkOK) << i;
  }
}

TEST_P(Net, only_the_malformed_datagram_is_lost) {
  send({1});
  PlainSocket().send(std::string("DMC01\0PA1 garbage", 17), "127.0.0.1", port);
  PlainSocket().send("", "127.0.0.1", port);
  PlainSocket().send(std::string(60000, 'A'), "127.0.0.1", port);
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
  EXPECT_EQ(paced(2), 15U) << "16 has not arrived: the newest";
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

TEST_P(Net, a_gap_is_skipped) {
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

TEST_P(Net, late_and_duplicate_records_are_ordered) {
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
  const trkCameraParams sent = params_in_c(1);
  std::vector<trkHandle> bad_readers(std::begin(no_handles), std::end(no_handles));
  bad_readers.push_back(writer);
  for (const trkHandle handle : bad_readers) {
    EXPECT_EQ(trkNetReadParams(handle, &p), trkInvalidHandle);
    EXPECT_EQ(trkNetBufReadParams(handle, &p, 1, 2), trkInvalidHandle);
    EXPECT_EQ(trkNetReadConstants(handle, &c), trkInvalidHandle);
  }
  for (const trkHandle handle : no_handles) EXPECT_EQ(trkNetClose(handle), trkInvalidHandle);
  EXPECT_EQ(trkNetWriteParams(reader, &sent), trkInvalidHandle);
  EXPECT_EQ(trkNetWriteConstants(reader, &constants_in_c), trkInvalidHandle);
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

TEST_P(Net, camera_ids_are_passed) {
  trkCameraParams sent = params_in_c(1);
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
  ASSERT_EQ(trkNetWriteConstants(writer, &constants_in_c), trkOK);
  for (int i = 0; i < 2; ++i) {
    ASSERT_EQ(trkNetReadConstants2(reader, &c), trkOK);
    EXPECT_EQ(text_of(c), text_of(constants_in_c));
  }
  EXPECT_EQ(trkNetReadConstants(reader, &c), trkUnavailable);
  EXPECT_EQ(trkNetReadConstants2(nullptr, &c), trkInvalidHandle);
  EXPECT_EQ(trkNetReadConstants2(reader, nullptr), trkFailed);
}

#endif

/// The binary datagram of parameters, with this in the environment.
std::string binary_datagram(const char* layout) {
  if (layout != nullptr) ::setenv("TRK_LAYOUT", layout, 1);
  const PlainSocket receiver;
  trkHandle writer = nullptr;
  EXPECT_EQ(trkNetOpenWrite("127.0.0.1", receiver.port(), 1, &writer), trkOK);
  ::unsetenv("TRK_LAYOUT");
  const trkCameraParams sent = params_in_c(9);
  EXPECT_EQ(trkNetWriteParams(writer, &sent), trkOK);
  EXPECT_EQ(trkNetClose(writer), trkOK);
  return receiver.receive().value_or("");
}

TEST(NetLayout, binary_datagrams_are_those_of_current_readers) {
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

TEST(NetLayout, an_invalid_environment_is_a_failure) {
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

}  // namespace trk_bridge::c_api::network_test
