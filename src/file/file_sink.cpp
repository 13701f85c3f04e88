#include <memory>
#include <string>

#include "scheme.h"
#include "take_file.h"

namespace trk_bridge::file {
namespace {

using transport::Written;

class FileSink final : public transport::Sink {
 public:
  explicit FileSink(const SinkSettings& settings) : writer_(settings.path, settings.time_code, settings.overwrite) {}

  std::string name() const override { return "file " + writer_.path(); }

 private:
  Written put(const wire::CameraParams& params) override { return writer_.write(params); }
  Written put(const wire::CameraConstants& constants) override { return writer_.write(constants); }
  Written finish() override { return writer_.close(); }

  TakeWriter writer_;
};

}  // namespace

std::unique_ptr<transport::Sink> open_sink(const SinkSettings& settings) {
  return std::make_unique<FileSink>(settings);
}

}  // namespace trk_bridge::file
