// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "link.h"

#include <algorithm>
#include <cstring>
#include <ctime>

#include "slot.h"
#include "wire/layout_detector.h"

namespace trk_bridge::shm {
namespace {

/// Faults of records in a segment that wire does not have.
enum class RecordProblem : std::uint8_t { implausible, uncertain, unsteady };

// `field` of such a fault is the size of the segment.
std::string describe_record(const transport::Fault& fault) {
  const std::string segment = "the segment of " + std::to_string(fault.field()) + " bytes";
  switch (static_cast<RecordProblem>(fault.code())) {
    case RecordProblem::implausible:
      return "no layout gives a record of " + segment +
             " a plausible rotation and numbers: its writer may use the layout of another size";
    case RecordProblem::uncertain:
      return "a record of " + segment +
             " is valid in both generations: the constants of the writer will show which one it is";
    case RecordProblem::unsteady:
      return segment + " changed during every attempt to copy it";
  }
  return "unknown problem";
}

transport::Fault record_fault(RecordProblem problem, const Segment& segment) noexcept {
  const char* const name = problem == RecordProblem::implausible ? "implausible record"
                           : problem == RecordProblem::uncertain ? "uncertain layout"
                                                                 : "unsteady segment";
  return {name, describe_record, static_cast<std::uint8_t>(problem), static_cast<std::int16_t>(segment.layout().size)};
}

std::string_view params_in(const RecordImage& image, const SegmentLayout& layout) noexcept {
  return image.part(layout.params[image.counter & 1U], layout.params_size);
}

std::string_view constants_in(const RecordImage& image, const SegmentLayout& layout) noexcept {
  return image.part(layout.constants[image.counter & 1U], layout.constants_size);
}

/// The fault of a record without a valid layout: that of wire, if it has one.
template <typename Record>
transport::Fault fault_of(const tl::expected<Record, wire::Fault>& record, const transport::Fault& of_layout) noexcept {
  return record ? of_layout : transport::Fault(record.error());
}

bool is_all_zero(std::string_view bytes) noexcept {
  return std::all_of(bytes.begin(), bytes.end(), [](char c) { return c == 0; });
}

// Constants were written if their counter is not 0, or, after 65536 of them, if they are not all zero.
bool has_constants(const Segment& segment) noexcept {
  if (segment.constants_counter() != 0) return true;
  RecordImage image;
  return !segment.copy_constants(image) || !is_all_zero(image.view());
}

}  // namespace

bool Link::begin_check_if_due(Clock::time_point now, std::chrono::milliseconds period) noexcept {
  if (checked_ && now - *checked_ < period) return false;
  checked_ = now;
  return true;
}

tl::expected<void, SlotFault> Link::keep_now(Clock::time_point now) noexcept {
  if (!segment_) {
    if (absent_ && !begin_check_if_due(now, attach_period)) return tl::unexpected(*absent_);
    return attach(nullptr, now);
  }
  checked_ = now;
  if (const auto checked = check(true, nullptr, now); !checked) return checked;
  if (has_written_ || !is_alone_too_long(now)) return {};
  absent_ = release();
  return tl::unexpected(*absent_);
}

tl::expected<void, SlotFault> Link::keep_for_writing_now(Clock::time_point now) noexcept {
  if (!segment_) return attach(options_.create, now);
  const bool is_due = begin_check_if_due(now, check_period);
  return check(is_due, options_.create, now);
}

tl::expected<void, SlotFault> Link::open_for_writing() noexcept {
  // A creator that takes longer has died or is not a trk program.
  constexpr int attempts = 200;
  constexpr timespec pause{0, 1'000'000};
  auto opened = keep_for_writing(Clock::now());
  for (int i = 1; i < attempts && !opened && is_transient(opened.error().problem); ++i) {
    ::nanosleep(&pause, nullptr);
    opened = keep_for_writing(Clock::now());
  }
  return opened;
}

tl::expected<void, SlotFault> Link::check(bool look_up, const SegmentLayout* create, Clock::time_point now) noexcept {
  if (segment_->status(look_up) != SegmentStatus::current) {
    segment_.reset();
    return attach(create, now);
  }
  if (!options_.recreate || !segment_->writable()) return {};
  const std::size_t attachments = segment_->attachments();
  if (attachments > 1) had_others_ = true;
  if (attachments != 1 || !had_others_) return {};
  had_others_ = false;
  const std::uint16_t unread = static_cast<std::uint16_t>(segment_->params_counter() - params_read_);
  const bool constants_unread = constants_unread_ || segment_->constants_counter() != constants_read_;
  if (const auto fresh = segment_->recreate(options_.mode); !fresh) {
    absent_ = fresh.error();
    segment_.reset();
    return tl::unexpected(fresh.error());
  }
  ++attached_;
  // The contents are the same, so what was not read before is still unread.
  params_read_ = static_cast<std::uint16_t>(segment_->params_counter() - unread);
  constants_read_ = segment_->constants_counter();
  constants_unread_ = constants_unread;
  return {};
}

Link::Activity Link::activity() const noexcept {
  return {segment_->attach_info(), segment_->params_counter(), segment_->constants_counter()};
}

// A program may attach, write and detach between two checks: the times of the kernel or the counters show this.
bool Link::is_alone_too_long(Clock::time_point now) noexcept {
  const Activity now_seen = activity();
  const bool is_quiet = now_seen.attach_info == last_activity_.attach_info &&
                        now_seen.params == last_activity_.params && now_seen.constants == last_activity_.constants;
  last_activity_ = now_seen;
  if (now_seen.attach_info.attachments != 1) {
    alone_since_.reset();
  } else if (!is_quiet || !alone_since_) {
    alone_since_ = now;
  }
  return alone_since_ && now - *alone_since_ >= alone_limit;
}

SlotFault Link::release() noexcept {
  const int id = segment_->id();
  segment_.reset();
  const auto found = find_segment(options_.slot);
  if (!found) return found.error();
  if (found->id == id) abandoned_ = Abandoned{id, attach_info_of(found->state)};
  return slot_fault(SlotProblem::abandoned, options_.slot);
}

bool Link::is_still_abandoned() const noexcept {
  if (!abandoned_) return false;
  const auto found = find_segment(options_.slot);
  return found && found->id == abandoned_->id && attach_info_of(found->state) == abandoned_->attach_info;
}

tl::expected<void, SlotFault> Link::attach(const SegmentLayout* create, Clock::time_point now) noexcept {
  checked_ = now;
  if (create == nullptr && is_still_abandoned()) return tl::unexpected(*absent_);
  auto segment = create != nullptr ? Segment::attach_or_create(options_.slot, *create, options_.mode)
                                   : Segment::attach(options_.slot);
  if (!segment) {
    absent_ = segment.error();
    return tl::unexpected(segment.error());
  }
  absent_.reset();
  segment_.emplace(std::move(*segment));
  ++attached_;
  had_others_ = segment_->attachments() > 1;
  begin_reading(now);
  return {};
}

void Link::begin_reading(Clock::time_point now) noexcept {
  last_activity_ = activity();
  alone_since_.reset();
  if (last_activity_.attach_info.attachments == 1) alone_since_ = now;
  const bool is_known = abandoned_ && abandoned_->id == segment_->id();
  abandoned_.reset();
  if (is_known) return;
  writer_layout_ = nullptr;
  known_head_.reset();
  read_in_ = segment_->layout().record;
  const bool restore = written_constants_ && segment_->writable() && !has_constants(*segment_);
  // It cannot fail: they were written to a segment before, and every layout can hold them.
  if (restore) static_cast<void>(segment_->write(*written_constants_));
  params_read_ = segment_->params_counter();
  constants_read_ = segment_->constants_counter();
  constants_unread_ = !restore && has_constants(*segment_);
}

tl::expected<const SegmentLayout*, transport::Fault> Link::layout_of_constants(const RecordImage& image) noexcept {
  const SegmentLayout& own = segment_->layout();
  const SegmentLayout* const smaller = smaller_generation(own);
  const unsigned own_grade = wire::constants_grade(constants_in(image, own), own.record);
  const unsigned other_grade =
      smaller != nullptr ? wire::constants_grade(constants_in(image, *smaller), smaller->record) : 0;
  // Without the sizes of an image and a chip, they may be zeros or parts of other numbers.
  if (own_grade == 0 && other_grade < 2) return tl::unexpected(record_fault(RecordProblem::implausible, *segment_));
  const bool is_open = own_grade == other_grade && own_grade == 1;
  if (is_open) return writer_layout_ != nullptr ? writer_layout_ : &own;
  // Plausible constants of the larger generation are not plausible in the smaller one: the image size would be id and
  // width, and the chip size would come from whole numbers.
  writer_layout_ = own_grade > other_grade ? &own : smaller;
  return writer_layout_;
}

tl::expected<const SegmentLayout*, transport::Fault> Link::layout_of_params(const RecordImage& image) noexcept {
  const SegmentLayout& own = segment_->layout();
  const SegmentLayout* const smaller = smaller_generation(own);
  const unsigned own_grade = wire::params_grade(params_in(image, own), own.record);
  const unsigned other_grade = smaller != nullptr ? wire::params_grade(params_in(image, *smaller), smaller->record) : 0;
  if (own_grade == 0 && other_grade == 0) return tl::unexpected(record_fault(RecordProblem::implausible, *segment_));
  if (own_grade == 0 || other_grade == 0) {
    writer_layout_ = own_grade > 0 ? &own : smaller;
    return writer_layout_;
  }
  // Plausible in both: only possible if the numbers have the same offsets in both generations.
  const std::string_view record = image.view();
  const bool has_first_word = !is_all_zero(record.substr(0, 4)), has_second_word = !is_all_zero(record.substr(4, 4));
  if (!has_first_word && !has_second_word) return &own;  // id and format are 0: the same in both
  RecordImage constants;
  if (writer_layout_ == nullptr && has_constants(*segment_) && segment_->copy_constants(constants)) {
    static_cast<void>(layout_of_constants(constants));
  }
  if (writer_layout_ != nullptr) return writer_layout_;
  // A format after an id: padding seldom looks like one.
  if (has_second_word && own_grade >= other_grade) return &own;
  return tl::unexpected(record_fault(RecordProblem::uncertain, *segment_));
}

tl::expected<const SegmentLayout*, transport::Fault> Link::known_layout_of_params(const RecordImage& image) noexcept {
  const SegmentLayout& own = segment_->layout();
  std::uint64_t head = 0;
  std::memcpy(&head, image.view().data(), sizeof head);
  if (known_head_ == head) return &own;
  known_head_.reset();
  const auto layout = layout_of_params(image);
  if (layout && *layout == &own && writer_layout_ == &own) known_head_ = head;
  return layout;
}

ReadResult Link::read(wire::CameraParams& into, transport::Fault& fault) noexcept {
  if (!has_new_params()) return ReadResult::nothing;
  RecordImage image;
  if (!segment_->copy_params(image)) {
    fault = record_fault(RecordProblem::unsteady, *segment_);
    return ReadResult::malformed;
  }
  count_params(image.counter);
  const auto layout = known_layout_of_params(image);
  if (!layout) {
    fault = fault_of(wire::params_from_image(image.view(), segment_->layout().record), layout.error());
    return ReadResult::malformed;
  }
  read_in_ = (*layout)->record;
  const auto params = wire::params_from_image(params_in(image, **layout), read_in_);
  if (!params) {
    fault = params.error();
    return ReadResult::malformed;
  }
  into = *params;
  return ReadResult::fresh;
}

ReadResult Link::read(wire::CameraConstants& into, transport::Fault& fault) noexcept {
  if (!has_new_constants()) return ReadResult::nothing;
  RecordImage image;
  if (!segment_->copy_constants(image)) {
    fault = record_fault(RecordProblem::unsteady, *segment_);
    return ReadResult::malformed;
  }
  constants_unread_ = false;
  constants_read_ = image.counter;
  const auto layout = layout_of_constants(image);
  if (!layout) {
    fault = fault_of(wire::constants_from_image(image.view(), segment_->layout().record), layout.error());
    return ReadResult::malformed;
  }
  const auto constants = wire::constants_from_image(constants_in(image, **layout), (*layout)->record);
  if (!constants) {
    fault = constants.error();
    return ReadResult::malformed;
  }
  read_in_ = (*layout)->record;
  into = *constants;
  return ReadResult::fresh;
}

tl::expected<void, wire::Fault> Link::write(const wire::CameraParams& params) noexcept {
  has_written_ = true;
  return segment_->write(params);
}

tl::expected<void, wire::Fault> Link::write(const wire::CameraConstants& constants) noexcept {
  has_written_ = true;
  auto written = segment_->write(constants);
  if (written) written_constants_ = constants;
  return written;
}

}  // namespace trk_bridge::shm
