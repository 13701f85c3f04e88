// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// A file that gets its final name only when it is complete.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

#include "transport/socket.h"
#include "trk_bridge/transport/sink.h"

namespace trk_bridge::file {

/// Whether a file may be a FIFO.
enum class Fifo : std::uint8_t { refused, allowed };
/// Whether an existing `.part` may be taken over: an empty one, or with `overwrite` any.
enum class Part : std::uint8_t { taken_over, refused };

/// WriteResult as `PATH.part`. If a writer dies, its data stays in `PATH.part`, and there is no file with the final
/// name. A FIFO is written directly. One thread at a time; only open() allocates.
class PartFile {
 public:
  struct Options {
    bool overwrite = false;  ///< an existing file or a remaining `.part` may be replaced
    Fifo fifo = Fifo::refused;
    Part part = Part::taken_over;  ///< refused: the fault is in_use if one exists, even if it is empty
  };

  /// Creates an empty `path`.part, which is locked against other writers while it is open; the kernel unlocks it when a
  /// writer dies. Faults: exists, part_exists, in_use, not_a_file, no_reader, system. Does not wait for the reader of a
  /// FIFO.
  static tl::expected<PartFile, transport::SinkFault> open(const std::string& path, const Options&);
  /// The fault that open() would return because of the final name, for a check before long work.
  static tl::expected<void, transport::SinkFault> check(const std::string& path, const Options&);

  /// No file.
  PartFile() = default;
  /// Closes it; without publish(), the `.part` remains.
  ~PartFile() = default;
  PartFile(PartFile&&) = default;
  PartFile& operator=(PartFile&&) = default;

  bool is_open() const noexcept { return descriptor_.is_open(); }
  bool is_fifo() const noexcept { return is_fifo_; }
  int fd() const noexcept { return descriptor_.get(); }
  const std::string& path() const noexcept { return path_; }
  /// The name of the incomplete file.
  const std::string& part() const noexcept { return part_; }

  /// Writes all of `bytes` at this offset (in a FIFO: after the previous bytes). The error is an errno.
  [[nodiscard]] tl::expected<void, int> write(std::string_view bytes, std::int64_t at) noexcept;

  /// Truncates it to `size` bytes if given, syncs it to the disk, gives it its final name and closes it. The error is
  /// an errno; then the `.part` remains.
  [[nodiscard]] tl::expected<void, int> publish(std::optional<std::int64_t> size = std::nullopt) noexcept;
  /// Closes and deletes it.
  void discard() noexcept;

 private:
  PartFile(const std::string& path, bool overwrite, transport::Descriptor, bool is_fifo);

  std::string path_;
  std::string part_;
  std::string directory_;
  bool overwrite_ = false;
  bool is_fifo_ = false;
  transport::Descriptor descriptor_;
};

/// `path` is a `.part`. If its writer is dead, publishes it up to the last complete line as `NAME.recovered.trk` (or
/// `NAME.recovered-2.trk` if that exists, …), and returns the new name. Deletes one without any field. None if nothing
/// was published.
std::optional<std::string> recover_part(const std::string& path);

/// The directory of a path, with its slash; "./" if the path has none.
std::string directory_of(const std::string& path);
/// The position of the file extension: of the last dot in the name, or the end if there is none.
std::size_t ending_of(const std::string& path);

}  // namespace trk_bridge::file
