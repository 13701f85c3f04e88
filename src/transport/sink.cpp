// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "trk_bridge/transport/sink.h"

#include <tuple>

#include "base/system_text.h"

namespace trk_bridge::transport {
namespace {

auto key(const SinkFault& fault) noexcept { return std::tie(fault.reason, fault.fault, fault.error_number); }

}  // namespace

bool operator==(const SinkFault& a, const SinkFault& b) noexcept { return key(a) == key(b); }
bool operator<(const SinkFault& a, const SinkFault& b) noexcept { return key(a) < key(b); }

std::string describe(const SinkFault& fault) {
  switch (fault.reason) {
    case SinkReason::not_encodable:
      return "the record cannot be written: " + describe(fault.fault);
    case SinkReason::no_constants:
      return "parameters came before the constants, which must be first in a file";
    case SinkReason::constants_changed:
      return "a file has one set of constants, and other ones came later";
    case SinkReason::other_camera:
      return "a file has one camera, and the id of this record is not that of the constants in the file";
    case SinkReason::system:
      return "the system refused: " + base::system_text(fault.error_number);
    case SinkReason::no_interface:
      return "the interface to send through does not exist or has no address; sending continues when it has one";
    case SinkReason::no_segment:
      return "there is no segment to write to; every write looks for one or creates it";
    case SinkReason::closed:
      return "the sink is closed";
    case SinkReason::exists:
      return "it exists; to overwrite it, use overwrite=1 or --overwrite";
    case SinkReason::part_exists:
      return "its .part is from an interrupted writer; move it away, or use --overwrite";
    case SinkReason::in_use:
      return "another writer is writing it";
    case SinkReason::not_a_file:
      return "it is neither an ordinary file nor a FIFO";
    case SinkReason::no_reader:
      return "no program reads this FIFO";
    case SinkReason::no_free_number:
      return "all numbers from 001 to 9999 are in use";
    case SinkReason::no_answer:
      return "it does not respond and was abandoned";
  }
  return "unknown fault";
}

WriteResult Sink::counted(const WriteResult& written, std::uint64_t& good) noexcept {
  ++(written ? good : counts_.errors);
  published_.store(counts_);
  return written;
}

void Sink::prepare() {
  if (!closed_) get_ready();
}

WriteResult Sink::write(const wire::CameraParams& params, const RecordTime& time) {
  time_ = time;
  return counted(closed_ ? WriteResult(refused(SinkReason::closed)) : put(params), counts_.params);
}

WriteResult Sink::write(const wire::CameraConstants& constants) {
  return counted(closed_ ? WriteResult(refused(SinkReason::closed)) : put(constants), counts_.constants);
}

WriteResult Sink::close() {
  if (closed_) return {};
  closed_ = true;
  std::uint64_t not_counted = 0;
  return counted(finish(), not_counted);
}

}  // namespace trk_bridge::transport
