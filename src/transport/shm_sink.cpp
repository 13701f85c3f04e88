#include <cerrno>

#include "backends.h"
#include "trk_bridge/transport/shm_link.h"

namespace trk_bridge::transport {
namespace {

constexpr wire::Layout default_layout{wire::Generation::document, wire::Abi::lp64, wire::ByteOrder::little};

ShmLink::Options options_of(const ShmEndpoint& endpoint) {
  const wire::Layout record = wire::resolve(endpoint.layout, default_layout);
  const ShmLayout* layout = shm_layout_of(record);
  if (layout == nullptr) {
    throw TransportError("shm slot " + std::to_string(endpoint.slot) + ": no segment has the layout " +
                         wire::describe(record) +
                         "; allowed are document and identified, lp64 and i386, in this machine's"
                         " byte order");
  }
  if (endpoint.mode < 0 || endpoint.mode > 0777) {
    throw TransportError("shm slot " + std::to_string(endpoint.slot) + ": mode " + std::to_string(endpoint.mode) +
                         " is not a permission from 0 to 0777");
  }
  return {endpoint.slot, layout, endpoint.mode, endpoint.recreate};
}

/// A segment that was removed or replaced is made anew within the write that meets it; `gone` is told when that failed.
class ShmSink final : public Sink {
 public:
  explicit ShmSink(const ShmEndpoint& endpoint) : slot_(endpoint.slot), link_(options_of(endpoint)) {
    const auto open = link_.keep_for_writing(ShmLink::Clock::now());
    if (!open) throw TransportError("shm " + describe(open.error()));
    if (!link_.segment()->writable()) throw TransportError(name() + ": no permission to write to the segment");
  }

  tl::expected<void, SinkFault> write(const wire::CameraParams& params) override {
    return put(params, statistics_.params);
  }

  tl::expected<void, SinkFault> write(const wire::CameraConstants& constants) override {
    if (!closed_ && constants_ == constants) {
      // The segment has them; if it is gone, the new one gets them.
      if (link_.keep_for_writing(ShmLink::Clock::now())) return {};
    }
    auto result = put(constants, statistics_.constants);
    if (result) constants_ = constants;
    return result;
  }

  tl::expected<void, SinkFault> close() override {
    closed_ = true;
    link_.close();
    return {};
  }

  SinkStatistics statistics() const override { return statistics_; }
  std::string name() const override { return "shm slot " + std::to_string(slot_); }

 private:
  template <typename Record>
  tl::expected<void, SinkFault> put(const Record& record, std::uint64_t& good) {
    if (closed_) return failed({SinkReason::closed});
    if (const auto kept = link_.keep_for_writing(ShmLink::Clock::now()); !kept) {
      return failed({SinkReason::gone, {}, kept.error().error_number});
    }
    if (!link_.segment()->writable()) return failed({SinkReason::system, {}, EACCES});
    if (const auto written = link_.write(record); !written) return failed({SinkReason::not_encodable, written.error()});
    ++good;
    return {};
  }

  tl::expected<void, SinkFault> failed(const SinkFault& fault) {
    ++statistics_.errors;
    return tl::unexpected(fault);
  }

  const int slot_;
  ShmLink link_;
  std::optional<wire::CameraConstants> constants_;
  SinkStatistics statistics_;
  bool closed_ = false;
};

}  // namespace

std::unique_ptr<Sink> open_shm_sink(const ShmEndpoint& endpoint) { return std::make_unique<ShmSink>(endpoint); }

}  // namespace trk_bridge::transport
