// A file that has its final name only when it is whole.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <tl/expected.hpp>

namespace trk_bridge::file {

/// Written as `PATH.part`. A writer that dies leaves nothing under the final name, and what it wrote in `PATH.part`.
/// One thread at a time; nothing but the constructor allocates.
class PartFile {
 public:
  /// Creates an empty `path`.part, locked against other writers for as long as it is open. Throws
  /// transport::TransportError: without `overwrite`, when a file of the final name exists, or a `.part` that holds what
  /// a dead writer left; always, when another writer is writing it; else the system's reason.
  PartFile(std::string path, bool overwrite);
  /// Closes it; what was not published stays as the `.part`.
  ~PartFile();
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;

  /// Throws what the constructor would throw because of the final name, so that it is known before long work.
  static void check_target(const std::string& path, bool overwrite);

  bool is_open() const noexcept { return fd_ >= 0; }
  int fd() const noexcept { return fd_; }
  const std::string& path() const noexcept { return path_; }
  const std::string& part() const noexcept { return part_; }

  /// Cuts it to `size` bytes where that is given, brings everything to the disk, gives the file its final name and
  /// closes it. The error is an errno; the `.part` then stays.
  [[nodiscard]] tl::expected<void, int> publish(std::optional<std::int64_t> size = std::nullopt) noexcept;
  /// Closes it, and nothing stays.
  void discard() noexcept;

 private:
  void close() noexcept;

  std::string path_;
  std::string part_;
  std::string directory_;
  bool overwrite_;
  int fd_ = -1;
};

}  // namespace trk_bridge::file
