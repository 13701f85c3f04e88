#include <array>
#include <cerrno>
#include <cstdio>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

#include "trk_bridge/transport/source.h"
#include "trk_bridge/transport/take_file.h"

namespace trk_bridge::transport {
namespace {

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
  throw TransportError(path + ": cannot be written: " + reason);
}

tl::unexpected<SinkFault> system_fault(int error) {
  SinkFault fault{SinkReason::system};
  fault.error_number = error;
  return tl::unexpected(fault);
}

tl::unexpected<SinkFault> encode_fault(const wire::Fault& fault) {
  return tl::unexpected(SinkFault{SinkReason::not_encodable, fault});
}

/// Whether `fd` still is what `path` names: another writer may have finished between opening and locking.
bool is_named(int fd, const std::string& path) {
  struct stat mine {};
  struct stat there {};
  return ::fstat(fd, &mine) == 0 && ::stat(path.c_str(), &there) == 0 && mine.st_dev == there.st_dev &&
         mine.st_ino == there.st_ino;
}

/// Empties the locked file, or says why not.
std::string empty(int fd, bool overwrite) {
  struct stat there {};
  if (::fstat(fd, &there) != 0) return std::system_category().message(errno);
  if (!S_ISREG(there.st_mode)) return "it is no ordinary file";
  if (there.st_size > 0 && !overwrite) {
    return "it holds what an interrupted writer left; move it away, or ask for overwriting (overwrite=1)";
  }
  return ::ftruncate(fd, 0) == 0 ? std::string() : std::system_category().message(errno);
}

/// An empty file of that name, locked for as long as it is open.
int create_locked(const std::string& part, bool overwrite) {
  for (;;) {
    const int fd = ::open(part.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (fd < 0) fail(part, std::system_category().message(errno));
    if (::flock(fd, LOCK_EX | LOCK_NB) != 0) {
      const int error = errno;
      ::close(fd);
      fail(part, error == EWOULDBLOCK ? "another writer is at work on it" : std::system_category().message(error));
    }
    const bool mine = is_named(fd, part);
    const std::string refused = mine ? empty(fd, overwrite) : std::string();
    if (mine && refused.empty()) return fd;
    ::close(fd);
    if (mine) fail(part, refused);
  }
}

/// 0 or the errno of the refusal.
int rename_new(const std::string& from, const std::string& to) {
  if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return 0;
  if (errno != EINVAL && errno != ENOSYS) return errno;
  // Some file systems cannot rename without replacing; all of them that have links refuse to replace with one.
  if (::link(from.c_str(), to.c_str()) != 0) return errno;
  return ::unlink(from.c_str()) == 0 ? 0 : errno;
}

/// A new name is on the disk only when its directory is. 0 or the errno of the refusal.
int sync_directory_of(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  const std::string directory = slash == std::string::npos ? "." : path.substr(0, slash + 1);
  const int fd = ::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  // A directory may be writable and yet not readable; then there is no way to ask.
  if (fd < 0) return errno == EACCES ? 0 : errno;
  // Not every file system can sync a directory.
  const int error = ::fsync(fd) == 0 || errno == EINVAL ? 0 : errno;
  ::close(fd);
  return error;
}

}  // namespace

TakeWriter::TakeWriter(std::string path, const TimeCode& time_code, bool overwrite)
    : path_(std::move(path)), part_(path_ + ".part"), overwrite_(overwrite) {
  if (path_.empty()) fail("\"\"", "a file needs a name");
  struct stat there {};
  if (::lstat(path_.c_str(), &there) == 0) {
    if (S_ISDIR(there.st_mode)) fail(path_, "it is a directory");
    if (!overwrite_) fail(path_, "it exists; overwriting it has to be asked for (overwrite=1)");
  }
  fd_ = create_locked(part_, overwrite_);
  const auto written =
      append("DMC01\n# time code of the first field\n" + to_string(time_code) + "\n# constants of the camera");
  if (!written) {
    ::close(fd_);
    ::unlink(part_.c_str());
    fail(part_, std::system_category().message(written.error().error_number));
  }
}

TakeWriter::~TakeWriter() { static_cast<void>(close()); }

tl::expected<void, SinkFault> TakeWriter::write(const wire::CameraConstants& constants) {
  if (fd_ < 0) return tl::unexpected(SinkFault{SinkReason::closed});
  if (constants_) {
    if (constants.id != constants_->id) return tl::unexpected(SinkFault{SinkReason::other_camera});
    constants_count_ = *constants_ == constants;
    if (!constants_count_) return tl::unexpected(SinkFault{SinkReason::constants_changed});
    return {};
  }
  const auto text = wire::to_text(constants, buffer_);
  if (!text) return encode_fault(text.error());
  if (auto written = append(*text); !written) return written;
  constants_ = constants;
  constants_count_ = true;
  return {};
}

tl::expected<void, SinkFault> TakeWriter::write(const wire::CameraParams& params) {
  if (fd_ < 0) return tl::unexpected(SinkFault{SinkReason::closed});
  if (!constants_) return tl::unexpected(SinkFault{SinkReason::no_constants});
  if (params.id != constants_->id) return tl::unexpected(SinkFault{SinkReason::other_camera});
  if (!constants_count_) return tl::unexpected(SinkFault{SinkReason::constants_changed});
  const auto text = wire::to_text(params, buffer_);
  if (!text) return encode_fault(text.error());
  return append(*text);
}

tl::expected<void, SinkFault> TakeWriter::append(std::string_view line) {
  std::array<iovec, 2> pieces{};
  std::size_t done = 0;
  const std::size_t length = line.size() + 1;
  char newline = '\n';
  while (done < length) {
    const std::size_t of_line = done < line.size() ? line.size() - done : 0;
    pieces[0] = {const_cast<char*>(line.data()) + (line.size() - of_line), of_line};
    pieces[1] = {&newline, 1};
    const ssize_t written = ::pwritev(fd_, pieces.data(), static_cast<int>(pieces.size()),
                                      static_cast<off_t>(size_ + static_cast<std::int64_t>(done)));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return system_fault(written < 0 ? errno : EIO);
    done += static_cast<std::size_t>(written);
  }
  size_ += static_cast<std::int64_t>(length);
  return {};
}

tl::expected<void, SinkFault> TakeWriter::close() {
  if (fd_ < 0) return {};
  auto result = publish();
  ::close(fd_);
  fd_ = -1;
  return result;
}

tl::expected<void, SinkFault> TakeWriter::publish() {
  if (!constants_) {
    ::unlink(part_.c_str());
    return tl::unexpected(SinkFault{SinkReason::no_constants});
  }
  // A write that failed half-way has left its beginning behind the last whole line.
  if (::ftruncate(fd_, static_cast<off_t>(size_)) != 0 || ::fsync(fd_) != 0) return system_fault(errno);
  const int refused = overwrite_ ? (::rename(part_.c_str(), path_.c_str()) == 0 ? 0 : errno) : rename_new(part_, path_);
  if (refused != 0) return system_fault(refused);
  if (const int error = sync_directory_of(path_); error != 0) return system_fault(error);
  return {};
}

}  // namespace trk_bridge::transport
