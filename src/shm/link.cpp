#include "link.h"

#include <algorithm>

namespace trk_bridge::shm {
namespace {

// Constants have been written when their counter has moved, or, after 65536 of them, when they are not all zero.
bool has_constants(const Segment& segment) noexcept {
  if (segment.constants_counter() != 0) return true;
  RecordImage image;
  if (!segment.copy_constants(image)) return true;
  const auto bytes = image.view();
  return std::any_of(bytes.begin(), bytes.end(), [](char c) { return c != 0; });
}

}  // namespace

bool Link::look_due(Clock::time_point now, std::chrono::milliseconds period) noexcept {
  if (looked_ && now - *looked_ < period) return false;
  looked_ = now;
  return true;
}

tl::expected<void, SlotFault> Link::keep(Clock::time_point now) noexcept {
  if (segment_) {
    if (!look_due(now, check_period)) return {};
    return check(true, nullptr, now);
  }
  if (absent_ && !look_due(now, attach_period)) return tl::unexpected(*absent_);
  return attach(nullptr, now);
}

tl::expected<void, SlotFault> Link::keep_for_writing(Clock::time_point now) noexcept {
  if (!segment_) return attach(options_.create, now);
  return check(look_due(now, check_period), options_.create, now);
}

tl::expected<void, SlotFault> Link::check(bool look_up, const SegmentLayout* create, Clock::time_point now) noexcept {
  if (segment_->fate(look_up) != SegmentFate::current) {
    segment_.reset();
    return attach(create, now);
  }
  if (!options_.recreate || !segment_->writable()) return {};
  const std::size_t attachments = segment_->attachments();
  if (attachments > 1) had_company_ = true;
  if (attachments != 1 || !had_company_) return {};
  had_company_ = false;
  const std::uint16_t unread = static_cast<std::uint16_t>(segment_->params_counter() - params_read_);
  const bool constants_unread = constants_unread_ || segment_->constants_counter() != constants_read_;
  if (const auto fresh = segment_->recreate(options_.mode); !fresh) {
    absent_ = fresh.error();
    segment_.reset();
    return tl::unexpected(fresh.error());
  }
  ++attached_;
  // The contents are the same, so what was unread before still is.
  params_read_ = static_cast<std::uint16_t>(segment_->params_counter() - unread);
  constants_read_ = segment_->constants_counter();
  constants_unread_ = constants_unread;
  return {};
}

tl::expected<void, SlotFault> Link::attach(const SegmentLayout* create, Clock::time_point now) noexcept {
  looked_ = now;
  auto segment = create != nullptr ? Segment::attach_or_create(options_.slot, *create, options_.mode)
                                   : Segment::attach(options_.slot);
  if (!segment) {
    absent_ = segment.error();
    return tl::unexpected(segment.error());
  }
  absent_.reset();
  segment_.emplace(std::move(*segment));
  ++attached_;
  had_company_ = segment_->attachments() > 1;
  begin_reading();
  return {};
}

void Link::begin_reading() noexcept {
  const bool restore = written_constants_ && segment_->writable() && !has_constants(*segment_);
  // They went into a segment before, and no layout refuses constants that another one can hold.
  if (restore) static_cast<void>(segment_->write(*written_constants_));
  params_read_ = segment_->params_counter();
  constants_read_ = segment_->constants_counter();
  constants_unread_ = !restore && has_constants(*segment_);
}

ReadResult Link::read(wire::CameraParams& into, wire::Fault& fault) noexcept {
  if (!segment_ || segment_->params_counter() == params_read_) return ReadResult::nothing;
  RecordImage image;
  if (!segment_->copy_params(image)) return ReadResult::nothing;
  overwritten_ += static_cast<std::uint16_t>(image.counter - params_read_ - 1U);
  params_read_ = image.counter;
  const auto params = wire::params_from_image(image.view(), segment_->layout().record);
  if (!params) {
    fault = params.error();
    return ReadResult::malformed;
  }
  into = *params;
  return ReadResult::fresh;
}

ReadResult Link::read(wire::CameraConstants& into, wire::Fault& fault) noexcept {
  if (!segment_) return ReadResult::nothing;
  if (!constants_unread_ && segment_->constants_counter() == constants_read_) return ReadResult::nothing;
  RecordImage image;
  if (!segment_->copy_constants(image)) return ReadResult::nothing;
  constants_unread_ = false;
  constants_read_ = image.counter;
  const auto constants = wire::constants_from_image(image.view(), segment_->layout().record);
  if (!constants) {
    fault = constants.error();
    return ReadResult::malformed;
  }
  into = *constants;
  return ReadResult::fresh;
}

tl::expected<void, wire::Fault> Link::write(const wire::CameraParams& params) noexcept {
  return segment_->write(params);
}

tl::expected<void, wire::Fault> Link::write(const wire::CameraConstants& constants) noexcept {
  auto written = segment_->write(constants);
  if (written) written_constants_ = constants;
  return written;
}

}  // namespace trk_bridge::shm
