#include "take_writer.h"

#include <array>
#include <cerrno>
#include <system_error>
#include <utility>

#include <sys/uio.h>

#include "trk_bridge/transport/source.h"

namespace trk_bridge::file {
namespace {

tl::unexpected<transport::SinkFault> system_fault(int error) {
  transport::SinkFault fault{transport::SinkReason::system};
  fault.error_number = error;
  return tl::unexpected(fault);
}

tl::unexpected<transport::SinkFault> encode_fault(const wire::Fault& fault) {
  return tl::unexpected(transport::SinkFault{transport::SinkReason::not_encodable, fault});
}

}  // namespace

TakeWriter::TakeWriter(std::string path, const base::TimeCode& time_code, bool overwrite)
    : file_(std::move(path), overwrite) {
  const auto written =
      append("DMC01\n# time code of the first field\n" + to_string(time_code) + "\n# constants of the camera");
  if (!written) {
    file_.discard();
    throw transport::TransportError(
        file_.part() + ": cannot be written: " + std::system_category().message(written.error().error_number));
  }
}

TakeWriter::~TakeWriter() { static_cast<void>(close()); }

tl::expected<void, transport::SinkFault> TakeWriter::write(const wire::CameraConstants& constants) {
  if (!file_.is_open()) return tl::unexpected(transport::SinkFault{transport::SinkReason::closed});
  if (constants_) {
    if (constants.id != constants_->id)
      return tl::unexpected(transport::SinkFault{transport::SinkReason::other_camera});
    constants_hold_ = *constants_ == constants;
    if (!constants_hold_) return tl::unexpected(transport::SinkFault{transport::SinkReason::constants_changed});
    return {};
  }
  const auto text = wire::to_text(constants, buffer_);
  if (!text) return encode_fault(text.error());
  if (auto written = append(*text); !written) return written;
  constants_ = constants;
  constants_hold_ = true;
  return {};
}

tl::expected<void, transport::SinkFault> TakeWriter::write(const wire::CameraParams& params) {
  if (!file_.is_open()) return tl::unexpected(transport::SinkFault{transport::SinkReason::closed});
  if (!constants_) return tl::unexpected(transport::SinkFault{transport::SinkReason::no_constants});
  const std::uint32_t any = constants_->id == 0 ? params.id : constants_->id;
  if (params.id != camera_.value_or(any))
    return tl::unexpected(transport::SinkFault{transport::SinkReason::other_camera});
  if (!constants_hold_) return tl::unexpected(transport::SinkFault{transport::SinkReason::constants_changed});
  const auto text = wire::to_text(params, buffer_);
  if (!text) return encode_fault(text.error());
  auto written = append(*text);
  if (written) camera_ = params.id;
  return written;
}

tl::expected<void, transport::SinkFault> TakeWriter::append(std::string_view line) {
  std::array<iovec, 2> pieces{};
  std::size_t done = 0;
  const std::size_t length = line.size() + 1;
  char newline = '\n';
  while (done < length) {
    const std::size_t of_line = done < line.size() ? line.size() - done : 0;
    pieces[0] = {const_cast<char*>(line.data()) + (line.size() - of_line), of_line};
    pieces[1] = {&newline, 1};
    const ssize_t written = ::pwritev(file_.fd(), pieces.data(), static_cast<int>(pieces.size()),
                                      static_cast<off_t>(size_ + static_cast<std::int64_t>(done)));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return system_fault(written < 0 ? errno : EIO);
    done += static_cast<std::size_t>(written);
  }
  size_ += static_cast<std::int64_t>(length);
  return {};
}

tl::expected<void, transport::SinkFault> TakeWriter::close() {
  if (!file_.is_open()) return {};
  if (!constants_) {
    file_.discard();
    return tl::unexpected(transport::SinkFault{transport::SinkReason::no_constants});
  }
  // A write that failed half-way has left its beginning behind the last whole line.
  if (const auto published = file_.publish(size_); !published) return system_fault(published.error());
  return {};
}

}  // namespace trk_bridge::file
