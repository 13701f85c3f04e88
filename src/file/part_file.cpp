#include "part_file.h"

#include <cerrno>
#include <cstdio>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "trk_bridge/transport/source.h"

namespace trk_bridge::file {
namespace {

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
  throw transport::TransportError(path + ": cannot be written: " + reason);
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
    return "it holds what an interrupted writer left; move it away, or ask for overwriting (overwrite=1, --overwrite)";
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
      fail(part, error == EWOULDBLOCK ? "another writer is writing it" : std::system_category().message(error));
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
int sync_directory(const std::string& directory) {
  const int fd = ::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  // A directory may be writable and yet not readable; then there is no way to ask.
  if (fd < 0) return errno == EACCES ? 0 : errno;
  // Not every file system can sync a directory.
  const int error = ::fsync(fd) == 0 || errno == EINVAL ? 0 : errno;
  ::close(fd);
  return error;
}

std::string directory_of(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? "." : path.substr(0, slash + 1);
}

}  // namespace

PartFile::PartFile(std::string path, bool overwrite)
    : path_(std::move(path)), part_(path_ + ".part"), directory_(directory_of(path_)), overwrite_(overwrite) {
  check_target(path_, overwrite_);
  fd_ = create_locked(part_, overwrite_);
}

void PartFile::check_target(const std::string& path, bool overwrite) {
  if (path.empty()) fail("\"\"", "a file needs a name");
  struct stat there {};
  if (::lstat(path.c_str(), &there) != 0) return;
  if (S_ISDIR(there.st_mode)) fail(path, "it is a directory");
  if (!overwrite) fail(path, "it exists; overwriting it has to be asked for (overwrite=1, --overwrite)");
}

PartFile::~PartFile() { close(); }

tl::expected<void, int> PartFile::publish(std::optional<std::int64_t> size) noexcept {
  if (fd_ < 0) return tl::unexpected(EBADF);
  const auto refused = [&]() noexcept {
    if (size && ::ftruncate(fd_, static_cast<off_t>(*size)) != 0) return errno;
    if (::fsync(fd_) != 0) return errno;
    const int renamed =
        overwrite_ ? (::rename(part_.c_str(), path_.c_str()) == 0 ? 0 : errno) : rename_new(part_, path_);
    return renamed != 0 ? renamed : sync_directory(directory_);
  };
  const int error = refused();
  close();
  if (error != 0) return tl::unexpected(error);
  return {};
}

void PartFile::discard() noexcept {
  if (fd_ < 0) return;
  // Still locked, so that it is no other writer's.
  ::unlink(part_.c_str());
  close();
}

void PartFile::close() noexcept {
  if (fd_ >= 0) ::close(std::exchange(fd_, -1));
}

}  // namespace trk_bridge::file
