// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "part_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <string_view>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace trk_bridge::file {
namespace {

using transport::Descriptor;
using transport::refused;
using transport::refused_by_system;
using transport::SinkFault;
using transport::SinkReason;

/// Whether `path` still names the file `fd`: another writer may have finished between opening and locking.
bool is_named(int fd, const std::string& path) {
  struct stat mine {};
  struct stat there {};
  return ::fstat(fd, &mine) == 0 && ::stat(path.c_str(), &there) == 0 && mine.st_dev == there.st_dev &&
         mine.st_ino == there.st_ino;
}

bool is_fifo_there(const std::string& path) {
  struct stat there {};
  return ::stat(path.c_str(), &there) == 0 && S_ISFIFO(there.st_mode);
}

/// Truncates the locked file to zero.
tl::expected<void, SinkFault> empty(int fd, bool overwrite) {
  struct stat there {};
  if (::fstat(fd, &there) != 0) return refused_by_system(errno);
  if (!S_ISREG(there.st_mode)) return refused(SinkReason::not_a_file);
  if (there.st_size > 0 && !overwrite) return refused(SinkReason::part_exists);
  if (::ftruncate(fd, 0) != 0) return refused_by_system(errno);
  return {};
}

/// Creates an empty file of that name, which is locked while it is open.
tl::expected<Descriptor, SinkFault> create_locked(const std::string& part, const PartFile::Options& options) {
  const int only_new = options.part == Part::refused ? O_EXCL : 0;
  for (;;) {
    // If the name belongs to a FIFO, do not wait for its reader.
    Descriptor file(::open(part.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK | only_new, 0666));
    if (!file.is_open()) {
      if (errno == ENXIO) return refused(SinkReason::not_a_file);
      return only_new != 0 && errno == EEXIST ? refused(SinkReason::in_use) : refused_by_system(errno);
    }
    if (::flock(file.get(), LOCK_EX | LOCK_NB) != 0) {
      return errno == EWOULDBLOCK ? refused(SinkReason::in_use) : refused_by_system(errno);
    }
    if (!is_named(file.get(), part)) continue;
    if (const auto emptied = empty(file.get(), options.overwrite); !emptied) return tl::unexpected(emptied.error());
    return file;
  }
}

/// Opens a FIFO that a program reads; later writes block.
tl::expected<Descriptor, SinkFault> open_fifo(const std::string& path) {
  Descriptor fifo(::open(path.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC));
  if (!fifo.is_open()) return errno == ENXIO ? refused(SinkReason::no_reader) : refused_by_system(errno);
  if (::fcntl(fifo.get(), F_SETFL, 0) != 0) return refused_by_system(errno);
  return fifo;
}

/// Renames without replacing. Returns 0 or an errno.
int rename_new(const std::string& from, const std::string& to) {
  if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return 0;
  if (errno != EINVAL && errno != ENOSYS) return errno;
  // Some file systems cannot rename without replacing; but link() never replaces a file.
  if (::link(from.c_str(), to.c_str()) != 0) return errno;
  return ::unlink(from.c_str()) == 0 ? 0 : errno;
}

/// A new name is on the disk only after its directory is synced. Returns 0 or an errno.
int sync_directory(const std::string& directory) {
  const Descriptor open(::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  // A directory may be writable but not readable; then it cannot be synced.
  if (!open.is_open()) return errno == EACCES ? 0 : errno;
  // Not every file system can sync a directory.
  return ::fsync(open.get()) == 0 || errno == EINVAL ? 0 : errno;
}

/// The size up to the end of the last complete line; 0 if there is none.
std::int64_t size_of_whole_lines(int fd, std::int64_t size) {
  std::array<char, 4096> chunk{};
  for (std::int64_t end = size; end > 0;) {
    const std::int64_t begin = std::max<std::int64_t>(0, end - static_cast<std::int64_t>(chunk.size()));
    const ssize_t got = ::pread(fd, chunk.data(), static_cast<std::size_t>(end - begin), static_cast<off_t>(begin));
    if (got != end - begin) return 0;
    for (std::int64_t i = got; i > 0; --i) {
      if (chunk[static_cast<std::size_t>(i - 1)] == '\n') return begin + i;
    }
    end = begin;
  }
  return 0;
}

/// The content of a `.part`.
enum class Content { no_take, without_field, take };

Content content_of(int fd, std::int64_t size) {
  constexpr std::string_view magic = "DMC01\n";
  std::array<char, 16384> head{};
  const ssize_t got = ::pread(fd, head.data(), std::min(head.size(), static_cast<std::size_t>(size)), 0);
  const std::string_view text(head.data(), got > 0 ? static_cast<std::size_t>(got) : 0);
  if (text.substr(0, magic.size()) != magic) return Content::no_take;
  // The first field is the fourth line that is not a comment, after magic, time code and constants.
  int lines = 0;
  char before = '\n';
  for (const char c : text) {
    if (before == '\n' && c != '#' && c != '\n') ++lines;
    before = c;
  }
  return lines >= 4 ? Content::take : Content::without_field;
}

/// "take.recovered.trk" for "take.trk", then "take.recovered-2.trk", …
std::string recovered_name(const std::string& path, int number) {
  const std::size_t ending = ending_of(path);
  return path.substr(0, ending) + ".recovered" + (number > 1 ? "-" + std::to_string(number) : "") + path.substr(ending);
}

}  // namespace

std::string directory_of(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? "./" : path.substr(0, slash + 1);
}

std::size_t ending_of(const std::string& path) {
  const std::size_t name = path.rfind('/') + 1;  // 0 if there is none
  const std::size_t dot = path.rfind('.');
  return dot == std::string::npos || dot <= name ? path.size() : dot;
}

PartFile::PartFile(const std::string& path, bool overwrite, Descriptor descriptor, bool is_fifo)
    : path_(path),
      part_(is_fifo ? path : path + ".part"),
      directory_(directory_of(path)),
      overwrite_(overwrite),
      is_fifo_(is_fifo),
      descriptor_(std::move(descriptor)) {}

tl::expected<PartFile, SinkFault> PartFile::open(const std::string& path, const Options& options) {
  if (const auto good = check(path, options); !good) return tl::unexpected(good.error());
  const bool is_fifo = is_fifo_there(path);
  auto opened = is_fifo ? open_fifo(path) : create_locked(path + ".part", options);
  if (!opened) return tl::unexpected(opened.error());
  PartFile file(path, options.overwrite, *std::move(opened), is_fifo);
  // Another writer may have published this name between the first check and the lock.
  if (const auto good = check(path, options); !good) {
    file.discard();
    return tl::unexpected(good.error());
  }
  return file;
}

tl::expected<void, SinkFault> PartFile::check(const std::string& path, const Options& options) {
  struct stat there {};
  if (path.empty()) return refused_by_system(ENOENT);
  if (options.fifo == Fifo::allowed && is_fifo_there(path)) return {};
  if (::lstat(path.c_str(), &there) != 0) return {};
  if (!S_ISREG(there.st_mode) && !S_ISLNK(there.st_mode)) return refused(SinkReason::not_a_file);
  if (!options.overwrite) return refused(SinkReason::exists);
  return {};
}

tl::expected<void, int> PartFile::write(std::string_view bytes, std::int64_t at) noexcept {
  while (!bytes.empty()) {
    const ssize_t written = is_fifo_ ? ::write(fd(), bytes.data(), bytes.size())
                                     : ::pwrite(fd(), bytes.data(), bytes.size(), static_cast<off_t>(at));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return tl::unexpected(written < 0 ? errno : EIO);
    bytes.remove_prefix(static_cast<std::size_t>(written));
    at += written;
  }
  return {};
}

tl::expected<void, int> PartFile::publish(std::optional<std::int64_t> size) noexcept {
  if (!is_open()) return tl::unexpected(EBADF);
  const auto refused = [&]() noexcept {
    if (is_fifo_) return 0;
    if (size && ::ftruncate(fd(), static_cast<off_t>(*size)) != 0) return errno;
    if (::fsync(fd()) != 0) return errno;
    const int renamed =
        overwrite_ ? (::rename(part_.c_str(), path_.c_str()) == 0 ? 0 : errno) : rename_new(part_, path_);
    return renamed != 0 ? renamed : sync_directory(directory_);
  };
  const int error = refused();
  descriptor_.close();
  if (error != 0) return tl::unexpected(error);
  return {};
}

void PartFile::discard() noexcept {
  if (!is_open()) return;
  // Still locked, so that it cannot belong to another writer.
  if (!is_fifo_) ::unlink(part_.c_str());
  descriptor_.close();
}

std::optional<std::string> recover_part(const std::string& path) {
  constexpr std::string_view ending = ".part";
  const Descriptor part(::open(path.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
  struct stat there {};
  if (!part.is_open() || ::fstat(part.get(), &there) != 0 || !S_ISREG(there.st_mode)) return std::nullopt;
  // An empty one may belong to a writer that has not locked it yet.
  if (there.st_size == 0 || ::flock(part.get(), LOCK_EX | LOCK_NB) != 0 || !is_named(part.get(), path)) {
    return std::nullopt;
  }
  if (::fstat(part.get(), &there) != 0) return std::nullopt;
  const std::int64_t size = size_of_whole_lines(part.get(), there.st_size);
  const Content content = content_of(part.get(), size);
  if (content == Content::without_field) ::unlink(path.c_str());
  if (content != Content::take) return std::nullopt;
  if (::ftruncate(part.get(), static_cast<off_t>(size)) != 0) return std::nullopt;
  const std::string take = path.substr(0, path.size() - ending.size());
  for (int number = 1;; ++number) {
    const std::string name = recovered_name(take, number);
    const int error = rename_new(path, name);
    if (error == 0) return name;
    if (error != EEXIST) return std::nullopt;
  }
}

}  // namespace trk_bridge::file
