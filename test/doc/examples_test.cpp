// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The example programs of the documentation, each in its process, with the trk tool at the other end.
#include <csignal>

#include <gmock/gmock.h>

#include "free_slot.h"
#include "program.h"
#include "repeating.h"
#include "reserved_port.h"
#include "temporary_directory.h"
#include "udp.h"

namespace trk_bridge::test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(Examples, the_renderer_follows_the_crane_controller) {
  const ReservedPort port;
  // Constants are repeated within a second of 50 sets, in case the first ones were too early.
  Program renderer({RENDERER, port.text(), "60"});
  Program crane({CRANE_CONTROLLER, "127.0.0.1", port.text(), "100000"});
  const std::string out = renderer.rest_of_out();
  EXPECT_THAT(out, HasSubstr("constants: image 1920 x 1080 pixels, chip 9.59 x 5.39 mm\n"));
  EXPECT_THAT(out, HasSubstr(", -4, 2) m, pan "));
  EXPECT_EQ(renderer.rest_of_err(), "");
  EXPECT_EQ(renderer.wait(), 0);
  crane.signal(SIGTERM);
  EXPECT_EQ(crane.wait(), -SIGTERM);
}

TEST(Examples, renderer_prints_what_trk_sends) {
  const TemporaryDirectory directory;
  const std::string take = directory / "take.trk";
  Program maker({WRITE_FILE, take, "euler"});
  EXPECT_EQ(maker.rest_of_err(), "");
  ASSERT_EQ(maker.wait(), 0);

  const ReservedPort port;
  // Constants are repeated within a second of 50 sets, in case the first ones were too early.
  Program reader({RENDERER, port.text(), "60"});
  Program sender({TRK_TOOL, "relay", "file:" + take + "?loop=1&time=now", port.url()});
  const std::string out = reader.rest_of_out();
  EXPECT_THAT(out, HasSubstr("constants: image 720 x 576 pixels, chip 6.4 x 4.8 mm\n"));
  EXPECT_THAT(out, HasSubstr(" degrees [euler studio_z_up image_distance consider_blank shift_on_chip]\n"));
  EXPECT_EQ(reader.rest_of_err(), "");
  EXPECT_EQ(reader.wait(), 0);
}

TEST(Examples, renderer_reports_what_is_not_trk) {
  const ReservedPort port;
  const PlainSocket sender;
  Program reader({RENDERER, port.text(), "100000"});
  {
    const Repeating sending(50, [&] { sender.send(datagram(params(1)), "127.0.0.1", port.number()); });
    ASSERT_TRUE(reader.out_line());
  }
  sender.send("garbage", "127.0.0.1", port.number());
  EXPECT_EQ(reader.err_line(), "something that is not trk has arrived");
  reader.signal(SIGTERM);
  EXPECT_EQ(reader.wait(), -SIGTERM);
}

TEST(Examples, renderer_says_that_a_port_is_taken) {
  const PlainSocket taken("0.0.0.0");
  Program reader({RENDERER, std::to_string(taken.port()), "1"});
  EXPECT_THAT(reader.rest_of_err(), StartsWith("port " + std::to_string(taken.port()) + ": "));
  EXPECT_EQ(reader.wait(), 1);
}

TEST(Examples, trk_dump_reads_what_write_mem_writes) {
  FreeSlot slot;
  const std::string number = std::to_string(slot.number());
  Program writer({WRITE_MEM, number, "100000"});
  Program reader({TRK_TOOL, "dump", "shm:" + number, "--json", "--count", "3"});
  EXPECT_THAT(reader.out_line().value_or(""), HasSubstr(R"("imageWidth":1920)"));
  for (int i = 0; i < 2; ++i) {
    const std::string params = reader.out_line().value_or("");
    EXPECT_THAT(params, HasSubstr(R"("z":1.6)"));
    EXPECT_THAT(params, HasSubstr(R"("fov":8,)"));
  }
  reader.rest_of_err();
  EXPECT_EQ(reader.wait(), 0);
  writer.signal(SIGTERM);
  EXPECT_EQ(writer.rest_of_err(), "");
  EXPECT_EQ(writer.wait(), 0);
  EXPECT_FALSE(slot.has_file());
}

TEST(Examples, write_mem_leaves_no_memory_behind) {
  FreeSlot slot;
  Program writer({WRITE_MEM, std::to_string(slot.number()), "2"});
  EXPECT_EQ(writer.rest_of_err(), "");
  EXPECT_EQ(writer.wait(), 0);
  EXPECT_FALSE(slot.has_file());
  EXPECT_EQ(slot.segment(), -1);
}

TEST(Examples, all_show_their_usage) {
  for (const char* program : {CRANE_CONTROLLER, RENDERER, WRITE_MEM}) {
    Program without_arguments({program});
    EXPECT_THAT(without_arguments.rest_of_err(), StartsWith("usage: "));
    EXPECT_EQ(without_arguments.wait(), 2);
  }
}

}  // namespace
}  // namespace trk_bridge::test
