// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Foreign or ambiguous files and segments are not changed, and are reported.
#include <cerrno>
#include <cstring>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include "error_of.h"
#include "free_slot.h"
#include "shm/segment.h"
#include "trk_bridge/endpoints/endpoints.h"
#include "trk_bridge/transport/sink.h"
#include "trk_bridge/transport/source.h"

namespace trk_bridge::shm::shm_foreign_test {

using namespace std::chrono_literals;
using endpoints::open_sink;
using endpoints::open_source;
using ::testing::HasSubstr;
using transport::Event;
using transport::Reception;
using transport::SinkReason;
using transport::SourceState;
using transport::TransportError;

std::string contents(int id, std::size_t size) {
  auto* memory = static_cast<char*>(::shmat(id, nullptr, SHM_RDONLY));
  const std::string bytes(memory, size);
  ::shmdt(memory);
  return bytes;
}

std::size_t attachments(int id) {
  shmid_ds state{};
  return ::shmctl(id, IPC_STAT, &state) == 0 ? state.shm_nattch : 99;
}

std::string refusal(const std::string& url) {
  return test::error_of<TransportError>([&] { static_cast<void>(open_sink(url)); });
}

class Foreign : public ::testing::TestWithParam<std::size_t> {
 protected:
  test::FreeSlot slot;
  std::string url = "shm:" + std::to_string(slot.number());
};

TEST_P(Foreign, is_unchanged_and_named) {
  const std::size_t size = GetParam();
  const int id = slot.make_segment(size);
  {
    auto* memory = static_cast<char*>(::shmat(id, nullptr, 0));
    for (std::size_t i = 0; i < size; ++i) memory[i] = static_cast<char>(i * 7 + 1);
    ::shmdt(memory);
  }
  const std::string before = contents(id, size);
  {
    const auto source = open_source(url);
    Reception into;
    EXPECT_EQ(source->receive(into, 0s), Event::idle);
    EXPECT_EQ(source->receive(into, 120ms), Event::idle);
    EXPECT_EQ(attachments(id), 0U);
    EXPECT_EQ(source->statistics().state, SourceState::nothing_valid);
    EXPECT_THAT(source->statistics().waiting_for, HasSubstr("segment of " + std::to_string(size) + " bytes"));
  }
  EXPECT_THAT(refusal(url), HasSubstr("segment of " + std::to_string(size) + " bytes"));
  EXPECT_EQ(slot.segment(), id);
  EXPECT_EQ(attachments(id), 0U);
  EXPECT_EQ(contents(id, size), before);
  EXPECT_TRUE(slot.has_file());
}

// 300 is no size of a layout; the others are, but do not start with the magic number.
INSTANTIATE_TEST_SUITE_P(Sizes, Foreign, ::testing::Values(300, 508, 524, 528, 544, 8192));

class Confused : public ::testing::Test {
 protected:
  test::FreeSlot slot;
  std::string url = "shm:" + std::to_string(slot.number());
};

TEST_F(Confused, an_eight_byte_magic_with_garbage_above_is_foreign) {
  const int id = slot.make_segment(528);
  auto* memory = static_cast<char*>(::shmat(id, nullptr, 0));
  const std::uint64_t magic = 0x100000000ULL + segment_magic;
  std::memcpy(memory, &magic, sizeof magic);
  EXPECT_THAT(refusal(url), HasSubstr("0x12357BD01"));
  EXPECT_EQ(std::memcmp(memory, &magic, sizeof magic), 0);
  ::shmdt(memory);
}

TEST_F(Confused, a_segment_that_is_being_created_is_waited_for_and_unchanged) {
  const int id = slot.make_segment(528);
  const auto source = open_source(url);
  Reception into;
  EXPECT_EQ(source->receive(into, 0s), Event::idle);
  EXPECT_EQ(source->statistics().state, SourceState::waiting);
  EXPECT_THAT(source->statistics().waiting_for, HasSubstr("its creator has not finished it"));
  // The creator, this process, exists: a writer does not take over either.
  EXPECT_THAT(refusal(url), HasSubstr("its creator has not finished it"));
  const auto sink = endpoints::parse_sink(url)->open();
  const auto written = sink->write(wire::CameraParams{});
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().reason, SinkReason::no_segment);
  EXPECT_EQ(contents(id, 528), std::string(528, '\0'));
}

TEST_F(Confused, two_slots_with_one_key_are_detected) {
  test::FreeSlot other;
  const auto sink = open_sink("shm:" + std::to_string(other.number()));
  // A hard link has the inode of its original, as two inodes that agree in their lower 16 bits have one key.
  ASSERT_EQ(::link(other.path().c_str(), slot.path().c_str()), 0);
  const auto fault = "has the same key as slot " + std::to_string(other.number());
  EXPECT_THAT(refusal(url), HasSubstr(fault));
  const auto source = open_source(url);
  Reception into;
  EXPECT_EQ(source->receive(into, 0s), Event::idle);
  EXPECT_THAT(source->statistics().waiting_for, HasSubstr(fault));
  EXPECT_EQ(attachments(other.segment()), 1U);
  ::unlink(slot.path().c_str());
}

TEST_F(Confused, a_directory_in_the_place_of_the_file_is_refused) {
  ASSERT_EQ(::mkdir(slot.path().c_str(), 0700), 0);
  EXPECT_THAT(refusal(url), HasSubstr("is not a regular file"));
  ::rmdir(slot.path().c_str());
}

TEST_F(Confused, a_sink_whose_slot_became_foreign_reports_no_segment) {
  const auto sink = open_sink(url);
  slot.remove();
  const int id = slot.make_segment(300);
  const auto written = sink->write(wire::CameraParams{});
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().reason, SinkReason::no_segment);
  EXPECT_THAT(describe(written.error()), HasSubstr("there is no segment to write to"));
  EXPECT_EQ(contents(id, 300), std::string(300, '\0'));
  slot.remove();
  EXPECT_TRUE(sink->write(wire::CameraParams{})) << "every write checks again";
}

TEST_F(Confused, a_sink_reports_why_the_system_gives_it_no_segment) {
  const auto sink = open_sink(url);
  slot.remove();
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &before), 0);
  const rlimit none{0, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &none), 0);
  const auto written = sink->write(wire::CameraParams{});
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &before), 0);
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().reason, SinkReason::system);
  EXPECT_EQ(written.error().error_number, EMFILE) << "the slot's file could not be created";
  EXPECT_TRUE(sink->write(wire::CameraParams{})) << "every write checks again";
}

TEST(ShmFaults, key_zero_is_explained) {
  EXPECT_THAT(describe(SlotFault{SlotProblem::key_zero, 7}),
              HasSubstr("slot 7: /tmp/dmc_tracking_buffer.7 has the key 0"));
}

}  // namespace trk_bridge::shm::shm_foreign_test
