#include <utility>

#include "backends.h"
#include "trk_bridge/transport/snapshot.h"
#include "trk_bridge/transport/take_file.h"

namespace trk_bridge::transport {
namespace {

class FileSink final : public Sink {
 public:
  FileSink(const std::string& path, const TimeCode& time_code, bool overwrite) : writer_(path, time_code, overwrite) {}

  tl::expected<void, SinkFault> write(const wire::CameraParams& params) override {
    return counted(writer_.write(params), counts_.params);
  }

  tl::expected<void, SinkFault> write(const wire::CameraConstants& constants) override {
    const bool is_first = !constants_written_;
    std::uint64_t repeated = 0;
    auto result = counted(writer_.write(constants), is_first ? counts_.constants : repeated);
    constants_written_ = constants_written_ || result;
    return result;
  }

  tl::expected<void, SinkFault> close() override {
    std::uint64_t closed = 0;
    return counted(writer_.close(), closed);
  }

  SinkStatistics statistics() const override { return published_.load(); }
  std::string name() const override { return "file " + writer_.path(); }

 private:
  tl::expected<void, SinkFault> counted(tl::expected<void, SinkFault> result, std::uint64_t& good) {
    ++(result ? good : counts_.errors);
    published_.store(counts_);
    return result;
  }

  TakeWriter writer_;
  SinkStatistics counts_;
  Snapshot<SinkStatistics> published_;
  bool constants_written_ = false;
};

}  // namespace

std::unique_ptr<Sink> open_file_sink(const FileEndpoint& endpoint) {
  const auto time_code = parse_time_code(endpoint.timecode);
  if (!time_code) throw TransportError("file " + endpoint.path + ": timecode: " + time_code.error());
  return std::make_unique<FileSink>(endpoint.path, *time_code, endpoint.overwrite);
}

}  // namespace trk_bridge::transport
