// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include <cerrno>
#include <memory>
#include <string>

#include "link.h"
#include "scheme.h"

namespace trk_bridge::shm {
namespace {

using transport::SinkFault;
using transport::SinkReason;
using transport::TransportError;
using transport::WriteResult;

Link::Options options_of(const Settings& settings) {
  if (settings.slot < 0 || settings.slot >= slot_count) {
    throw TransportError("shm " + describe({SlotProblem::bad_slot, settings.slot}));
  }
  const std::string slot = "shm slot " + std::to_string(settings.slot);
  const wire::Layout record = wire::resolve(settings.layout, default_layout);
  const SegmentLayout* layout = layout_of(record);
  if (layout == nullptr) {
    throw TransportError(slot + ": no segment has the layout " + wire::describe(record) +
                         "; allowed are document and identified, lp64 and i386, in this machine's byte order");
  }
  if (settings.mode < 0 || settings.mode > 0777) {
    throw TransportError(slot + ": mode " + std::to_string(settings.mode) + " is not a permission from 0 to 0777");
  }
  return {settings.slot, layout, settings.mode, settings.recreate};
}

SinkFault fault_of(const SlotFault& fault) noexcept {
  if (fault.problem == SlotProblem::file_refused || fault.problem == SlotProblem::system)
    return {SinkReason::system, {}, fault.error_number};
  return {SinkReason::no_segment};
}

/// If the segment was removed or replaced, the next write recreates it; `gone` and `system` mean that this failed.
/// Nothing waits: if another program is creating or removing the segment, the next write tries again.
class ShmSink final : public transport::Sink {
 public:
  explicit ShmSink(const Settings& settings)
      : name_("shm slot " + std::to_string(settings.slot)), link_(options_of(settings)) {}

  std::string name() const override { return name_; }

 private:
  void get_ready() override {
    const auto open = link_.open_for_writing();
    if (!open) throw TransportError("shm " + describe(open.error()));
    if (!link_.segment()->writable()) throw TransportError(name_ + ": no permission to write to the segment");
  }
  WriteResult put(const wire::CameraParams& params) override { return write_record(params); }
  WriteResult put(const wire::CameraConstants& constants) override { return write_record(constants); }
  WriteResult finish() override {
    link_.close();
    return {};
  }

  template <typename Record>
  WriteResult write_record(const Record& record) {
    if (const auto kept = link_.keep_for_writing(Link::Clock::now()); !kept) {
      return tl::make_unexpected(fault_of(kept.error()));
    }
    if (!link_.segment()->writable()) return transport::refused_by_system(EACCES);
    if (const auto written = link_.write(record); !written) {
      return tl::make_unexpected(SinkFault{SinkReason::not_encodable, written.error(), 0});
    }
    return {};
  }

  const std::string name_;
  Link link_;
};

}  // namespace

std::unique_ptr<transport::Sink> open_sink(const Settings& settings) { return std::make_unique<ShmSink>(settings); }

}  // namespace trk_bridge::shm
