// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Sources and sinks on a slot: which create, follow, count and remove a segment, and what they do not touch.
#include <chrono>
#include <cstring>
#include <functional>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "camera_records.h"
#include "free_slot.h"
#include "shm/scheme.h"
#include "shm/segment.h"
#include "trk_bridge/endpoints/endpoints.h"
#include "trk_bridge/transport/sink.h"
#include "trk_bridge/transport/source.h"

namespace trk_bridge::shm::shm_test {

using endpoints::open_sink;
using endpoints::open_source;
using transport::Event;
using transport::Reception;
using transport::Sample;
using transport::SenderKind;
using transport::SinkReason;
using transport::Source;
using transport::SourceState;
using transport::TransportError;

using namespace std::chrono_literals;

constexpr auto deadline = 5s;

using test::constants;
using test::params;

class Shm : public ::testing::Test {
 protected:
  std::string url(const std::string& options = "") const { return "shm:" + std::to_string(slot.number()) + options; }
  const SegmentLayout& layout() const { return *layout_of(default_layout); }

  /// Receives while the source has records or `done` is false.
  ::testing::AssertionResult receive_until(Source& source, const std::function<bool(const Sample&)>& done) {
    const auto end = std::chrono::steady_clock::now() + deadline;
    while (std::chrono::steady_clock::now() < end) {
      const Event event = source.receive(into, 20ms);
      if (event == Event::sample && done(into.sample)) return ::testing::AssertionSuccess();
    }
    return ::testing::AssertionFailure() << "not received in time; " << source.statistics().waiting_for;
  }

  ::testing::AssertionResult idle_until(Source& source, const std::function<bool()>& done) {
    const auto end = std::chrono::steady_clock::now() + deadline;
    while (!done()) {
      if (std::chrono::steady_clock::now() > end) return ::testing::AssertionFailure() << "did not happen in time";
      if (source.receive(into, 20ms) == Event::sample) return ::testing::AssertionFailure() << "a record was received";
    }
    return ::testing::AssertionSuccess();
  }

  static bool is_params(const Sample& sample, std::uint64_t counter) {
    const auto* p = std::get_if<wire::CameraParams>(&sample.record);
    return p != nullptr && p->counter == counter;
  }

  test::FreeSlot slot;
  Reception into;
};

TEST_F(Shm, what_is_written_is_read) {
  const auto sink = open_sink(url());
  const auto source = open_source(url());
  auto sent = params(77);
  sent.id = 3;
  auto sent_constants = constants();
  sent_constants.id = 3;
  ASSERT_TRUE(sink->write(sent_constants));
  ASSERT_TRUE(sink->write(sent));
  const auto before = std::chrono::system_clock::now().time_since_epoch();
  ASSERT_EQ(source->receive(into, deadline), Event::sample);
  EXPECT_EQ(std::get<wire::CameraConstants>(into.sample.record), sent_constants);
  ASSERT_EQ(source->receive(into, deadline), Event::sample);
  EXPECT_EQ(std::get<wire::CameraParams>(into.sample.record), sent);
  EXPECT_GE(into.sample.arrival, std::chrono::nanoseconds(before).count());
  EXPECT_EQ(into.sample.sender.kind, SenderKind::shm);
  EXPECT_EQ(into.sample.sender.number, static_cast<std::uint32_t>(slot.number()));
  EXPECT_STREQ(into.sample.origin, "binary identified_lp64");
  EXPECT_EQ(source->receive(into, 0s), Event::idle);
  EXPECT_EQ(source->statistics().records, 2U);
  EXPECT_EQ(source->statistics().state, SourceState::receiving);
}

TEST_F(Shm, a_reader_sees_constants_from_before_and_parameters_from_after) {
  const auto sink = open_sink(url());
  ASSERT_TRUE(sink->write(constants()));
  ASSERT_TRUE(sink->write(params(1)));
  const auto source = open_source(url());
  ASSERT_EQ(source->receive(into, deadline), Event::sample);
  EXPECT_EQ(std::get<wire::CameraConstants>(into.sample.record), constants());
  EXPECT_EQ(source->receive(into, 0s), Event::idle);
  ASSERT_TRUE(sink->write(params(2)));
  ASSERT_EQ(source->receive(into, deadline), Event::sample);
  EXPECT_TRUE(is_params(into.sample, 2));
}

TEST_F(Shm, counters_wrap_and_replaced_sets_are_counted) {
  const auto sink = open_sink(url());
  const auto source = open_source(url());
  for (std::uint64_t i = 1; i <= 65530; ++i) ASSERT_TRUE(sink->write(params(i)));
  ASSERT_EQ(source->receive(into, deadline), Event::sample);
  EXPECT_TRUE(is_params(into.sample, 65530));
  EXPECT_EQ(source->statistics().overwritten, 65529U);
  for (std::uint64_t i = 65531; i <= 65540; ++i) {
    ASSERT_TRUE(sink->write(params(i)));
    ASSERT_EQ(source->receive(into, deadline), Event::sample);
    ASSERT_TRUE(is_params(into.sample, i));
  }
  EXPECT_EQ(source->statistics().overwritten, 65529U);
}

TEST_F(Shm, a_reader_waits_without_creating_anything) {
  const auto source = open_source(url());
  EXPECT_EQ(source->receive(into, 0s), Event::idle);
  EXPECT_FALSE(slot.has_file());
  EXPECT_EQ(source->statistics().state, SourceState::waiting);
  EXPECT_EQ(source->statistics().waiting_for, "slot " + std::to_string(slot.number()) + ": no segment");
  const auto sink = open_sink(url());
  ASSERT_TRUE(sink->write(constants()));
  ASSERT_TRUE(receive_until(*source, [](const Sample&) { return true; }));
  ASSERT_TRUE(sink->write(params(5)));
  EXPECT_TRUE(receive_until(*source, [](const Sample& s) { return is_params(s, 5); }));
}

TEST_F(Shm, a_file_without_a_segment_is_not_changed_by_the_reader_and_used_by_the_writer) {
  const int id = slot.make_segment(528);
  ::shmctl(id, IPC_RMID, nullptr);
  struct stat before {};
  ASSERT_EQ(::stat(slot.path().c_str(), &before), 0);
  {
    const auto source = open_source(url());
    EXPECT_EQ(source->receive(into, 0s), Event::idle);
  }
  EXPECT_TRUE(slot.has_file());
  const auto sink = open_sink(url());
  struct stat after {};
  ASSERT_EQ(::stat(slot.path().c_str(), &after), 0);
  EXPECT_EQ(after.st_ino, before.st_ino);
  EXPECT_TRUE(sink->write(params(1)));
}

TEST_F(Shm, the_last_one_removes_segment_and_file) {
  auto sink = open_sink(url());
  auto source = open_source(url());
  const int id = slot.segment();
  ASSERT_GE(id, 0);
  sink.reset();
  EXPECT_EQ(slot.segment(), id);
  source.reset();
  EXPECT_EQ(slot.segment(), -1);
  EXPECT_FALSE(slot.has_file());
}

TEST_F(Shm, connected_counts_handles_but_attachments_decide) {
  auto first = Segment::attach_or_create(slot.number(), layout(), 0666);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->connected(), 1);
  auto second = Segment::attach(slot.number());
  ASSERT_TRUE(second);
  EXPECT_EQ(first->connected(), 2);
  second->close();
  EXPECT_EQ(first->connected(), 1);
  // A process that died did not decrement the count.
  auto* memory = static_cast<char*>(::shmat(first->id(), nullptr, 0));
  const std::int32_t too_high = 5;
  std::memcpy(memory + layout().connected, &too_high, sizeof too_high);
  ::shmdt(memory);
  first->close();
  EXPECT_EQ(slot.segment(), -1);
  EXPECT_FALSE(slot.has_file());
}

TEST_F(Shm, a_new_segment_has_the_given_mode_whatever_the_umask) {
  const mode_t before = ::umask(0077);
  const auto sink = open_sink(url("?mode=0664"));
  ::umask(before);
  shmid_ds state{};
  ASSERT_EQ(::shmctl(slot.segment(), IPC_STAT, &state), 0);
  EXPECT_EQ(state.shm_perm.mode & 0777, 0664);
  EXPECT_EQ(state.shm_segsz, 544U);
}

TEST_F(Shm, reattaches_when_the_segment_is_recreated) {
  auto sink = open_sink(url());
  const auto source = open_source(url());
  ASSERT_TRUE(sink->write(params(1)));
  ASSERT_TRUE(receive_until(*source, [](const Sample& s) { return is_params(s, 1); }));
  slot.remove();
  auto second = open_sink(url("?layout=identified_i386"));
  ASSERT_TRUE(second->write(constants(1920)));
  ASSERT_TRUE(receive_until(*source, [](const Sample& s) { return s.record.index() == 1; }));
  EXPECT_EQ(std::get<wire::CameraConstants>(into.sample.record).image_width, 1920);
  EXPECT_STREQ(into.sample.origin, "binary identified_i386");
  ASSERT_TRUE(second->write(params(2)));
  EXPECT_TRUE(receive_until(*source, [](const Sample& s) { return is_params(s, 2); }));
  EXPECT_EQ(source->statistics().reattached, 1U);
}

TEST_F(Shm, a_slot_with_another_segment_is_followed_although_the_old_one_exists) {
  // Only the file is removed: its old segment stays, but no program can reach it. Meanwhile a hard link reserves its
  // inode, and therefore its key, so that no other slot gets it.
  struct Spare {
    const std::string path;
    ~Spare() { ::unlink(path.c_str()); }
  } const spare{slot.path() + ".spare"};
  const auto sink = open_sink(url());
  const auto source = open_source(url());
  ASSERT_TRUE(sink->write(params(1)));
  ASSERT_TRUE(receive_until(*source, [](const Sample& s) { return is_params(s, 1); }));
  ASSERT_EQ(::rename(slot.path().c_str(), spare.path.c_str()), 0);
  const auto second = open_sink(url());
  ASSERT_TRUE(idle_until(*source, [&] { return source->statistics().reattached == 1; }));
  ASSERT_TRUE(second->write(params(2)));
  EXPECT_TRUE(receive_until(*source, [](const Sample& s) { return is_params(s, 2); }));
}

TEST_F(Shm, a_sink_recreates_a_removed_segment_with_its_constants) {
  const auto sink = open_sink(url());
  ASSERT_TRUE(sink->write(constants()));
  slot.remove();
  ASSERT_TRUE(sink->write(params(9)));
  const auto reader = Segment::attach(slot.number());
  ASSERT_TRUE(reader);
  RecordImage image;
  ASSERT_TRUE(reader->copy_params(image));
  EXPECT_EQ(*wire::params_from_image(image.view(), reader->layout().record), params(9));
  ASSERT_TRUE(reader->copy_constants(image));
  EXPECT_EQ(*wire::constants_from_image(image.view(), reader->layout().record), constants());
}

TEST_F(Shm, recreate_makes_a_new_segment_when_all_others_have_detached) {
  const auto sink = open_sink(url("?recreate=1"));
  auto source = open_source(url());
  ASSERT_TRUE(sink->write(constants()));
  ASSERT_TRUE(sink->write(params(1)));
  const int first = slot.segment();
  EXPECT_EQ(slot.segment(), first) << "as long as others are attached";
  source.reset();
  ASSERT_TRUE(sink->write(params(2)));
  const int second = slot.segment();
  ASSERT_GE(second, 0);
  EXPECT_NE(second, first);
  ASSERT_TRUE(sink->write(params(3)));
  EXPECT_EQ(slot.segment(), second) << "once is enough";
  const auto reader = Segment::attach(slot.number());
  ASSERT_TRUE(reader);
  EXPECT_EQ(reader->connected(), 2);
  EXPECT_EQ(reader->params_counter(), 3);
  EXPECT_EQ(reader->constants_counter(), 1);
  RecordImage image;
  ASSERT_TRUE(reader->copy_constants(image));
  EXPECT_EQ(*wire::constants_from_image(image.view(), reader->layout().record), constants());
}

TEST_F(Shm, an_i386_segment_refuses_a_counter_that_it_cannot_hold) {
  const auto sink = open_sink(url("?layout=document_i386"));
  EXPECT_TRUE(sink->write(params(0xFFFFFFFF)));
  const auto result = sink->write(params(0x100000000));
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().reason, SinkReason::not_encodable);
  EXPECT_STREQ(result.error().fault.name(), wire::name(wire::Reason::out_of_range));
  EXPECT_EQ(sink->statistics().errors, 1U);
  EXPECT_EQ(sink->statistics().params, 1U);
}

TEST_F(Shm, only_the_malformed_record_is_lost) {
  const auto sink = open_sink(url());
  const auto source = open_source(url());
  auto* memory = static_cast<char*>(::shmat(slot.segment(), nullptr, 0));
  wire::Buffer buffer;
  const auto image = wire::to_image(params(1), layout().record, buffer);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::uint16_t counter = 1;
  std::memcpy(memory + layout().params[1], image->data(), image->size());
  std::memcpy(memory + layout().params[1] + 136, &nan, sizeof nan);
  std::memcpy(memory + layout().params_counter, &counter, sizeof counter);
  ::shmdt(memory);
  ASSERT_EQ(source->receive(into, deadline), Event::malformed);
  EXPECT_STREQ(into.fault.name(), wire::name(wire::Reason::not_finite));
  EXPECT_EQ(into.sample.sender.kind, SenderKind::shm);
  ASSERT_TRUE(sink->write(params(2)));
  ASSERT_EQ(source->receive(into, deadline), Event::sample);
  EXPECT_TRUE(is_params(into.sample, 2));
  EXPECT_EQ(source->statistics().malformed, 1U);
}

TEST_F(Shm, stop_wakes_a_waiting_reader_permanently) {
  const auto source = open_source(url());
  std::thread stopper([&] { source->stop(); });
  EXPECT_EQ(source->receive(into, -1ns), Event::stopped);
  stopper.join();
  EXPECT_EQ(source->receive(into, 0s), Event::stopped);
}

TEST_F(Shm, a_closed_sink_reports_it) {
  const auto sink = open_sink(url());
  ASSERT_TRUE(sink->write(constants()));
  ASSERT_TRUE(sink->close());
  EXPECT_FALSE(slot.has_file());
  EXPECT_EQ(sink->write(params(1)).error().reason, SinkReason::closed);
  EXPECT_EQ(sink->write(constants()).error().reason, SinkReason::closed);
  EXPECT_FALSE(slot.has_file());
}

TEST(ShmSettings, slots_that_do_not_exist_are_refused) {
  for (const int number : {-1, 62, 1000}) {
    Settings settings;
    settings.slot = number;
    EXPECT_THROW(shm::open_source(settings), TransportError) << number;
    EXPECT_THROW(shm::open_sink(settings), TransportError) << number;
  }
}

TEST(ShmSettings, layouts_without_a_segment_are_refused) {
  EXPECT_THROW(open_sink("shm:3?layout=document_llp64"), TransportError);
  EXPECT_THROW(open_sink("shm:3?layout=identified_lp64_be"), TransportError);
}

}  // namespace trk_bridge::shm::shm_test
