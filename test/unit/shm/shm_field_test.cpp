// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Existing programs together with this package: which may start first, what a program of another generation writes,
// which are counted.
#include <chrono>
#include <cstdio>
#include <fstream>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include "deadline.h"
#include "field_program.h"
#include "free_slot.h"
#include "shm/link.h"
#include "trk_bridge/endpoints/endpoints.h"
#include "trk_bridge/transport/sink.h"
#include "trk_bridge/transport/source.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::shm::shm_field_test {

using namespace std::chrono_literals;
using endpoints::open_sink;
using endpoints::open_source;
using test::FieldProgram;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using transport::Event;
using transport::Reception;
using transport::Sample;
using transport::Source;
using transport::SourceState;
using Clock = std::chrono::steady_clock;

const SegmentLayout& of(std::size_t size) { return *layout_of_size(size); }

/// Realistic numbers, none of them round.
wire::CameraParams params(std::uint64_t counter, std::uint32_t format = wire::euler, std::uint32_t id = 0) {
  const double t = 0.013 * static_cast<double>(counter);
  wire::CameraParams p;
  p.id = id;
  p.format = format;
  if (wire::has(format, wire::euler)) {
    p.euler = {1.1 + t, -2.3, 1.7, 30.7 - t, -5.1, 0.3};
  } else {
    const double c = std::cos(t), s = std::sin(t);
    p.matrix = {c, s, 0, 0, -s, c, 0, 0, 0, 0, 1, 0, 1.1 + t, -2.3, 1.7, 1};
  }
  p.fov = 42.3;
  p.center_x = 0.1;
  p.center_y = -0.07;
  p.k1 = -1.1e-3;
  p.k2 = 3.3e-6;
  p.focdist = 4.6;
  p.aperture = 2.9;
  p.counter = counter;
  return p;
}

wire::CameraConstants constants(std::uint32_t id = 0) {
  wire::CameraConstants c;
  c.id = id;
  c.image_width = 1920;
  c.image_height = 1080;
  c.blank_left = 10;
  c.blank_right = 12;
  c.chip_width = c.fake_chip_width = 9.59;
  c.chip_height = c.fake_chip_height = 5.39;
  return c;
}

class Field : public ::testing::Test {
 protected:
  std::string url(const std::string& options = "") const { return "shm:" + std::to_string(slot.number()) + options; }

  /// Receives, for as long as `done` is not true.
  ::testing::AssertionResult receive_until(Source& source, const std::function<bool()>& done) {
    const auto end = Clock::now() + test::deadline;
    while (!done()) {
      if (Clock::now() > end)
        return ::testing::AssertionFailure() << "not in time; " << source.statistics().waiting_for;
      static_cast<void>(source.receive(into, 5ms));
    }
    return ::testing::AssertionSuccess();
  }
  void receive_for(Source& source, std::chrono::milliseconds time) {
    const auto end = Clock::now() + time;
    while (Clock::now() < end) static_cast<void>(source.receive(into, 5ms));
  }
  std::size_t attachments(int id) const {
    shmid_ds state{};
    return ::shmctl(id, IPC_STAT, &state) == 0 ? state.shm_nattch : 0;
  }

  test::FreeSlot slot;
  Reception into;
};

TEST_F(Field, a_new_segment_can_be_opened_by_every_current_program) {
  const auto sink = open_sink(url());
  FieldProgram today(slot, of(544)), of_1998(slot, of(528));
  EXPECT_TRUE(today.open());
  EXPECT_TRUE(of_1998.open());
  EXPECT_EQ(today.id(), slot.segment());
}

TEST_F(Field, a_reader_alone_lets_a_program_with_a_larger_segment_start) {
  FieldProgram of_1998(slot, of(528));
  ASSERT_TRUE(of_1998.open());
  const auto source = open_source(url());
  ASSERT_TRUE(receive_until(*source, [&] { return attachments(slot.segment()) == 2; }));
  of_1998.close();
  ASSERT_TRUE(slot.has_file()) << "as long as the reader is attached";
  FieldProgram today(slot, of(544));
  ASSERT_FALSE(today.open()) << "its segment is larger";
  ASSERT_TRUE(receive_until(*source, [&] { return today.open(); }));
  EXPECT_EQ(source->statistics().state, SourceState::waiting);
  today.write(constants());
  ASSERT_TRUE(receive_until(*source, [&] { return source->statistics().records == 1; }));
  today.write(params(7));
  ASSERT_TRUE(receive_until(*source, [&] { return source->statistics().records == 2; }));
  EXPECT_EQ(std::get<wire::CameraParams>(into.sample.record), params(7));
  EXPECT_STREQ(into.sample.origin, "binary identified_lp64");
}

TEST_F(Field, a_reader_alone_leaves_no_segment_and_no_file) {
  FieldProgram tracker(slot, of(544));
  ASSERT_TRUE(tracker.open());
  tracker.write(constants());
  const auto source = open_source(url());
  ASSERT_TRUE(receive_until(*source, [&] { return source->statistics().records == 1; }));
  tracker.close();
  const auto left = Clock::now();
  ASSERT_TRUE(receive_until(*source, [&] { return !slot.has_file(); }));
  EXPECT_GE(Clock::now() - left, Link::alone_limit - Link::check_period) << "a tracker that restarts finds it again";
  EXPECT_EQ(slot.segment(), -1);
  EXPECT_EQ(source->statistics().waiting_for, "slot " + std::to_string(slot.number()) + ": no segment");
}

TEST_F(Field, a_reader_stays_attached_beside_a_silent_or_a_short_lived_program) {
  FieldProgram silent(slot, of(544));
  ASSERT_TRUE(silent.open());
  const auto source = open_source(url());
  const int id = silent.id();
  receive_for(*source, 1500ms);
  EXPECT_EQ(slot.segment(), id);
  EXPECT_EQ(attachments(id), 2U);
  silent.close();
  for (std::uint64_t i = 1; i <= 6; ++i) {
    receive_for(*source, 400ms);
    FieldProgram visitor(slot, of(544));
    ASSERT_TRUE(visitor.open());
    ASSERT_EQ(visitor.id(), id) << "visit " << i;
    visitor.write(params(i));
  }
  receive_for(*source, 100ms);
  EXPECT_EQ(source->statistics().records, 6U);
  EXPECT_EQ(source->statistics().reattached, 0U);
}

TEST_F(Field, a_writer_alone_keeps_its_segment) {
  const auto sink = open_sink(url());
  const int id = slot.segment();
  Link both({slot.number(), &of(544), 0666, false});
  ASSERT_TRUE(both.keep_for_writing(Clock::now()));
  ASSERT_TRUE(sink->close());
  ASSERT_TRUE(both.write(params(1)));
  const auto now = Clock::now();
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(both.keep(now + i * 200ms)) << "it may read as well";
  EXPECT_EQ(slot.segment(), id);
}

TEST_F(Field, a_segment_that_the_reader_may_not_remove_is_detached_and_read_again) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root can be two users";
  FieldProgram tracker(slot, of(544));
  ASSERT_TRUE(tracker.open());
  const int id = tracker.id();
  constexpr int good = 0, still_attached = 1, no_record = 2;
  int has_read[2] = {};
  ASSERT_EQ(::pipe(has_read), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    // Attachments of the parent are inherited by fork().
    tracker.connected() += 1;
    tracker.close();
    if (::setuid(65534) != 0) ::_exit(98);
    const auto source = open_source(url());
    if (!receive_until(*source, [&] { return source->statistics().records > 0; })) ::_exit(no_record);
    if (::write(has_read[1], "1", 1) != 1) ::_exit(5);
    if (!receive_until(*source, [&] { return attachments(id) == 0; })) ::_exit(still_attached);
    if (source->statistics().waiting_for.find("no other program is attached to its segment") == std::string::npos)
      ::_exit(3);
    // What was written without a reader is also read.
    const bool is_read =
        receive_until(*source, [&] { return std::get<wire::CameraParams>(into.sample.record) == params(2); });
    ::_exit(is_read ? good : no_record);
  }
  EXPECT_TRUE(test::becomes_true([&] { return tracker.connected() == 2; }));
  ::close(has_read[1]);
  // Sets that are written while the child attaches may be old for it.
  EXPECT_TRUE(test::becomes_true([&] {
    tracker.write(params(1));
    pollfd answer{has_read[0], POLLIN, 0};
    return ::poll(&answer, 1, 20) == 1 && (answer.revents & POLLIN) != 0;
  }));
  tracker.connected() += 1;  // so that closing leaves the segment
  ::close(has_read[0]);
  tracker.close();
  EXPECT_TRUE(test::becomes_true([&] { return attachments(id) == 0; }));
  EXPECT_EQ(slot.segment(), id) << "it belongs to another user";
  // The kernel's times are in seconds.
  std::this_thread::sleep_for(1100ms);
  ASSERT_TRUE(tracker.open());
  tracker.write(params(2));
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_EQ(WEXITSTATUS(status), good);
}

TEST_F(Field, connected_is_corrected_by_every_program_of_ours_that_attaches) {
  FieldProgram tracker(slot, of(544));
  ASSERT_TRUE(tracker.open());
  tracker.connected() = 20;  // the dead
  const auto first = Segment::attach(slot.number());
  ASSERT_TRUE(first);
  EXPECT_EQ(tracker.connected(), 2);
  tracker.connected() = 20;
  const auto second = open_sink(url());
  EXPECT_EQ(tracker.connected(), 3);
  tracker.connected() = 0;
  const auto third = open_source(url());
  EXPECT_EQ(tracker.connected(), 4);
}

TEST_F(Field, a_tracker_is_the_last_one_although_others_crashed) {
  FieldProgram tracker(slot, of(544));
  ASSERT_TRUE(tracker.open());
  tracker.connected() += 3;
  open_source(url()).reset();
  EXPECT_EQ(tracker.connected(), 1);
  tracker.close();
  EXPECT_FALSE(slot.has_file());
}

/// A program that attaches to a segment that is larger than its own.
struct Guest {
  std::size_t host, own;
  std::uint32_t format, id;
  bool has_constants;
  std::uint64_t read_at_least;  ///< of 199 sets
};
std::ostream& operator<<(std::ostream& out, const Guest& g) {
  return out << g.own << "_in_" << g.host << "_format_" << std::hex << g.format << std::dec << "_id_" << g.id
             << (g.has_constants ? "" : "_without_constants");
}

class Guests : public Field, public ::testing::WithParamInterface<Guest> {};

TEST_P(Guests, nothing_is_read_that_was_never_sent) {
  const Guest& guest = GetParam();
  const auto host = Segment::attach_or_create(slot.number(), of(guest.host), 0666);
  ASSERT_TRUE(host);
  const auto source = open_source(url());
  FieldProgram program(slot, of(guest.own));
  ASSERT_TRUE(program.open());
  std::uint64_t wrong = 0, right = 0;
  std::set<std::string> faults;
  const auto sent_constants = constants(guest.id);
  const auto read_all = [&](const wire::CameraParams* last) {
    for (Event event = Event::malformed; event != Event::idle;) {
      // A malformed record is checked less often.
      event = source->receive(into, source->statistics().malformed > 0 ? 300us : 0us);
      if (event == Event::malformed) faults.insert(describe(into.fault));
      if (event != Event::sample) continue;
      const auto* p = std::get_if<wire::CameraParams>(&into.sample.record);
      const bool is_sent = p != nullptr ? last != nullptr && *p == *last
                                        : std::get<wire::CameraConstants>(into.sample.record) == sent_constants;
      ++(is_sent ? right : wrong);
    }
  };
  if (guest.has_constants) program.write(sent_constants);
  read_all(nullptr);
  for (std::uint64_t i = 1; i <= 199; ++i) {
    const auto sent = params(i, guest.format, guest.id);
    program.write(sent);
    read_all(&sent);
    // Programs that start later repeat them.
    if (guest.has_constants && i == 100) program.write(sent_constants);
  }
  EXPECT_EQ(wrong, 0U);
  EXPECT_GE(right, guest.read_at_least);
  if (right == 0) {
    if (source->statistics().malformed == 0) {
      EXPECT_THAT(source->statistics().waiting_for, HasSubstr("32-bit program")) << "it reports the reason";
    } else {
      const bool is_32_bit = guest.own < 528;
      EXPECT_THAT(faults, ElementsAre(HasSubstr(is_32_bit ? "its writer may use the layout of another size"
                                                          : "valid in both generations: the constants of the writer")));
    }
    EXPECT_NE(source->statistics().state, SourceState::receiving);
  }
}

std::vector<Guest> guests() {
  std::vector<Guest> all;
  const auto studio_to_camera_y_up = wire::studio_to_camera | wire::camera_y_up | wire::studio_y_up;
  for (const std::uint32_t format :
       {std::uint32_t{0}, std::uint32_t{wire::euler}, wire::euler | wire::field_of_view | wire::vertical,
        std::uint32_t{wire::studio_y_up}, wire::camera_y_up | wire::studio_y_up,
        std::uint32_t{studio_to_camera_y_up}}) {
    for (const bool has_constants : {true, false}) {
      // Without constants a matrix with options looks like one with a camera id, and is not given.
      const bool is_uncertain = !has_constants && format != 0 && !wire::has(format, wire::euler);
      const std::uint64_t all_sets = has_constants ? 201 : 199;
      all.push_back({544, 528, format, 0, has_constants, is_uncertain ? 0 : all_sets});
      all.push_back({524, 508, format, 0, has_constants, all_sets});
      all.push_back({544, 544, format, 0, has_constants, all_sets});
      for (const std::uint32_t id : {3U, 4U, 4'000'000'000U}) {
        const bool is_even = !has_constants && format == 0 && id == 4;
        all.push_back({544, 544, format, id, has_constants, is_even ? 0 : all_sets});
        all.push_back({524, 524, format, id, has_constants, all_sets});
      }
      // 32-bit programs have the counters elsewhere: their records cannot be read.
      for (const std::size_t host : {std::size_t{544}, std::size_t{528}}) {
        all.push_back({host, 524, format, 3, has_constants, 0});
        all.push_back({host, 508, format, 0, has_constants, 0});
      }
    }
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(All, Guests, ::testing::ValuesIn(guests()));

// Where a smaller layout has its constants, there may be zeros or parts of other numbers.
TEST_F(Field, implausible_constants_are_not_read_in_the_smaller_layout) {
  FieldProgram program(slot, of(544));
  ASSERT_TRUE(program.open());
  const auto source = open_source(url());
  wire::CameraConstants implausible;
  implausible.fake_chip_width = 3.33e-294;
  implausible.fake_chip_height = 2.18e-289;
  for (const std::int32_t height : {0, 13056}) {
    implausible.image_height = height;
    program.write(implausible);
    ASSERT_EQ(source->receive(into, 1s), Event::malformed);
    EXPECT_THAT(describe(into.fault), HasSubstr("no layout gives a record of the segment of 544 bytes"));
  }
}

TEST_F(Field, constants_that_are_all_zero_are_read) {
  FieldProgram program(slot, of(544));
  ASSERT_TRUE(program.open());
  const auto source = open_source(url());
  program.write(wire::CameraConstants{});
  ASSERT_EQ(source->receive(into, 1s), Event::sample);
  EXPECT_EQ(std::get<wire::CameraConstants>(into.sample.record), wire::CameraConstants{});
}

TEST_F(Field, a_slot_does_not_get_the_segment_of_another_whose_file_was_deleted) {
  test::FreeSlot other;
  const std::string other_url = "shm:" + std::to_string(other.number());
  const auto sink = open_sink(other_url);
  const auto source = open_source(other_url);
  const int id = other.segment();
  struct stat before {
  }, probe{};
  ASSERT_EQ(::stat(other.path().c_str(), &before), 0);
  ::unlink(other.path().c_str());
  std::ofstream(slot.path()).close();
  ASSERT_EQ(::stat(slot.path().c_str(), &probe), 0);
  ::unlink(slot.path().c_str());
  if (probe.st_ino != before.st_ino) GTEST_SKIP() << "this file system does not use an inode again at once";
  const auto stranger = open_sink(url());
  // Has the inode now, so that no file of another program gets the key of the segment.
  const std::unique_ptr<std::FILE, decltype(&std::fclose)> placeholder(std::tmpfile(), &std::fclose);
  EXPECT_NE(slot.segment(), id);
  ASSERT_TRUE(stranger->write(params(1)));
  receive_for(*source, 50ms);
  EXPECT_EQ(source->statistics().records, 0U) << "a record was received";
}

}  // namespace trk_bridge::shm::shm_field_test
